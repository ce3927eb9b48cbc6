"""The repairs in a report: those of all findings, errors first, and the reason where there are none."""

from __future__ import annotations

import pytest

from sleec_runtime.language import parse
from sleec_verify.checks import run_checks
from sleec_verify.encoding.scope import WHOLE
from sleec_verify.report.document import repairs as module
from sleec_verify.report.document.findings import numbered
from sleec_verify.report.document.repairs import repairs_to_show
from sleec_verify.report.outcome import CheckedRuleset
from tests.support.cli import Cli

RULES = """RULE drill
WHEN Drill THEN Announce
UNLESS Age > 18 AND Age < 17 IN WHICH CASE StaySilent
RULE light
WHEN Fall THEN TurnOnLight
RULE dark
WHEN Fall THEN NOT TurnOnLight
"""


def outcome() -> CheckedRuleset:
    ruleset = parse(f"MEASURE Age: number\n{RULES}", "rules.sleec")
    return CheckedRuleset(ruleset, tuple(run_checks(ruleset)))


def test_every_finding_has_its_own_repairs() -> None:
    found = outcome()
    shown = numbered(found._replace(repairs=repairs_to_show(found, WHOLE)))
    assert {one.finding.severity for one in shown} == {"error", "warning"}
    for one in shown:
        assert one.repairs is not None
        assert one.repairs.finding == one.finding
        assert one.repairs.repairs
        assert all(repair.finding == one.finding for _, repair in one.repairs.repairs)


def test_errors_are_first_if_the_steps_are_not_sufficient(monkeypatch: pytest.MonkeyPatch, cli: Cli) -> None:
    monkeypatch.setattr(module, "limit", lambda rules: 1_900)
    found = outcome()
    shown = numbered(found._replace(repairs=repairs_to_show(found, WHOLE)))
    (warning,) = (one for one in shown if one.finding.severity == "warning")
    assert warning.repairs is not None
    assert warning.repairs.repairs == ()
    assert "the search ended before this finding" in (warning.repairs.undecided or "")
    for form in ("html", "markdown"):
        ran = cli("report", "a.sleec", "--format", form, files={"a.sleec": f"MEASURE Age: number\n{RULES}"})
        assert "No repair is shown: the search ended before this finding" in ran.out


def test_a_larger_ruleset_has_fewer_steps() -> None:
    limits = [module.limit(rules) for rules in (0, 1, 15, 30, 60, 200, 500)]
    assert limits == sorted(limits, reverse=True)
    assert (limits[0], limits[-1]) == (2_000_000, 20_000)
