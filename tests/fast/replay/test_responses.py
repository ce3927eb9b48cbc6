"""Responses found by the evaluator, against the explicit automaton of the tests."""

from __future__ import annotations

import random

import pytest

from sleec_runtime.evaluation.trace import Instant, Trace
from sleec_runtime.language import parse
from sleec_verify.replay.responses import Open, Responses
from tests.support.explicit.conflicts import Explicit, State, TooLarge

RELATIONS = (
    "mutualExclusive A B",
    "mutualExclusive C D",
    "witness B C",
    "equal A D",
    "happenBefore B D",
    "when A then {b0} until C",
    "when B then {b0} for 1 seconds",
    "includes B {b0}",
    "causation C {b0}",
    "forbid D {b0}",
    "measure invariant ({b0} or ({r} >= middle))",
)


def random_rules(seed: int) -> str:
    """Three rules in the DSL, most with a window of at most two seconds, and often with an alternative."""
    chance = random.Random(seed)

    def response(depth: int = 0) -> str:
        text = f"{'not ' if chance.random() < 0.4 else ''}{chance.choice('ABCD')}"
        if chance.random() < 0.6:
            start = chance.randint(0, 1)
            window = f"within [{start},{start + chance.randint(0, 1)}]" if chance.random() < 0.3 else "within 2"
            text += f" {window} seconds" if chance.random() < 0.85 else " eventually"
        if depth == 0 and chance.random() < 0.35:
            text += f" {chance.choice(('otherwise', 'else'))} {response(1)}"
        return text

    lines = ["def_start", *(f"  event {event}" for event in "ABCD"), "  measure b0: boolean"]
    lines += ["  measure r: scale(low, middle, high)", "def_end", "rule_start"]
    for number in range(1, 4):
        rule = f"{chance.choice('ABCD')}{' and {b0}' if chance.random() < 0.3 else ''} then {response()}"
        if chance.random() < 0.3:
            condition = chance.choice(("{b0}", "({r} >= middle)"))
            rule += f" unless {condition}{' then {' + response() + '}' if chance.random() < 0.7 else ''}"
        lines.append(f"  R{number} when {rule}")
    lines.append("rule_end")
    if chance.random() < 0.6:
        lines += ["relation_start", f"  {chance.choice(RELATIONS)}", "relation_end"]
    return "\n".join(lines) + "\n"


def agreement(seeds: range) -> tuple[int, int, int]:
    """How many questions are answered with yes, with no, and left open. The answers agree with the automaton."""
    yes = no = undecided = 0
    for seed in seeds:
        ruleset = parse(random_rules(seed))
        oracle, chance = Explicit(ruleset), random.Random(seed)
        every = frozenset(range(len(oracle.rules)))
        for _ in range(6):
            state, history = a_history(oracle, chance, every)
            given = frozenset(event for event in sorted(oracle.inputs) if chance.random() < 0.5)
            values = chance.randrange(len(oracle.values))
            now = Instant(4, given, oracle.values[values])
            chosen = frozenset(number for number in every if chance.random() < 0.7)
            try:
                if not oracle.complies(state, given, values, frozenset()):
                    # The relations exclude these inputs, so that it is no situation.
                    continue
                expected = oracle.complies(state, given, values, chosen)
                labels = {oracle.rules[number].label for number in chosen}
                found = Responses(ruleset, Trace((*history, now))).complying(labels)
            except (TooLarge, Open):
                undecided += 1
                continue
            assert (found is not None) == expected, (seed, history, now, labels, found, random_rules(seed))
            yes, no = yes + expected, no + (not expected)
    return yes, no, undecided


def a_history(oracle: Explicit, chance: random.Random, rules: frozenset[int]) -> tuple[State, list[Instant]]:
    """A lawful history of four seconds, with at most four instants."""
    state, history = oracle.first, []
    for time in range(4):
        events = frozenset(event for event in sorted(oracle.events) if chance.random() < 0.25)
        values = chance.randrange(len(oracle.values))
        after = oracle.after(state, events, values, rules) if events else None
        if after is not None and not any(False in demands for demands in after.pending):
            state = after
            history.append(Instant(time, events, oracle.values[values]))
        else:
            state = oracle.after_silence(state)
            if any(False in demands for demands in state.pending):
                return oracle.first, []
    return state, history


def test_agreement_with_explicit_states() -> None:
    yes, no, undecided = agreement(range(40))
    assert min(yes - 60, no - 15) >= 0, (yes, no)
    assert undecided <= 20


@pytest.mark.slow
def test_agreement_of_more_rulesets_with_explicit_states() -> None:
    agreement(range(40, 400))
