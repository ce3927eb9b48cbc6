"""Conflicts that all responses of their rules refute, or confirm."""

from __future__ import annotations

import pytest

from sleec_runtime.language import parse
from sleec_verify.checks import run_checks
from sleec_verify.results.finding import Refuted, Unknown

ALARM = "WHEN smoke is detected THEN sound the alarm WITHIN 10 seconds OTHERWISE call the operator\n"
QUIET = "WHEN smoke is detected AND the user is asleep THEN NOT sound the alarm\n"


def conflicts(text: str) -> list[tuple[str, ...]]:
    """The rules of the conflicts that a check shows."""
    (result,) = run_checks(parse(text), ["conflict"])
    findings = result.verdict.findings if isinstance(result.verdict, (Refuted, Unknown)) else ()
    return [finding.rules for finding in findings]


@pytest.mark.parametrize(
    "text",
    [
        ALARM + QUIET,
        "WHEN a THEN b ELSE c\nWHEN a THEN NOT b\n",
        "WHEN a THEN b OTHERWISE c\nWHEN a THEN NOT b\n",
        "def_start event A event B event C def_end rule_start R1 when A then B else C R2 when A then not B rule_end",
    ],
)
def test_rules_with_another_response_are_not_shown_as_a_conflict(text: str) -> None:
    assert conflicts(text) == []


@pytest.mark.parametrize(
    "text",
    [
        "WHEN a THEN b ELSE c\nWHEN a THEN NOT b\nWHEN a THEN NOT c\n",
        "WHEN a THEN b OTHERWISE c\nWHEN a THEN NOT b AND NOT c\n",
        "WHEN a THEN b WITHIN 10 minutes\nWHEN c THEN NOT b WITHIN 10 minutes\n",
    ],
)
def test_conflicts_without_a_complying_response_are_shown(text: str) -> None:
    assert len(conflicts(text)) == 1
