"""The signature of a certificate: Ed25519 over the bytes of its manifest."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from sleec_runtime.errors import CertificateRefused, SleecError
from sleec_runtime.support.files import read_file

SIGNATURE = "manifest.sig"
"""The file with the signature, as base64."""


def check_signature(folder: str | Path, signed: bytes, key: str | Path) -> None:
    """Checks the signature of a manifest, the bytes `signed`, with the public `key` (a PEM file).

    Raises CertificateRefused; SleecError for an invalid key, or if the library `cryptography` is not installed.
    """
    from base64 import b64decode

    ed25519, serialization, invalid = cryptography()
    try:
        public = serialization.load_pem_public_key(read_file(key))
    except OSError as error:
        raise SleecError(f"the key {key} cannot be read: {error.strerror}") from None
    except Exception:  # noqa: BLE001 - the error depends on the content of the file
        public = None
    if not isinstance(public, ed25519.Ed25519PublicKey):
        raise SleecError(f"{key} is not a public Ed25519 key in PEM", "openssl pkey -in KEY.pem -pubout -out PUB.pem")
    try:
        written = read_file(Path(folder) / SIGNATURE)
    except OSError:
        raise _refused(
            "unsigned", "the certificate is not signed", "sign it: sleec-verify certify FILE -o DIR --sign KEY.pem"
        ) from None
    try:
        public.verify(b64decode(written.strip(), validate=True), signed)
    except (invalid, ValueError):
        raise _refused(
            "signature", "the signature does not fit: the manifest was changed, or signed with another key"
        ) from None


def cryptography() -> tuple[Any, Any, type[Exception]]:
    """The modules `ed25519` and `serialization` of `cryptography`, and its error for a wrong signature.

    Raises SleecError if the library is not installed.
    """
    try:
        from cryptography.exceptions import InvalidSignature
        from cryptography.hazmat.primitives import serialization
        from cryptography.hazmat.primitives.asymmetric import ed25519
    except ImportError:
        raise SleecError(
            "signatures need the library `cryptography`, which is not installed", "pip install cryptography"
        ) from None
    return ed25519, serialization, InvalidSignature


def _refused(reason: str, message: str, hint: str | None = None) -> CertificateRefused:
    return CertificateRefused([(reason, message)], hint)
