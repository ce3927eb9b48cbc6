"""Whether the certificate beside a ruleset holds: ``household.certificate/`` beside ``household.sleec``."""

from __future__ import annotations

from pathlib import Path

from sleec_runtime.errors import SleecError
from sleec_runtime.model import Ruleset

SUFFIX = ".certificate"


def without_certificate(ruleset: Ruleset) -> str | None:
    """Why a ruleset has no certificate that holds, or None if it has. Costs what ``certify --check`` does."""
    from sleec_verify.certificates.checker import checker
    from sleec_verify.certificates.checking import check_certificate
    from sleec_verify.theory.oracle import built

    path = Path(ruleset.source.path)
    folder = path.with_name(path.name.removesuffix(".sleec") + SUFFIX)
    if not folder.exists():
        return f"there is no {folder.name} beside it (sleec-verify certify {path.name} -o {folder.name})"
    try:
        check_certificate(ruleset, str(folder), checker(None), oracle=built())
    except SleecError as error:
        return f"{folder.name} is refused: {error.message}"
    return None
