"""Rules that require an event of the environment are reported, and make no conflict by themselves."""

from __future__ import annotations

import pytest

from sleec_runtime.language import parse
from sleec_verify.checks import run_checks
from sleec_verify.results.finding import Finding

DECLARED = "EVENT Calls, Asks\nEVENT Answers BY environment\n"
DSL = "def_start event A event B event C as environment def_end rule_start {} rule_end"


def findings(text: str, check: str = "required-input") -> tuple[Finding, ...]:
    (result,) = run_checks(parse(text), [check])
    return result.findings


@pytest.mark.parametrize(
    "response", ["Answers", "Answers WITHIN 1 hour", "Asks WITHIN 1 hour OTHERWISE Answers", "Asks ELSE Answers"]
)
def test_a_rule_that_requires_an_input_is_reported(response: str) -> None:
    text = f"{DECLARED}RULE call\nWHEN Calls THEN {response}\n"
    (finding,) = findings(text)
    assert (finding.code, finding.severity, finding.rules) == ("SLEEC108", "warning", ("call",))
    assert (finding.clauses, finding.obligations) == ((("call", 0),), ("Answers",))
    assert finding.message == "rule `call` requires `Answers`, which the environment causes"
    assert findings(text, "conflict") == ()


@pytest.mark.parametrize("declared", ["EVENT Calls, Answers\n", "EVENT Calls\nEVENT Answers BY system\n", ""])
def test_what_the_robot_may_cause_is_no_input(declared: str) -> None:
    assert findings(f"{declared}WHEN Calls THEN Answers\n") == ()


@pytest.mark.parametrize("rule", ["R1 when A then C", "R1 when A then C within 2 seconds", "R1 when A then B else C"])
def test_in_the_dsl_it_is_no_conflict(rule: str) -> None:
    text = DSL.format(f"{rule} R2 when A then not B within 9 seconds")
    assert [finding.clauses for finding in findings(text)] == [(("R1", 0),)]
    assert findings(text, "conflict") == ()


def test_what_is_required_and_forbidden_is_a_conflict_whoever_causes_it() -> None:
    text = DSL.format("R1 when A then C R2 when A then not C")
    assert [finding.rules for finding in findings(text, "conflict")] == [("R1", "R2")]
    assert [finding.rules for finding in findings(text, "forbidden-input")] == [("R2",)]
