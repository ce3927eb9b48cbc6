"""The manifest of a certificate: its parser, and the only way to write it.

The parser accepts exactly what `canonical` writes. So two manifests that differ in a byte never say the same.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

from sleec_runtime.certificate.schema import MANIFEST_SHAPE, Malformed
from sleec_runtime.errors import CertificateRefused
from sleec_runtime.support.messages import represent

if TYPE_CHECKING:
    from pathlib import Path

FORMAT = 3
"""The version of the format. Other versions are rejected."""


class Required(NamedTuple):
    """Further requirements on a certificate.

    `proved`: the checker that is proved in Coq accepts every refutation. `tied`: every verdict that rests on a
    refutation is proved for the rules themselves, by code extracted from the theory in Coq.
    """

    proved: bool = False
    tied: bool = False


@dataclass(frozen=True)
class Manifest:
    """The content of a manifest.

    `ruleset` describes the text of the rules, with its SHA-256. `domain` is None if the rules were checked in each of
    their domains. `untimed` says when a response without a window is due, and is None for rules without time. `chains`
    tells whether responses trigger rules. `required` are the requirements that held when the certificate was written.
    `verdicts` are those of the checks, and `files` the SHA-256 of all other files, by name. `whole` is all data.
    """

    ruleset: Mapping[str, Any]
    reading: str
    domain: str | None
    untimed: str | None
    chains: bool
    required: Required
    verdicts: Mapping[str, str]
    files: Mapping[str, str]
    whole: Mapping[str, Any]

    @property
    def sha256(self) -> str:
        """The SHA-256 of the bytes of the rules."""
        return str(self.ruleset["sha256"])


def canonical(whole: Mapping[str, Any]) -> bytes:
    """The bytes of a manifest: JSON in ASCII, with a line for each entry and for each check."""
    rows = []
    for key, entry in whole.items():
        if key == "checks" and isinstance(entry, list):
            written = "[\n  " + ",\n  ".join(json.dumps(check) for check in entry) + "\n ]"
        else:
            written = json.dumps(entry)
        rows.append(f" {json.dumps(key)}: {written}")
    return ("{\n" + ",\n".join(rows) + "\n}\n").encode("ascii")


def parse(data: bytes, path: str | Path) -> Manifest:
    """Parses a manifest. Messages name it by `path`. Raises CertificateRefused unless `canonical` writes these
    bytes."""
    try:
        whole = json.loads(data.decode("utf-8"), parse_constant=_refuse_constant)
    except (ValueError, RecursionError):
        whole = None
    if not isinstance(whole, dict) or whole.get("certificate") != "sleec-verify":
        raise CertificateRefused([("no-certificate", f"{path} is not the manifest of a certificate")])
    found = whole.get("format")
    if type(found) is not int or found != FORMAT:
        raise CertificateRefused(
            [("format", f"the certificate is of format {represent(found)}, and this version reads {FORMAT}")],
            "certify the rules again, or use the version of sleec-verify that made it",
        )
    try:
        return _strict(data, whole)
    except Malformed as error:
        raise CertificateRefused(
            [("manifest", f"{path} is not what certify writes: {error}")], "certify the rules again"
        ) from None


def _strict(data: bytes, whole: Mapping[str, Any]) -> Manifest:
    MANIFEST_SHAPE(whole, "")
    if canonical(whole) != data:
        raise Malformed("its bytes differ from the one way to write what it says")
    verdicts = {check["name"]: check["verdict"] for check in whole["checks"]}
    if len(verdicts) < len(whole["checks"]):
        raise Malformed("a check has two entries")
    taken = {key: whole[key] for key in ("ruleset", "reading", "domain", "untimed", "chains", "files")}
    return Manifest(required=Required(**whole["required"]), verdicts=verdicts, whole=whole, **taken)


def _refuse_constant(name: str) -> None:
    raise ValueError(f"{name} is not JSON")
