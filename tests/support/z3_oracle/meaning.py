"""The meaning of rules with time, relations and claims, for z3."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import z3

from sleec_runtime.model import (
    RELATIONS,
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
    Exclusive,
    Formula,
    Lasting,
    Length,
    MeasureRef,
    MeasureRelation,
    Never,
    Not,
    Obligation,
    Or,
    Rule,
    Ruleset,
    ScaleValue,
    Term,
    Truth,
)
from tests.support.z3_oracle.instants import FALSE, TRUE, Instant, Instants, every, some


class Meaning:
    """What a ruleset says of some instants."""

    def __init__(self, ruleset: Ruleset, instants: Instants, untimed: str) -> None:
        self.ruleset, self.instants, self.untimed = ruleset, instants, untimed

    def all_rules(self, but: Callable[[Any, int], bool] = lambda law, index: False) -> Any:
        """Γ, without the statements at instants that `but` picks."""
        return z3.And(
            [
                self.law(law, index)
                for law in laws(self.ruleset)
                for index in range(len(self.instants))
                if not but(law, index)
            ]
        )

    def law(self, law: Any, index: int) -> Any:
        """A rule, relation or constraint, as far as it speaks of one instant."""
        instant = self.instants[index]
        if isinstance(law, Rule):
            return z3.Implies(self.triggered(law, instant), self.rule(law, instant))
        return z3.Implies(instant.used, self.relation(law, index))

    def triggered(self, rule: Rule, instant: Instant) -> Any:
        guard = TRUE if rule.guard is None else formula(rule.guard, instant)
        return every((instant.used, instant.event(rule.trigger), guard))

    def rule(self, rule: Rule, instant: Instant) -> Any:
        return self.chain(self.clause(rule.default, instant, instant.time), rule.hedges, instant, instant.time)

    def clause(self, clause: Clause, instant: Instant, due: Any) -> Any:
        """A clause that decides its own chain; what is nested in it may take over."""
        own = every([self.obligation(o, instant, due) for o in clause.obligations])
        return self.chain(own, clause.hedges, instant, due)

    def chain(self, default: Any, hedges: Sequence[Clause], instant: Instant, due: Any) -> Any:
        if self.ruleset.reading == "priority":
            for hedge in hedges:
                default = z3.If(formula(hedge.condition, instant), self.clause(hedge, instant, due), default)
            return default
        if not hedges:
            return default
        rest = self.chain(self.clause(hedges[0], instant, due), hedges[1:], instant, due)
        return z3.If(formula(hedges[0].condition, instant), rest, default)

    def obligation(self, obligation: Obligation, instant: Instant, due: Any) -> Any:
        """Kept, or one of the responses in place of it is. `instant` is that of the trigger, `due` the time from which
        its window counts."""
        timing = obligation.timing
        over = due
        if timing is None or timing.window is None:
            within = [every((i.time >= due, i.time <= due if self.untimed == "at" else TRUE)) for i in self.instants]
        else:
            first = due if timing.window.start is None else due + seconds(timing.window.start, instant)
            within = [i.time >= first for i in self.instants]
            if timing.window.end is not None:
                over = due + seconds(timing.window.end, instant)
                within = [every((w, i.time <= over)) for w, i in zip(within, self.instants)]
        here = [i.event(obligation.name) for i in self.instants]
        occurs = some([every((i.used, w, e)) for i, w, e in zip(self.instants, within, here) if e is not FALSE])
        ways = [z3.Not(occurs) if obligation.negated else occurs]
        if timing is not None and timing.otherwise is not None:
            ways.append(self.clause(timing.otherwise, instant, over))
        if timing is not None and timing.instead is not None:
            ways.append(self.clause(timing.instead, instant, due))
        return some(ways)

    def claim(self, claim: Claim) -> Any:
        here = [
            z3.And(
                i.used,
                i.event(claim.event),
                TRUE if claim.condition is None else formula(claim.condition, i),
                *(self.clause(response, i, i.time) for response in claim.responses),
            )
            for i in self.instants
        ]
        return z3.And(z3.Or(here), TRUE if claim.meanwhile is None else self.claim(claim.meanwhile))

    def relation(self, law: Any, index: int) -> Any:
        i = self.instants[index]
        if isinstance(law, Exclusive):
            return z3.AtMost(*[i.event(name) for name in law.names], 1)
        if isinstance(law, Never):
            return z3.Not(formula(law.formula, i))
        if isinstance(law, Assume):
            return formula(law.formula, i)
        if isinstance(law, EventRelation):
            a, b = i.event(law.left), i.event(law.right)
            before = z3.Or([z3.And(j.used, j.event(law.left)) for j in self.instants[:index]])
            return {
                "witness": z3.Implies(a, b),
                "equal": a == b,
                "mutualExclusive": z3.Not(z3.And(a, b)),
                "happenBefore": z3.Implies(b, before),
            }[law.relation]
        if isinstance(law, MeasureRelation):
            p = formula(law.left, i)
            q = TRUE if law.right is None else formula(law.right, i)
            return {
                "imply": z3.Implies(p, q),
                "iff": p == q,
                "mutualExclusive": z3.Not(z3.And(p, q)),
                "opposite": z3.Not(z3.And(p, q)),
                "invariant": p,
            }[law.relation]
        if isinstance(law, Effect):
            e, p = i.event(law.event), formula(law.formula, i)
            return {
                "causation": z3.Implies(p, e),
                "includes": z3.Implies(e, p),
                "forbid": z3.Implies(e, z3.Not(p)),
            }[law.relation]
        assert isinstance(law, Lasting)
        begins = z3.And(i.event(law.event), TRUE if law.condition is None else formula(law.condition, i))
        holds = []
        ended: Any = FALSE
        for j in self.instants[index:]:
            if law.duration is not None:
                ended = j.time >= i.time + seconds(law.duration, i)
            else:
                assert law.end is not None
                end = TRUE if law.end_condition is None else formula(law.end_condition, j)
                ended = z3.Or(ended, z3.And(j.used, j.event(law.end), end))
            holds.append(z3.Or(z3.Not(j.used), ended, formula(law.formula, j)))
        return z3.Implies(begins, z3.And(holds))


def laws(ruleset: Ruleset) -> list[Any]:
    return [s for s in ruleset.statements if isinstance(s, (Rule, Exclusive, Never, Assume, *RELATIONS))]


def seconds(length: Length, instant: Instant) -> Any:
    return side(length.amount, instant) * SECONDS[length.unit]


def number(value: Any) -> Any:
    return z3.IntVal(value) if isinstance(value, int) else z3.RealVal(str(value))


def formula(f: Formula | None, instant: Instant) -> Any:
    if isinstance(f, Truth):
        return z3.BoolVal(f.value)
    if isinstance(f, Atom):
        return instant.condition(f.name) if f.kind == "condition" else instant.event(f.name)
    if isinstance(f, Not):
        return z3.Not(formula(f.operand, instant))
    if isinstance(f, (And, Or)):
        return (z3.And if isinstance(f, And) else z3.Or)([formula(o, instant) for o in f.operands])
    assert isinstance(f, Comparison)
    a, b = side(f.left, instant), side(f.right, instant)
    return {"<": a < b, "<=": a <= b, "=": a == b, "!=": a != b, ">=": a >= b, ">": a > b}[f.operator]


def side(term: Term, instant: Instant) -> Any:
    if isinstance(term, MeasureRef):
        return instant.measure(term.name)
    if isinstance(term, Calculation):
        summands = (z3.Product(factor, *map(instant.measure, names)) for factor, names in term.terms)
        return z3.Sum(*summands)
    return z3.IntVal(term.rank) if isinstance(term, ScaleValue) else number(term.value)
