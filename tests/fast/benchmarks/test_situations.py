"""The situations of the evaluation: every context of every rule, also when several share a situation."""

from __future__ import annotations

from benchmarks.evaluation.situations import (
    GroundTruth,
    Reported,
    Situation,
    every_situation,
    packed,
    random_situations,
)
from sleec_runtime.language import parse

RULESET = parse("""
MEASURE Age: number
MEASURE Risk: low < high
DOMAIN home
RULE one WHEN A THEN X UNLESS C IN WHICH CASE Y UNLESS Age < 18 IN WHICH CASE Z
RULE two WHEN B THEN X UNLESS C AND Risk = high IN WHICH CASE Y
DOMAIN ward
RULE three WHEN A THEN W
""")


def test_every_context_has_the_values_next_to_thresholds() -> None:
    cases = every_situation(RULESET)
    contexts = [case.conditions for rule, case in cases if rule.label == "one" and case.domain == "home"]
    assert len(contexts) == 12
    assert {context["Age"] for context in contexts} == {None, 17, 18, 19}
    assert {context["C"] for context in contexts} == {None, True, False}
    assert len(cases) == 2 * (12 + 9 + 1)


def test_packed_situations_have_every_context() -> None:
    cases = every_situation(RULESET)
    situations = packed(cases)
    assert len(situations) < len(cases) / 1.5
    for _, case in cases:
        assert any(
            one.domain == case.domain and one.conditions.items() >= case.conditions.items() for one in situations
        )
    assert all(one.conditions.keys() == {"C", "Age", "Risk"} for one in situations)


def test_ground_truth_is_that_of_the_domain() -> None:
    truth = GroundTruth(RULESET)
    known: dict[str, Reported] = {"C": True, "Age": 17, "Risk": "low"}
    assert truth.obligations(Situation("home", known), "A") == ("Z",)
    assert truth.obligations(Situation("ward", known), "A") == ("W",)
    assert truth.obligations(Situation("ward", known), "B") == ()
    assert truth.obligations(Situation("home", {**known, "Age": None}), "A") == ("Y",)


def test_random_situations_can_be_repeated() -> None:
    assert random_situations(RULESET, 5) == random_situations(RULESET, 5)
    assert random_situations(RULESET, 5) != random_situations(RULESET, 5, seed=1)
