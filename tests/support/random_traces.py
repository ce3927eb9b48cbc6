"""Random rules with time, relations and claims, with traces of them: every feature of the semantics, in small."""

from __future__ import annotations

import random
from collections.abc import Iterator
from dataclasses import replace
from typing import NamedTuple

from sleec_runtime.evaluation.trace import Instant, Trace, Untimed
from sleec_runtime.model import (
    READINGS,
    SECONDS,
    And,
    Assume,
    Atom,
    Calculation,
    Claim,
    Clause,
    Comparison,
    Effect,
    EventRelation,
    EventRelationKind,
    Exclusive,
    Formula,
    Lasting,
    Length,
    Measure,
    MeasureRef,
    MeasureRelation,
    MeasureRelationKind,
    Never,
    Not,
    Number,
    Obligation,
    Operator,
    Or,
    Rule,
    Ruleset,
    ScaleValue,
    Statement,
    Timing,
    Truth,
    Unit,
    Value,
    Window,
)

OPERATORS: tuple[Operator, ...] = ("<", "<=", "=", "!=", ">=", ">")
BETWEEN_EVENTS: tuple[EventRelationKind, ...] = ("witness", "equal", "mutualExclusive", "happenBefore")
BETWEEN_MEASURES: tuple[MeasureRelationKind, ...] = ("imply", "iff", "mutualExclusive", "opposite", "invariant")
EVENTS = ("A", "B", "C", "D")
CONDITIONS = ("p", "q")
SCALE = ("low", "middle", "high")
MEASURES = (Measure("risk", "scale", SCALE), Measure("age", "integer"), Measure("patience", "integer"))


class Case(NamedTuple):
    ruleset: Ruleset
    untimed: Untimed
    claims: tuple[Claim, ...]
    traces: tuple[Trace, ...]


def random_cases(seed: int, rulesets: int, traces: int = 4) -> Iterator[Case]:
    for number in range(rulesets):
        draw = Draw(random.Random(f"{seed} {number}"))
        yield draw.case(traces)


class Draw:
    """What is drawn of one case, all of it in one unit of time."""

    def __init__(self, chance: random.Random) -> None:
        self.chance = chance
        self.unit: Unit = chance.choice(("seconds", "seconds", "minutes", "hours"))

    def case(self, traces: int) -> Case:
        chance = self.chance
        laws = [self.rule(number) for number in range(chance.randint(1, 2))]
        statements: list[Statement] = [*MEASURES, *laws, *(self.beside() for _ in range(chance.randint(0, 3)))]
        return Case(
            Ruleset(tuple(statements), chance.choice(READINGS)),
            chance.choice(("at", "eventually")),
            tuple(self.claim(f"c{number}") for number in range(2)),
            tuple(self.trace() for _ in range(traces)),
        )

    def sometimes(self, share: float) -> bool:
        return self.chance.random() < share

    # Rules ----------------------------------------------------------------------------------------------------

    def rule(self, number: int) -> Rule:
        hedges = [replace(self.clause(1), condition=self.occasion(2)) for _ in range(self.chance.choice((0, 0, 1, 2)))]
        guard = self.occasion(1) if self.sometimes(0.3) else None
        return Rule(f"r{number}", self.event(), guard, self.clause(2, least=1), tuple(hedges))

    def clause(self, depth: int, least: int = 0) -> Clause:
        """A response without a condition: its obligations, and sometimes a chain inside."""
        obligations = [self.obligation(depth) for _ in range(self.chance.choice((least, 1, 1, 2)))]
        inner = self.chance.randint(1, 2) if depth and self.sometimes(0.3) else 0
        hedges = [replace(self.clause(depth - 1), condition=self.occasion(1)) for _ in range(inner)]
        return Clause(None, tuple(obligations), tuple(hedges))

    def obligation(self, depth: int) -> Obligation:
        window = self.window() if self.sometimes(0.7) else None
        otherwise = self.clause(depth - 1) if depth and self.sometimes(0.3) else None
        instead = self.clause(depth - 1) if depth and self.sometimes(0.15) else None
        timing = Timing(window, otherwise, instead)
        return Obligation(self.event(), self.sometimes(0.35), timing=None if timing == Timing() else timing)

    def window(self) -> Window:
        kind = self.chance.randrange(6)
        if kind == 0:
            return Window(None)
        if kind == 1:
            start = self.chance.randint(0, 2)
            return Window(self.length(start + self.chance.randint(-1, 2)), self.length(start))
        return Window(self.measured() if kind == 2 else self.length(self.chance.randint(0, 3)))

    def length(self, amount: int) -> Length:
        return Length(Number(amount), self.unit)

    def measured(self) -> Length:
        """A length that measures give."""
        calculated = Calculation(((1, ("patience",)), (-1, ("age",)), (1, ())))
        return Length(calculated if self.sometimes(0.3) else MeasureRef("patience"), self.unit)

    # Relations, constraints and claims ------------------------------------------------------------------------

    def beside(self) -> Statement:
        chance = self.chance
        kind = chance.randrange(9)
        if kind < 2:
            return EventRelation(chance.choice(BETWEEN_EVENTS), self.event(), self.event())
        if kind == 2:
            name = chance.choice(BETWEEN_MEASURES)
            return MeasureRelation(name, self.formula(1), None if name == "invariant" else self.formula(1))
        if kind == 3:
            return Effect(chance.choice(("causation", "includes", "forbid")), self.event(), self.formula(1))
        if kind < 6:
            condition = self.formula(1) if self.sometimes(0.4) else None
            if self.sometimes(0.5):
                over = self.measured() if self.sometimes(0.3) else self.length(chance.randint(0, 3))
                return Lasting(self.event(), condition, self.formula(1), duration=over)
            ending = self.formula(1) if self.sometimes(0.4) else None
            return Lasting(self.event(), condition, self.formula(1), self.event(), ending)
        if kind == 6:
            return Exclusive(tuple(chance.sample(EVENTS, chance.randint(2, 3))))
        if self.sometimes(0.5):
            formula = self.formula(2, ("condition", "obligation", "obligation"))
            return Never(Not(formula) if self.sometimes(0.3) else formula)
        return Assume(self.formula(2, ("condition", "trigger")))

    def claim(self, label: str) -> Claim:
        return Claim(
            self.chance.choice(("concern", "purpose")),
            label,
            self.chance.choice(("exists", "when")),
            self.event(),
            self.occasion(1) if self.sometimes(0.5) else None,
            tuple(self.clause(1, least=1) for _ in range(self.chance.choice((0, 1, 1, 2)))),
            self.claim("") if self.sometimes(0.3) else None,
        )

    def event(self) -> str:
        return self.chance.choice(EVENTS)

    def occasion(self, depth: int) -> Formula:
        """A condition of a rule or claim, which may name events."""
        return self.formula(depth, ("condition", "condition", "trigger"))

    def formula(self, depth: int, kinds: tuple[str, ...] = ("condition",)) -> Formula:
        chance = self.chance
        shape = chance.randrange(7) if depth else chance.randrange(4)
        if shape == 0:
            return self.comparison() if self.sometimes(0.8) else Truth(self.sometimes(0.5))
        if shape < 4:
            kind = chance.choice(kinds)
            if kind == "trigger":
                return Atom("trigger", self.event())
            if kind == "obligation":
                return Atom("obligation", self.event())
            return Atom("condition", chance.choice(CONDITIONS))
        if shape == 4:
            return Not(self.formula(depth - 1, kinds))
        operands = tuple(self.formula(depth - 1, kinds) for _ in range(chance.randint(2, 3)))
        return And(operands) if shape == 5 else Or(operands)

    def comparison(self) -> Comparison:
        operator = self.chance.choice(OPERATORS)
        kind = self.chance.randrange(4)
        if kind == 0:
            return Comparison(MeasureRef("age"), operator, MeasureRef("patience"))
        if kind == 1:
            return Comparison(Calculation(((2, ("age",)), (-1, ("patience",)))), operator, Number(1))
        if kind == 2:
            return Comparison(MeasureRef("age"), operator, Number(self.chance.randint(0, 2)))
        rank = self.chance.randrange(len(SCALE))
        return Comparison(MeasureRef("risk"), operator, ScaleValue(SCALE[rank], rank))

    # Traces ---------------------------------------------------------------------------------------------------

    def trace(self) -> Trace:
        chance = self.chance
        time, instants = chance.randint(0, 2), []
        likely = chance.choice((0.15, 0.4, 0.7))
        for _ in range(chance.randint(0, 5)):
            instants.append(Instant(time, frozenset(e for e in EVENTS if self.sometimes(likely)), self.values()))
            # Most instants are whole units apart: at the bounds of windows.
            between = chance.choice((1, 1, 1, 2, 3)) * SECONDS[self.unit] + (chance.choice((-1, 0, 0, 1)))
            time += max(between, 1)
        return Trace(tuple(instants))

    def values(self) -> dict[str, Value]:
        """A value for what says how long, and for most of the rest."""
        values: dict[str, Value] = {"patience": self.chance.randint(-1, 3), "age": self.chance.randint(0, 2)}
        values.update({name: self.sometimes(0.5) for name in CONDITIONS if self.sometimes(0.9)})
        if self.sometimes(0.9):
            values["risk"] = self.chance.choice(SCALE)
        return values
