"""Selected scenarios: what they reach, and that they are what the rules require."""

from __future__ import annotations

import json
from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path

import jsonschema
import pytest

from sleec_runtime.language import parse
from sleec_verify.conformance.cases.goals import CRITERIA
from sleec_verify.conformance.cases.reader import read_cases
from sleec_verify.conformance.scenarios.expectations import trace_of, unexpected
from sleec_verify.conformance.scenarios.scenario import Completion, Scenario, Step
from sleec_verify.conformance.scenarios.selection import Scenarios, choose_scenarios
from sleec_verify.conformance.scenarios.writer import json_text, toml
from sleec_verify.results.timeline import Due
from tests.support.schemas import SCHEMAS

FALL = """
RULE fall
WHEN UserFell THEN CallNurse WITHIN 5 minutes
  OTHERWISE (CallAmbulance WITHIN 2 minutes UNLESS Alone IN WHICH CASE CallNeighbour)
"""
REST = """
RULE rest
WHEN UserSleeps THEN NOT Vacuum WITHIN 1 hour
RULE dust
WHEN DustSeen THEN Vacuum WITHIN 1 day
"""


MISSED = "fall (default): CallNurse within 5 minutes missed (default), CallAmbulance within 2 minutes"


def chosen(text: str, criterion: str = "clause", single: bool = False) -> Scenarios:
    ruleset = parse(text)
    found = choose_scenarios(ruleset, criterion, single=single)
    for one in found.scenarios:
        assert not list(unexpected(ruleset, one))
    return found


def dues(one: Scenario) -> Iterable[Due]:
    return (*one.obligations, *(one.prohibitions or ()))


def test_windows_are_met_and_missed() -> None:
    found = chosen(FALL)
    assert {goal for one in found.scenarios for goal in one.reaches} == {
        "fall (default)",
        "fall (default): CallNurse within 5 minutes met at the first second",
        "fall (default): CallNurse within 5 minutes met at the last second",
        "fall (default): CallNurse within 5 minutes missed (default)",
        "fall (default): CallNurse within 5 minutes missed (Alone)",
        f"{MISSED} met at the first second",
        f"{MISSED} met at the last second",
    }
    assert (found.reached, found.unreached) == (7, ())
    assert len(found.scenarios) == 5
    (late,) = (one for one in found.scenarios if f"{MISSED} met at the last second" in one.reaches)
    assert late.steps == (Step(0, ("UserFell",), {"Alone": False}),)
    assert late.completions == (Completion("CallNurse", 0, None), Completion("CallAmbulance", 300, 420))
    assert [(due.event, due.start, due.end) for due in late.obligations] == [
        ("CallNurse", 0, 300),
        ("CallAmbulance", 300, 420),
    ]
    assert late.end == 420


def test_prohibitions_at_their_borders() -> None:
    found = chosen(REST)
    (border,) = (one for one in found.scenarios if any("in force" in goal for goal in one.reaches))
    assert {"UserSleeps", "DustSeen"} <= set(border.steps[0].when) | set(border.steps[-1].when)
    assert any(step.at == 3600 and "DustSeen" in step.when for step in border.steps)
    assert 3601 in [one.at for one in border.completions]
    assert any("over one second later" in goal for one in found.scenarios for goal in one.reaches)


def test_goals_of_independent_rules_share_scenarios() -> None:
    found = chosen(FALL + REST)
    assert len(found.scenarios) == len(chosen(FALL).scenarios) + 1
    assert found.scenarios[-1].reaches == ("rest (default): NOT Vacuum within 1 hour in force at the last second",)


def test_a_runtime_can_start_what_is_due() -> None:
    """Only the last scenario of `rest` asks for something at a time at which it is forbidden."""
    ruleset = parse(REST + "RULE night WHEN NightBegins THEN Vacuum WITHIN 2 hours AND LockDoor WITHIN 1 hour")
    for one in choose_scenarios(ruleset, "clause").scenarios:
        forbidden = [(due.start, due.end) for due in one.prohibitions or ()]
        asked = [due.start for due in one.obligations if due.event == "Vacuum"]
        blocked = any(start <= at <= end for at in asked for start, end in forbidden if end is not None)
        assert blocked == any("in force" in goal for goal in one.reaches)


def test_what_cannot_be_reached_has_a_reason() -> None:
    found = chosen("RULE a WHEN A THEN X WITHIN 5 seconds\nRULE b WHEN A THEN X WITHIN 3 seconds")
    assert [(one.name, one.why) for one in found.unreached] == [
        ("a (default): X within 5 seconds met at the last second", "only if a rule is violated")
    ]
    found = chosen("RULE a WHEN A THEN X WITHIN 5 seconds UNLESS m AND NOT m IN WHICH CASE Y")
    assert [(one.name, one.why) for one in found.unreached] == [("a.hc1", "in no trace")]


def test_one_input_at_a_time() -> None:
    found = chosen(REST, single=True)
    assert all(len(step.when) <= 1 for one in found.scenarios for step in one.steps)
    text = """def_start event A event B event X event Y def_end
    relation_start witness A B relation_end
    rule_start R1 when A then X within 5 seconds R2 when B then Y within 5 seconds rule_end"""
    assert {one.why for one in chosen(text, single=True).unreached} == {"only if other events also occur"}


def test_a_history_is_added_where_a_relation_needs_it() -> None:
    text = """def_start event A event B event X def_end
    relation_start happenBefore A B relation_end
    rule_start R1 when B then X within 10 seconds rule_end"""
    for one in chosen(text).scenarios:
        assert [step.when for step in one.steps[:2]] == [("A",), ("B",)]


def test_consequences_are_included() -> None:
    found = chosen("RULE a WHEN A THEN B WITHIN 5 seconds\nRULE b WHEN B THEN C WITHIN 3 seconds")
    assert any({"B", "C"} <= {due.event for due in one.obligations} for one in found.scenarios)


@pytest.mark.parametrize("criterion", sorted(CRITERIA))
def test_a_file_is_read_as_it_was_written(criterion: str, tmp_path: Path) -> None:
    ruleset = parse("MEASURE Age: number\n" + FALL + REST.replace("UserSleeps THEN", "UserSleeps AND Age < 0.5 THEN"))
    found = choose_scenarios(ruleset, criterion)
    path = tmp_path / "a.cases.toml"
    path.write_text(toml(ruleset, criterion, found, None), encoding="utf-8")
    for one, again in zip(found.scenarios, read_cases(path, ruleset).scenarios, strict=True):
        assert [replace(due, words="") for due in dues(again)] == [replace(due, words="") for due in dues(one)]
        assert (again.steps, again.completions, again.end, again.reaches) == (
            one.steps,
            one.completions,
            one.end,
            one.reaches,
        )
        assert trace_of(again) == trace_of(one)
    jsonschema.validate(json.loads(json_text(ruleset, criterion, found, None)), SCHEMAS["cases"])


def test_what_a_wrong_file_states() -> None:
    ruleset = parse(FALL)
    one = chosen(FALL).scenarios[0]
    late = tuple(replace(due, end=301) if due.end == 300 else due for due in one.obligations)
    assert list(unexpected(ruleset, replace(one, obligations=late))) == [
        "obligation that the rules do not require: `CallNurse` from 0 to 301 seconds (rule `fall`)",
        "obligation that the case does not state: `CallNurse` from 0 to 300 seconds (rule `fall`)",
    ]
    assert "violated at 0: RULE fall" in list(unexpected(ruleset, replace(one, obligations=())))


@pytest.mark.parametrize("criterion", CRITERIA)
def test_the_test_causes_no_obligation(criterion: str) -> None:
    """Whether it is met at once or late, and where several rules require it: the robot executes it."""
    both = "RULE r0 WHEN T0 THEN A0\nUNLESS c IN WHICH CASE (A1 AND A0 WITHIN 2 seconds)\n"
    both += "RULE r1 WHEN T1 THEN (A0 WITHIN 2 seconds AND A2)\n"
    again = "RULE r WHEN T THEN (A WITHIN 1 TO 2 seconds OTHERWISE A) AND (B WITHIN 1 TO 2 seconds ELSE C)\n"
    for text in (both, again):
        caused = {name for one in chosen(text, criterion).scenarios for step in one.steps for name in step.when}
        assert caused <= {"T", "T0", "T1"}
