"""The oracle for rules with times, itself tested: what it shows is replayed, and on tiny rulesets its answers are those
of going through every trace."""

from __future__ import annotations

from functools import cache
from itertools import combinations, product
from typing import Any

import pytest

from sleec_runtime.evaluation import holds
from sleec_runtime.language import parse
from sleec_runtime.model import Context
from sleec_runtime.model_time import claims
from sleec_runtime.trace import Instant, Trace, Untimed, broken, broken_so_far, claim_holds
from tests import timed_oracle as oracle
from tests.timed_strategies import timed_ruleset

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
            assert {law for law, _ in broken(ruleset, trace(answer.moments), untimed)} == {rule}
        answer = oracle.vacuous(ruleset, rule.label, untimed=untimed)
        if answer.moments is not None:
            assert not answer.found
            assert not broken(ruleset, trace(answer.moments), untimed)
            assert any(rule.trigger in moment.events for moment in answer.moments)
        answer = oracle.conflict(ruleset, rule.label, untimed=untimed)
        assert answer.found == (answer.moments is not None)
        if answer.moments is not None:
            now = answer.moments[-1].time
            assert not broken_so_far(ruleset, trace(answer.moments), untimed)
            assert broken(ruleset, trace(answer.continued), untimed) == ((rule, now),)
    for claim in (*claims(ruleset, "concern"), *claims(ruleset, "purpose")):
        answer = oracle.concern(ruleset, claim, untimed=untimed)
        assert answer.found == (answer.moments is not None)
        assert oracle.purpose(ruleset, claim, untimed=untimed).found != answer.found
        if answer.moments is not None:
            assert not broken(ruleset, trace(answer.moments), untimed)
            assert claim_holds(claim, ruleset, trace(answer.moments), untimed)


# All traces -----------------------------------------------------------------------------------------------

UNTIL = AFTER = 2
HORIZON = UNTIL + AFTER
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


def as_key(instants):
    return tuple((i.time, i.events, i.conditions["m"]) for i in instants)


def histories(whole, now):
    """What may have been so far, where all of `whole` is what it is continued to: fewer events now."""
    *past, last = whole.instants[: now + 1]
    for size in range(len(last.events) + 1):
        for events in combinations(sorted(last.events), size):
            yield (*past, Instant(last.time, frozenset(events), last.conditions))


def conflict_by_brute_force(ruleset, rule, broken_by, untimed):
    """With one instant before now, and one after it; now is not after second `UNTIL`, the end not `AFTER` that."""
    continued: set[Any] = set()
    but_for_the_rule = {}
    for whole, found in broken_by:
        for now in range(max(0, len(whole.instants) - 2), min(2, len(whole.instants))):
            time = whole.instants[now].time
            if time > UNTIL or whole.instants[-1].time > time + AFTER:
                continue
            if not found:
                continued.update(map(as_key, histories(whole, now)))
            elif found == ((rule, time),):
                but_for_the_rule.update({as_key(history): history for history in histories(whole, now)})
    return any(
        triggered(rule, history[-1]) and not broken_so_far(ruleset, Trace(history), untimed)
        for key, history in but_for_the_rule.items()
        if key not in continued
    )


@seeds(12, 300)
def test_the_answers_are_those_of_all_traces(seed):
    ruleset = tiny_ruleset(seed)
    untimed = UNTIMED[seed % 2]
    broken_by = [(whole, broken(ruleset, whole, untimed)) for whole in all_traces()]
    kept = [whole for whole, found in broken_by if not found]
    for rule in ruleset.rules:
        alone = any({law for law, _ in found} == {rule} for _, found in broken_by)
        assert oracle.redundant(ruleset, rule.label, INSTANTS, untimed, HORIZON).found == (not alone)
        possible = any(triggered(rule, Instant(0, frozenset({rule.trigger}), {"m": m})) for m in (False, True))
        at_work = any(triggered(rule, instant) for whole in kept for instant in whole.instants)
        assert oracle.vacuous(ruleset, rule.label, INSTANTS, untimed, HORIZON).found == (possible and not at_work)
        found = oracle.conflict(ruleset, rule.label, 1, 1, 1, untimed, UNTIL, AFTER).found
        assert found == conflict_by_brute_force(ruleset, rule, broken_by, untimed)
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
        # Both bite now; each alone could be kept.
        (rules("A then B", "A then not B"), [True, True]),
        (rules("A and {m} then B", "A and (not {m}) then not B"), [False, False]),
        # The prohibition of the past has the obligation of now fail, not the other way round.
        (rules("A then B within 1 seconds", "C then not B within 3 seconds"), [True, True]),
        # By a chain: D is due one second after B, and forbidden then.
        (rules("A then B", "B then D within [1, 1] seconds", "A then not D within 2 seconds"), [True, True, True]),
        # There is a way out.
        (rules("A then B otherwise C", "A then not B"), [False, False]),
        # Through relations.
        (rules("A then B", relations="mutualExclusive A B"), [True]),
        (rules("A then B", relations="forbid B {m}"), [True]),
        (rules("A then B", relations="happenBefore C B"), [True]),
        (rules("A then B within 1 seconds", relations="happenBefore C B"), [False]),
        # What no history can avoid is no conflict of a rule; nor what is broken already.
        (rules("A then not A"), [False]),
        (rules("A then B", relations="measure invariant false"), [False]),
    ],
)
def test_conflicts(ruleset, expected):
    assert [oracle.conflict(ruleset, rule.label).found for rule in ruleset.rules] == expected


def test_redundant_and_vacuous_rules():
    ruleset = rules("A then B within 2 seconds", "A then B within 1 seconds", "C then D", "C then not D", "D then D")
    assert [oracle.redundant(ruleset, r.label).found for r in ruleset.rules] == [True, False, False, False, True]
    assert [oracle.vacuous(ruleset, r.label).found for r in ruleset.rules] == [False, False, True, True, False]


def test_a_rule_whose_guard_is_false_is_not_vacuous():
    assert not oracle.vacuous(rules("A and ({m} and (not {m})) then B"), "R1").found


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
    assert not broken(ruleset, trace(found.moments))
