"""What is made of rules, and read again: certificates and cases."""

from __future__ import annotations

from pathlib import Path
from shutil import rmtree
from typing import TYPE_CHECKING

from sleec_verify.certificates.certification import certify
from sleec_verify.certificates.checker import IN_PYTHON
from sleec_verify.certificates.verification import check_certificate
from sleec_verify.conformance.cases.reader import read_cases
from sleec_verify.conformance.cases.selection import choose_cases
from sleec_verify.conformance.cases.writer import toml
from sleec_verify.encoding.trace_scope import speaks_of_traces
from tests.fuzz.property import unless_refused
from tests.fuzz.rules import read

if TYPE_CHECKING:
    from sleec_runtime.model import Ruleset


def made(data: bytes, folder: Path) -> None:
    """Certificates of rules without times are accepted, and cases read as they were written."""
    ruleset = read(data)
    if ruleset is None or speaks_of_traces(ruleset):
        return
    _certificate(ruleset, folder / "certificate")
    _cases(ruleset, folder / "fuzz.cases.toml")


def _certificate(ruleset: Ruleset, folder: Path) -> None:
    certificate = unless_refused(certify, ruleset)
    if certificate is not None:
        rmtree(folder, ignore_errors=True)
        folder.mkdir()
        for name, content in certificate.contents():
            (folder / name).write_bytes(content)
        check_certificate(ruleset, str(folder), IN_PYTHON)


def _cases(ruleset: Ruleset, path: Path) -> None:
    found = unless_refused(choose_cases, ruleset, "clause")
    if found is not None and found.cases:
        path.write_text(toml(ruleset, "clause", found, None), encoding="utf-8")
        for written, again in zip(found.cases, read_cases(path, ruleset).situations, strict=True):
            assert again.context() == written.context()
            assert again.obligations == written.obligations
