"""Signs a manifest with Ed25519. `sleec_runtime.certificate` verifies signatures, because robots do this too."""

from __future__ import annotations

from base64 import b64encode

from sleec_runtime.certificate.signature import cryptography
from sleec_runtime.errors import SleecError
from sleec_runtime.support.files import read_file


def sign(data: bytes, key: str) -> bytes:
    """The signature of `data`, as base64 with a line break, by the private key in the PEM file `key`.

    Raises SleecError if the file has no such key, or if `cryptography` is not installed.
    """
    ed25519, serialization, _ = cryptography()
    try:
        private = serialization.load_pem_private_key(read_file(key), password=None)
    except OSError as error:
        raise SleecError(f"the key {key} cannot be read: {error.strerror}") from None
    except Exception:  # noqa: BLE001 - what a file that is no key raises depends on what it is
        private = None
    if not isinstance(private, ed25519.Ed25519PrivateKey):
        raise SleecError(
            f"{key} is not a private Ed25519 key in PEM without a password",
            "create one with openssl genpkey -algorithm ed25519 -out KEY.pem",
        )
    signature: bytes = private.sign(data)
    return b64encode(signature) + b"\n"
