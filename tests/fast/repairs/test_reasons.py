"""Why a finding has no repair."""

from __future__ import annotations

import pytest

from sleec_runtime.language import parse
from sleec_verify.checks import run_checks
from sleec_verify.repairs.search import RepairSearch
from tests.support.cli import Cli

INPUTS = "RULE a\nWHEN it rings THEN greet WITHIN 5 minutes\nCONCERN c EXISTS it rings AND it is dark\n"
PREVENTED = INPUTS.replace("it is dark", "it is dark WHILE NOT greet")
UNTIMED_NEVER = "NEVER raise\nRULE r\nWHEN a THEN raise\n"


@pytest.mark.parametrize(
    ("text", "code", "reason"),
    [
        (
            INPUTS,
            "SLEEC104",
            "no rule can prevent this: it names only what happens around the robot; add a response or an ASSUME",
        ),
        (
            UNTIMED_NEVER,
            "SLEEC102",
            "each change that was tried leaves this finding or leads to another one: if you ",
        ),
    ],
)
def test_the_reason_is_stated(text: str, code: str, reason: str, cli: Cli) -> None:
    ruleset = parse(text)
    results = run_checks(ruleset)
    search = RepairSearch(ruleset, results)
    finding = next(f for result in results for f in result.findings if f.code == code)
    assert search.repairs(finding) == []
    assert search.reason is not None
    assert search.reason.startswith(reason)
    for form in ("full", "concise", "json", "html", "markdown"):
        command = ("report", "a.sleec") if form in ("html", "markdown") else ("check", "--fixes", "a.sleec")
        ran = cli(*command, "--format", form, files={"a.sleec": text})
        assert reason.partition(":")[0] in ran.out, form


def test_a_finding_with_a_repair_needs_no_reason() -> None:
    ruleset = parse(PREVENTED)
    results = run_checks(ruleset)
    search = RepairSearch(ruleset, results)
    for finding in (f for result in results for f in result.findings):
        if search.repairs(finding):
            assert search.reason is None
