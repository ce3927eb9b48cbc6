"""Whether the certificate beside a ruleset is valid: ``household.certificate/`` beside ``household.sleec``."""

from __future__ import annotations

from pathlib import Path

from sleec_runtime.certificate.coverage import Use
from sleec_runtime.certificate.manifest import Manifest, Required
from sleec_runtime.errors import SleecError
from sleec_runtime.model import Ruleset
from sleec_verify.changes.gate.keys import Policy
from sleec_verify.encoding.trace_scope import Untimed
from sleec_verify.files.folders import beside

SUFFIX = ".certificate"


def certificate(ruleset: Ruleset, untimed: Untimed, policy: Policy) -> Manifest | str:
    """The content of the certificate beside a ruleset, or why there is no valid one for its use: its whole text in
    its own reading, with `untimed`, and with the requirements of `policy`. Costs as much as ``certify --check``."""
    from sleec_verify.certificates.checker import checker
    from sleec_verify.certificates.theory.oracle import built
    from sleec_verify.certificates.verification import check_certificate

    path = Path(ruleset.source.path)
    folder = path.with_name(beside(path.name, SUFFIX))
    if not folder.exists():
        return f"the certificate {folder.name} is missing (write it: sleec-verify certify {path.name} -o {folder.name})"
    try:
        use = Use(ruleset.reading, untimed=untimed)
        required = Required(policy.require_proved, policy.require_tied)
        return check_certificate(ruleset, str(folder), checker(), use, required, oracle=built()).manifest
    except SleecError as error:
        return f"{folder.name} is refused: {error.message}"
