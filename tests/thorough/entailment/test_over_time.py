"""What is due in random situations of small rulesets with time, against explicit states (tests/support/explicit)."""

from __future__ import annotations

from dataclasses import replace
from itertools import combinations
from typing import Any

import pytest

from sleec_runtime.model import RELATIONS, Context, Ruleset
from sleec_verify.checks import run_checks
from sleec_verify.entailment.entailment import entail
from tests.support.explicit.conflicts import Explicit, TooLarge
from tests.support.timed_strategies import timed_ruleset

SIZE: dict[str, Any] = {
    "rules": 4,
    "events": 4,
    "booleans": 1,
    "scale": False,
    "longest": 3,
    "relations": 1,
    "hedges": 1,
}


def in_conflict(oracle: Explicit, events: frozenset[str], values: int) -> bool | None:
    """Whether no response complies with all rules, and this is a contradiction of rules: some of them are in conflict
    in the situation of some of these events, or the relations prevent every response, rather than that a rule forbids
    what occurs anyway. None if the relations exclude the situation, or if it has both."""
    state = oracle.before(events)
    if not oracle.complies(state, events, values, frozenset()):
        return None
    if oracle.complies(state, events, values, frozenset(range(len(oracle.rules)))):
        return False
    some = (frozenset(one) for n in range(1, len(events) + 1) for one in combinations(sorted(events), n))
    if any(oracle.minimal(state, one, values) for one in some):
        return True
    if not any(isinstance(one, RELATIONS) for one in oracle.ruleset.statements):
        return False
    free = Explicit(without_relations(oracle.ruleset))
    index = next(n for n, one in enumerate(free.values) if one.items() <= oracle.values[values].items())
    return True if free.complies(free.first, events, index, frozenset(range(len(free.rules)))) else None


def without_relations(ruleset: Ruleset) -> Ruleset:
    kept = tuple(one for one in ruleset.statements if not isinstance(one, RELATIONS))
    return replace(ruleset, statements=kept, inferred=tuple(ruleset.measures.values()))


@pytest.mark.parametrize("seed", range(0, 4000, 40))
@pytest.mark.parametrize("named", [False, True])
def test_situations_against_explicit_states(seed: int, named: bool) -> None:
    for one in range(seed, seed + 10):
        ruleset = timed_ruleset(one, named=named, **SIZE)
        oracle = Explicit(ruleset, most=3000)
        try:
            for events in oracle.subsets:
                if events and events <= oracle.inputs:
                    for number, values in enumerate(oracle.values):
                        expected = in_conflict(oracle, events, number)
                        answer = entail(ruleset, Context(events & ruleset.triggers, values))
                        if None not in (answer.consistent, expected) and events <= ruleset.triggers:
                            assert (answer.consistent is False) == expected, (ruleset.source.text, events, values)
        except TooLarge:
            continue


@pytest.mark.parametrize("seed", range(0, 2000, 40))
def test_conflicts_of_one_instant_are_contradictions_in_their_situation(seed: int) -> None:
    for one in range(seed, seed + 10):
        ruleset = timed_ruleset(one, **SIZE)
        (result,) = run_checks(ruleset, ["conflict"])
        for finding in result.findings:
            assert finding.witness is not None
            if finding.timeline is None or len(finding.timeline.moments) == 1:
                answer = entail(ruleset, finding.witness.context())
                # A condition that the witness leaves open counts as false here, which a relation can exclude.
                if not answer.broken_assumptions:
                    assert answer.consistent is not True, (ruleset.source.text, finding.message)
