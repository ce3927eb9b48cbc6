"""The manifest of a certificate (docs/certificates.md): of which text it speaks, and what was found of it.

A robot reads it to run only what was certified. It does not check the proofs again: `sleec-verify certify --check` does
so before, and a signature tells the robot that someone with the key has seen to it.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from sleec_runtime.errors import CertificateRefused, SleecError
from sleec_runtime.files import read_file
from sleec_runtime.messages import represent

if TYPE_CHECKING:
    from sleec_runtime.model import Ruleset

FORMAT = 1
"""The version of what stands in a certificate. Another one is refused."""

MANIFEST = "manifest.json"
SIGNATURE = "manifest.sig"
"""Ed25519 over the bytes of the manifest, as base64."""


@dataclass(frozen=True)
class Manifest:
    """What a certificate says. `domain` is None where the rules were checked in each of their domains; `verdicts` are
    those of the checks by name; `files` has the SHA-256 of every other file. `whole` is all of it, as it was read."""

    sha256: str
    reading: str
    domain: str | None
    verdicts: Mapping[str, str]
    files: Mapping[str, str]
    whole: Mapping[str, Any]


def read_manifest(folder: str | Path, key: str | Path | None = None) -> Manifest:
    """The manifest of the certificate in `folder`, whose signature fits the public `key` if one is given.

    Raises CertificateRefused where there is none, it is of another format, or the signature does not fit.
    """
    import json

    try:
        data = read_file(Path(folder) / MANIFEST)
    except OSError as error:
        raise _refused(
            "no-certificate",
            f"{folder} is no certificate: its {MANIFEST} cannot be read: {error.strerror}",
            "`sleec-verify certify FILE -o DIR` makes one",
        ) from None
    if key is not None:
        check_signature(folder, data, key)
    try:
        whole = json.loads(data)
    except (ValueError, RecursionError):
        whole = None
    if not isinstance(whole, dict) or whole.get("certificate") != "sleec-verify":
        raise _refused("no-certificate", f"{folder} is no certificate: its {MANIFEST} is not one of ours")
    if whole.get("format") != FORMAT:
        raise _refused(
            "format",
            f"the certificate is of format {represent(whole.get('format'))}, and this version reads {FORMAT}",
            "certify the rules again, or use the version of sleec-verify that made it",
        )
    try:
        return Manifest(
            sha256=_text(whole["ruleset"]["sha256"]),
            reading=_text(whole["reading"]),
            domain=None if whole["domain"] is None else _text(whole["domain"]),
            verdicts={_text(check["name"]): _text(check["verdict"]) for check in whole["checks"]},
            files={_text(name): _text(digest) for name, digest in whole["files"].items()},
            whole=whole,
        )
    except (KeyError, TypeError, AttributeError):
        raise _refused("no-certificate", f"the {MANIFEST} in {folder} lacks what every certificate has") from None


def _text(value: object) -> str:
    if not isinstance(value, str):
        raise TypeError
    return value


class Demand:
    """What a runtime asks of rules before they are in force: the certificate in `folder`, signed by `key` if there is
    one, must say that they are free of conflict.

    Raises, when made, what `read_manifest` does.
    """

    def __init__(self, folder: str | Path, key: str | Path | None = None) -> None:
        self.key = key
        self._manifest = read_manifest(folder, key)

    def check(self, ruleset: Ruleset, domain: str | None) -> None:
        """Refuse a ruleset that is to be in force in `domain` unless it is certified. Raises CertificateRefused."""
        _require_certified(ruleset, domain, self._manifest)


def _require_certified(ruleset: Ruleset, domain: str | None, manifest: Manifest) -> None:
    if manifest.sha256 != ruleset.source.sha256:
        raise _refused(
            "ruleset-changed",
            f"the certificate is not of these rules: {ruleset.source.path} has other bytes",
            "certify the rules as they are now",
        )
    if manifest.reading != ruleset.reading:
        raise _refused(
            "reading",
            f"the certificate is for the reading {manifest.reading}, and the rules are read as {ruleset.reading}",
            "certify them with --reading, or load them with reading=",
        )
    if manifest.domain is not None and manifest.domain != domain:
        told = "all domains" if domain is None else f"the domain {domain}"
        raise _refused(
            "domain",
            f"the certificate is for the domain {manifest.domain}, and the rules are loaded for {told}",
            "certify them for this domain, or load them for that one",
        )
    if domain is None and len(ruleset.domains) > 1:
        raise _refused(
            "domain",
            f"the certificate is for each of the domains {', '.join(ruleset.domains)} by itself",
            "load the rules with domain=",
        )
    verdict = manifest.verdicts.get("conflict")
    if verdict != "proved":
        raise _refused(
            "conflict",
            f"the certificate does not say that the rules are free of conflict: {verdict or 'unasked'}",
            "`sleec-verify check` shows the situations in which they are not",
        )


def _refused(reason: str, message: str, hint: str | None = None) -> CertificateRefused:
    return CertificateRefused([(reason, message)], hint)


def check_signature(folder: str | Path, signed: bytes, key: str | Path) -> None:
    """Refuse a manifest of these bytes unless its signature was made with the private half of `key` (a PEM file).

    Raises CertificateRefused; SleecError if the key is none, or the library `cryptography` is not installed.
    """
    from base64 import b64decode

    ed25519, serialization, invalid = cryptography()
    try:
        public = serialization.load_pem_public_key(read_file(key))
    except OSError as error:
        raise SleecError(f"the key {key} cannot be read: {error.strerror}") from None
    except Exception:  # noqa: BLE001 - what a file that is no key raises depends on what it is
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
    """What signatures are made and checked with: the modules `ed25519` and `serialization`, and the error of a
    signature that does not fit.

    Raises SleecError if it is not installed.
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
