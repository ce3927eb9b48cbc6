"""The exit codes and their meaning."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from sleec_verify.results.finding import SEVERITIES, Severity, Unknown

if TYPE_CHECKING:
    from sleec_verify.results.finding import CheckResult

HOLDS = 0
FINDINGS = 1
UNUSABLE = 2
UNKNOWN = 3


def of_answer(consistent: bool | None) -> int:
    """The exit code of the answer in one situation."""
    return UNKNOWN if consistent is None else HOLDS if consistent else FINDINGS


def code(results: Iterable[CheckResult], fail_level: Severity, ignored: str = "") -> int:
    """The exit code of some results.

    It depends on whether there is a finding of at least the severity `fail_level`. Findings with the code `ignored`,
    and allowed ones, do not count.
    """
    results = tuple(results)
    failing = SEVERITIES[: SEVERITIES.index(fail_level) + 1]
    findings = (finding for result in results for finding in result.findings)
    if any(f.severity in failing and f.code != ignored and f.allowed is None for f in findings):
        return FINDINGS
    return UNKNOWN if any(isinstance(result.verdict, Unknown) for result in results) else HOLDS
