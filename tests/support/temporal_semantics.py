"""The textbook semantics of metric temporal logic on finite traces (J. Ouaknine and J. Worrell, "Some recent results in
metric temporal logic", FORMATS 2008, the pointwise semantics)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction

from sleec_runtime.evaluation.formula_truth import Situation, truth
from sleec_runtime.evaluation.trace import Instant
from sleec_runtime.model import Atom, Context, Formula, Rational, Ruleset, leaves
from sleec_verify.exchange.compilation.temporal_logic import (
    AllOf,
    Always,
    Before,
    Bound,
    Eventually,
    Holds,
    Implies,
    OneOf,
    Temporal,
    WeakUntil,
    Window,
)


class Semantics:
    """The truth of formulas at the instants of one trace, by their numbers from 0."""

    def __init__(self, ruleset: Ruleset, instants: Sequence[Instant]) -> None:
        self.measures = ruleset.measures
        self.instants = instants

    def state(self, formula: Formula, at: int) -> bool:
        instant = self.instants[at]
        obliged = {a.name: a.name in instant.events for a in leaves(formula) if isinstance(a, Atom)}
        situation = Situation(Context(instant.events, instant.conditions), self.measures, obliged=obliged)
        return bool(truth(formula, situation))

    def seconds(self, bound: Bound, at: int) -> Rational:
        values = {n: Fraction(v) for n, v in self.instants[at].conditions.items() if not isinstance(v, (bool, str))}
        return sum((length.seconds_where(values) for length in bound), Fraction(0))

    def within(self, window: Window, at: int) -> Iterator[int]:
        first = self.instants[at].time + self.seconds(window.start, at)
        last = None if window.end is None else self.instants[at].time + self.seconds(window.end, at)
        return (n for n, i in enumerate(self.instants) if first <= i.time and (last is None or i.time <= last))

    def holds(self, formula: Temporal, at: int) -> bool:
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
