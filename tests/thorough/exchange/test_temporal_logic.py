"""The formulas of metric temporal logic agree with the evaluator of traces, on random rulesets and traces."""

from __future__ import annotations

from fractions import Fraction
from random import Random

import pytest

from sleec_runtime.evaluation.formula_truth import Situation, truth
from sleec_runtime.evaluation.trace import Instant, Trace
from sleec_runtime.evaluation.trace_violations import claim_holds, violations
from sleec_runtime.model import Atom, Context, leaves
from sleec_verify.exchange.compilation.temporal_logic import (
    AllOf,
    Always,
    Before,
    Eventually,
    Holds,
    Implies,
    OneOf,
    WeakUntil,
    claims_of,
    requirements,
)
from tests.support.timed_strategies import timed_ruleset


class Semantics:
    """The textbook semantics of the logic on one finite trace."""

    def __init__(self, ruleset, instants) -> None:
        self.measures = ruleset.measures
        self.instants = instants

    def state(self, formula, at: int) -> bool:
        instant = self.instants[at]
        obliged = {a.name: a.name in instant.events for a in leaves(formula) if isinstance(a, Atom)}
        situation = Situation(Context(instant.events, instant.conditions), self.measures, obliged=obliged)
        return bool(truth(formula, situation))

    def seconds(self, bound, at: int):
        values = {n: Fraction(v) for n, v in self.instants[at].conditions.items() if not isinstance(v, (bool, str))}
        return sum((length.seconds_where(values) for length in bound), Fraction(0))

    def within(self, window, at: int):
        first = self.instants[at].time + self.seconds(window.start, at)
        last = None if window.end is None else self.instants[at].time + self.seconds(window.end, at)
        return (n for n, i in enumerate(self.instants) if first <= i.time and (last is None or i.time <= last))

    def holds(self, formula, at: int) -> bool:
        if isinstance(formula, Holds):
            return self.state(formula.formula, at)
        if isinstance(formula, AllOf):
            return all(self.holds(part, at) for part in formula.parts)
        if isinstance(formula, OneOf):
            return any(self.holds(part, at) for part in formula.parts)
        if isinstance(formula, Implies):
            return not self.state(formula.condition, at) or self.holds(formula.consequence, at)
        if isinstance(formula, Eventually):
            return any(self.state(formula.part, n) for n in self.within(formula.window, at))
        if isinstance(formula, Always):
            return all(self.state(formula.part, n) for n in self.within(formula.window, at))
        if isinstance(formula, Before):
            return any(self.state(formula.part, n) for n in range(at))
        assert isinstance(formula, WeakUntil)
        for n in range(at, len(self.instants)):
            if formula.duration is not None:
                over = self.instants[at].time + self.seconds((formula.duration,), at)
                if self.instants[n].time >= over:
                    return True
            if formula.end is not None and self.state(formula.end, n):
                return True
            if not self.state(formula.part, n):
                return False
        return True


def random_trace(random: Random, ruleset) -> Trace:
    events = sorted({*ruleset.triggers, *(o.name for r in ruleset.rules for c in r.clauses() for o in c.obligations)})
    instants, time = [], 0
    for _ in range(random.randint(1, 4)):
        values = {}
        for measure in ruleset.measures.values():
            values[measure.name] = random.choice(measure.values) if measure.kind == "scale" else random.randint(0, 4)
        for name in ruleset.conditions:
            values[name] = random.random() < 0.5
        chosen = frozenset(e for e in events if random.random() < 0.45)
        instants.append(Instant(time, chosen, values))
        time += random.randint(1, 3)
    return Trace(tuple(instants))


@pytest.mark.parametrize("untimed", ["at", "eventually"])
@pytest.mark.parametrize("start", range(0, 400, 100))
def test_a_trace_violates_a_statement_where_its_formula_is_false(start, untimed):
    satisfied = violated = 0
    for seed in range(start, start + 100):
        random = Random(seed)
        ruleset = timed_ruleset(seed, named=seed % 2 == 0)
        for _ in range(10):
            trace = random_trace(random, ruleset)
            semantics = Semantics(ruleset, trace.instants)
            expected = {(v.time, id(v.statement)) for v in violations(ruleset, trace, untimed)}
            found = {
                (instant.time, id(one.statement))
                for one in requirements(ruleset, untimed)
                for at, instant in enumerate(trace.instants)
                if not semantics.holds(one.formula, at)
            }
            assert found == expected, ruleset.source.text
            satisfied += not found
            violated += bool(found)
            for claim, parts in claims_of(ruleset, untimed):
                occurs = all(any(semantics.holds(p, at) for at in range(len(trace.instants))) for p in parts)
                assert occurs == claim_holds(claim, ruleset, trace, untimed), ruleset.source.text
    assert satisfied > 50
    assert violated > 50
