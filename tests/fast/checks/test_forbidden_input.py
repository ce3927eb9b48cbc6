"""Rules that forbid an input are reported; those that forbid an act of the robot are not."""

from __future__ import annotations

import pytest

from sleec_runtime.language import parse
from sleec_verify.checks import run_checks
from sleec_verify.results.finding import Finding

DOOR = "RULE door\nWHEN Rings THEN Open\n"
REST = "RULE rest\nWHEN Sleeps THEN NOT Rings\n"


def findings(text: str, chains: bool = True) -> tuple[Finding, ...]:
    (result,) = run_checks(parse(text), ["forbidden-input"], chains=chains)
    return result.findings


@pytest.mark.parametrize(
    "response", ["NOT Rings", "NOT Rings WITHIN 1 hour", "NOT Rings OTHERWISE Wake", "Wake ELSE NOT Rings"]
)
def test_a_rule_that_forbids_an_input_is_reported(response: str) -> None:
    (finding,) = findings(f"RULE rest\nWHEN Sleeps THEN {response}\n{DOOR}")
    assert (finding.code, finding.rules, finding.clauses) == ("SLEEC107", ("rest", "door"), (("rest", 0),))
    assert "`Rings`, which triggers `door` and which no rule requires" in finding.message


@pytest.mark.parametrize(
    "more", ["RULE ring\nWHEN Visit THEN Rings\n", "EVENT Rings BY system\nTRIGGER Sleeps\nOBLIGATION Open\n"]
)
def test_what_the_robot_does_is_no_input(more: str) -> None:
    assert findings(more + REST + DOOR) == ()


def test_an_act_that_triggers_no_rule_is_no_input() -> None:
    assert findings(REST) == ()


def test_in_the_reading_of_one_step_a_response_is_no_input() -> None:
    assert findings(REST + DOOR, chains=False) == ()


def test_a_rule_that_forbids_its_own_trigger_is_a_conflict_instead() -> None:
    results = {one.name: one.findings for one in run_checks(parse("RULE a\nWHEN A THEN NOT A\n"))}
    assert results["forbidden-input"] == ()
    assert [finding.rules for finding in results["conflict"]] == [("a",)]
