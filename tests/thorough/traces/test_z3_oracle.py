"""The oracle for rules with times, itself tested: what it shows is replayed, and on tiny rulesets its answers are those
of going through every trace."""

from __future__ import annotations

from functools import cache
from itertools import combinations, product

import pytest

from sleec_runtime.evaluation.formula_truth import holds
from sleec_runtime.evaluation.trace import Instant, Trace, Untimed
from sleec_runtime.evaluation.trace_violations import claim_holds, violations, violations_so_far
from sleec_runtime.language import parse
from sleec_runtime.model import Context, claims
from tests.support import z3_oracle as oracle
from tests.support.timed_agreement import conflicts
from tests.support.timed_strategies import timed_ruleset

UNTIMED: tuple[Untimed, ...] = ("at", "eventually")


def seeds(few, many):
    """`few` of them always, up to `many` in the long run."""
    return pytest.mark.parametrize(
        "seed", [*range(few), *(pytest.param(n, marks=pytest.mark.long) for n in range(few, many))]
    )


def trace(moments):
    return Trace(tuple(Instant(*moment) for moment in moments))


# What it shows is so --------------------------------------------------------------------------------------


@seeds(8, 200)
def test_every_model_is_replayed(seed):
    ruleset = timed_ruleset(seed)
    untimed = UNTIMED[seed % 2]
    for rule in ruleset.rules:
        answer = oracle.redundant(ruleset, rule.label, untimed=untimed)
        assert answer.found == (answer.moments is None)
        if answer.moments is not None:
            assert {law for law, _ in violations(ruleset, trace(answer.moments), untimed)} == {rule}
        answer = oracle.vacuous(ruleset, rule.label, untimed=untimed)
        if answer.moments is not None:
            assert not answer.found
            assert not violations(ruleset, trace(answer.moments), untimed)
            assert any(rule.trigger in moment.events for moment in answer.moments)
    for claim in (*claims(ruleset, "concern"), *claims(ruleset, "purpose")):
        answer = oracle.concern(ruleset, claim, untimed=untimed)
        assert answer.found == (answer.moments is not None)
        assert oracle.purpose(ruleset, claim, untimed=untimed).found != answer.found
        if answer.moments is not None:
            assert not violations(ruleset, trace(answer.moments), untimed)
            assert claim_holds(claim, ruleset, trace(answer.moments), untimed)


# All traces -----------------------------------------------------------------------------------------------


HORIZON = 4
INSTANTS = 3
VALUES = [(frozenset(events), {"m": m}) for events in (set(), {"A"}, {"B"}, {"A", "B"}) for m in (False, True)]


@cache
def all_traces():
    """Of two events and one condition: up to three instants, none after second 4."""
    return [
        Trace(tuple(Instant(time, *value) for time, value in zip(times, values)))
        for size in range(INSTANTS + 1)
        for times in combinations(range(HORIZON + 1), size)
        for values in product(VALUES, repeat=size)
    ]


def tiny_ruleset(seed):
    """Of the same events and condition."""
    return timed_ruleset(seed, rules=3, events=2, booleans=1, scale=False, longest=2, relations=1)


def triggered(rule, instant):
    """Whether the rule speaks of this instant."""
    guarded = rule.guard is None or holds(rule.guard, Context(instant.events, instant.conditions))
    return rule.trigger in instant.events and guarded


@seeds(12, 300)
def test_the_answers_are_those_of_all_traces(seed):
    ruleset = tiny_ruleset(seed)
    untimed = UNTIMED[seed % 2]
    broken_by = [(whole, violations(ruleset, whole, untimed)) for whole in all_traces()]
    kept = [whole for whole, found in broken_by if not found]
    for rule in ruleset.rules:
        alone = any({law for law, _ in found} == {rule} for _, found in broken_by)
        assert oracle.redundant(ruleset, rule.label, INSTANTS, untimed, HORIZON).found == (not alone)
        possible = any(triggered(rule, Instant(0, frozenset({rule.trigger}), {"m": m})) for m in (False, True))
        at_work = any(triggered(rule, instant) for whole in kept for instant in whole.instants)
        assert oracle.vacuous(ruleset, rule.label, INSTANTS, untimed, HORIZON).found == (possible and not at_work)
    for claim in (*claims(ruleset, "concern"), *claims(ruleset, "purpose")):
        comes_about = any(claim_holds(claim, ruleset, whole, untimed) for whole in kept)
        assert oracle.concern(ruleset, claim, INSTANTS, untimed, HORIZON).found == comes_about
        assert oracle.purpose(ruleset, claim, INSTANTS, untimed, HORIZON).found == (not comes_about)


# Known answers --------------------------------------------------------------------------------------------

DEFINITIONS = "def_start\nevent A\nevent B\nevent C\nevent D\nmeasure m: boolean\nmeasure n: boolean\ndef_end\n"


def rules(*texts, relations=""):
    lines = "".join(f"R{number} when {text}\n" for number, text in enumerate(texts, 1))
    more = f"relation_start\n{relations}\nrelation_end\n" if relations else ""
    return parse(f"{DEFINITIONS}rule_start\n{lines}rule_end\n{more}")


@pytest.mark.parametrize(
    ("ruleset", "expected"),
    [
        (rules("A then B", "A then not B"), [("R1", "R2")]),
        (rules("A and {m} then B", "A and (not {m}) then not B"), []),
        # A deadline that a prohibition outlasts.
        (rules("A then B within 3 seconds", "C then not B within 2 seconds"), [("R1", "R2")]),
        (rules("A then B within 2 seconds otherwise D within 1 seconds", "C then not B within 3 seconds"), []),
        # By a chain.
        (rules("A then B", "B then not C", "A then C"), [("R2", "R3")]),
        (rules("A then B", "B then not D"), []),
        # Through relations; no rule requires C.
        (rules("A then B", relations="mutualExclusive B C"), []),
        (rules("A then B", "A then B", "D then C", relations="mutualExclusive B C"), [("R1", "R3"), ("R2", "R3")]),
        (rules("A then B", relations="forbid B {m}"), [("R1",)]),
        # A rule that forbids an input is no conflict; one that forbids its own trigger is.
        (rules("A then not B", "B then C"), []),
        (rules("A then not A"), [("R1",)]),
    ],
)
def test_conflicts(ruleset, expected):
    assert conflicts(ruleset) == {frozenset(labels) for labels in expected}


def test_the_history_of_a_conflict_is_lawful():
    ruleset = rules("A then B within 3 seconds", "C then not B within 2 seconds")
    found = oracle.conflict(ruleset, ("R1", "R2"))
    assert found.moments is not None
    assert not violations_so_far(ruleset, trace(found.moments))


def test_redundant_and_vacuous_rules():
    ruleset = rules("A then B within 2 seconds", "A then B within 1 seconds", "C then D", "C then not D", "D then D")
    assert [oracle.redundant(ruleset, r.label).found for r in ruleset.rules] == [True, False, False, False, True]
    assert [oracle.vacuous(ruleset, r.label).found for r in ruleset.rules] == [False, False, True, True, False]


def test_a_rule_whose_guard_is_false_is_not_vacuous():
    assert not oracle.vacuous(rules("A and ({m} and (not {m})) then B"), "R1").found


@pytest.mark.parametrize(
    ("rule", "claim", "expected"),
    [
        # In place of what is not done in time, at the end of the time.
        ("A then B within 2 seconds otherwise C", "exists A while not B within 2 seconds while not C", True),
        ("A then B within 2 seconds otherwise C", "exists A while not B while not C within 2 seconds", True),
        (
            "A then B within 2 seconds otherwise C",
            "exists A while not B within 2 seconds while not C within [2, 2] seconds",
            False,
        ),
        (
            "A then B within 1 second otherwise C within 2 seconds",
            "exists A while not B within 1 second while not C within [1, 3] seconds",
            False,
        ),
        (
            "A then B within 1 second otherwise C within 2 seconds",
            "exists A while not B within 1 second while not C within 2 seconds",
            True,
        ),
        # In place of it, at once.
        ("A then B within 2 seconds else C", "exists A while not B within 2 seconds while not C", False),
        ("A then B eventually otherwise C", "exists A while not B eventually while not C", False),
        ("A then B otherwise C", "exists A while not B while C", True),
    ],
)
def test_what_is_due_in_place_of_a_response(rule, claim, expected):
    assert found_in(rules(rule), claim) is expected


@pytest.mark.parametrize(
    ("lasting", "claim", "expected"),
    [
        # D shows that m is false.
        ("when A then {m} for 2 seconds", "exists A while D within 1 second", False),
        ("when A then {m} for 2 seconds", "exists A while D within [2, 2] seconds", True),
        ("when A and {n} then {m} for 2 seconds", "exists A while D within 1 second", True),
        ("when A then {m} until B", "exists A while D within 1 second while not B within 1 second", False),
        ("when A then {m} until B", "exists A while D within [1, 1] seconds while B within [1, 1] seconds", True),
        ("when A then {m} until B and {m}", "exists A while D while B while not B within [1, 9] seconds", False),
    ],
)
def test_what_lasts(lasting, claim, expected):
    assert found_in(rules("C then C", relations=f"forbid D {{m}}\n{lasting}"), claim) is expected


def found_in(ruleset, claim):
    whole = parse(f"{ruleset.source.text}concern_start\nc1 {claim}\nconcern_end\n")
    (concern,) = claims(whole, "concern")
    return oracle.concern(whole, concern).found


def test_lengths_and_values_of_measures():
    definitions = "def_start\nevent A\nevent B\nmeasure x: numeric\nmeasure s: scale(low, high)\ndef_end\n"
    text = (
        "rule_start\nR1 when A and ({x} > 2) then B within [{x}, 5] seconds\n"
        "R2 when A and ({s} = low) then not B within 4 seconds\nrule_end\n"
        "concern_start\nc1 exists A and (({x} = 6) and ({s} = high))\nc2 exists A and ({x} = 5)\nconcern_end\n"
    )
    ruleset = parse(definitions + text)
    impossible, possible = claims(ruleset, "concern")
    assert not oracle.concern(ruleset, impossible).found
    found = oracle.concern(ruleset, possible)
    assert found.moments is not None
    assert claim_holds(possible, ruleset, trace(found.moments))
    assert not violations(ruleset, trace(found.moments))
