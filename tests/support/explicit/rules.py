"""What rules, relations and constraints say at one instant, as demands: the meaning of docs/semantics.md and
docs/times.md, written down once more for the oracle."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from functools import cached_property
from itertools import combinations, pairwise, product
from math import floor

from sleec_runtime.model import (
    And,
    Assume,
    Atom,
    Calculation,
    Clause,
    Comparison,
    Effect,
    EventRelation,
    Exclusive,
    Formula,
    Lasting,
    Length,
    Measure,
    MeasureRef,
    MeasureRelation,
    Never,
    Not,
    Number,
    Obligation,
    Or,
    Rational,
    Rule,
    Ruleset,
    ScaleValue,
    Truth,
    Value,
    leaves,
    measures_of,
)
from tests.support.explicit.demands import Demand, Literal, every, some

Values = Mapping[str, Value]
Events = frozenset[str]


def holds(formula: Formula | None, events: Events, values: Values, scales: Mapping[str, tuple[str, ...]]) -> bool:
    """The truth of a formula. A trigger and an obligation of one name are one event."""
    if formula is None:
        return True
    if isinstance(formula, Truth):
        return formula.value
    if isinstance(formula, Atom):
        return bool(values[formula.name]) if formula.kind == "condition" else formula.name in events
    if isinstance(formula, Not):
        return not holds(formula.operand, events, values, scales)
    if isinstance(formula, And):
        return all(holds(operand, events, values, scales) for operand in formula.operands)
    if isinstance(formula, Or):
        return any(holds(operand, events, values, scales) for operand in formula.operands)
    left, right = (_side(side, values, scales) for side in (formula.left, formula.right))
    return {
        "<": left < right,
        "<=": left <= right,
        "=": left == right,
        "!=": left != right,
        ">=": left >= right,
        ">": left > right,
    }[formula.operator]


def _side(side: object, values: Values, scales: Mapping[str, tuple[str, ...]]) -> Rational:
    if isinstance(side, Number):
        return side.value
    if isinstance(side, ScaleValue):
        return side.rank
    if isinstance(side, Calculation):
        return side.value({name: _number(values[name]) for name in side.measures})
    assert isinstance(side, MeasureRef)
    value = values[side.name]
    return scales[side.name].index(value) if isinstance(value, str) else value


def valuations(ruleset: Ruleset, formulas: list[Formula], lengths: list[Length]) -> list[Values]:
    """One valuation for each combination of truth values and lengths of windows that `formulas` and `lengths` can have.

    Numbers are looked at near the constants that comparisons name, and between them. That is exact for comparisons of a
    measure with a number or another measure; calculations and lengths need measures with declared ranges.
    """
    found = [leaf for formula in formulas for leaf in leaves(formula)]
    scales = {name: measure.values for name, measure in ruleset.measures.items()}
    domains: dict[str, list[Value]] = {
        leaf.name: [False, True] for leaf in found if isinstance(leaf, Atom) and leaf.kind == "condition"
    }
    comparisons = [leaf for leaf in found if isinstance(leaf, Comparison)]
    sides = [side for leaf in comparisons for side in (leaf.left, leaf.right)]
    numbers = {side.value for side in sides if isinstance(side, Number)} or {0}
    timed = {name for length in lengths for name in length.measures}
    for name in sorted(timed.union(*(measures_of(leaf) for leaf in comparisons))):
        measure = ruleset.measures[name]
        domains[name] = list(measure.values) or _numbers(numbers, measure, len(ruleset.measures))
    distinct: dict[tuple[object, ...], Values] = {}
    for chosen in product(*domains.values()):
        values = dict(zip(domains, chosen))
        truths = [holds(leaf, frozenset(), values, scales) for leaf in found]
        distinct.setdefault((*truths, *(values[name] for name in sorted(timed))), values)
    return list(distinct.values())


def _numbers(constants: set[Rational], measure: Measure, measures: int) -> list[Value]:
    """The constants, and between any two of them as many other numbers as there are measures."""
    if measure.kind == "integer":
        near = {floor(constant) + shift for constant in constants for shift in range(-measures, measures + 2)}
        return sorted(near)
    parts = range(-measures, measures + 1)
    ordered = sorted(constants)
    gaps = [upper - lower for lower, upper in pairwise(ordered)] or [1]
    step = Fraction(min(gaps)) / (2 * measures + 1)
    return sorted(constant + step * part for constant in ordered for part in parts)


class Meaning:
    """A ruleset, asked at single instants."""

    def __init__(self, ruleset: Ruleset) -> None:
        self.ruleset = ruleset
        self.scales = {name: measure.values for name, measure in ruleset.measures.items()}

    def holds(self, formula: Formula | None, events: Events, values: Values) -> bool:
        return holds(formula, events, values, self.scales)

    # Rules ------------------------------------------------------------------------------------------------

    def deciding(self, rule: Rule, events: Events, values: Values) -> tuple[int, Clause] | None:
        """The number and the clause that decides where the trigger of `rule` occurs; None where its guard is false."""
        if not self.holds(rule.guard, events, values):
            return None
        clause = self._nested(self._chosen(rule.default, rule.hedges, events, values), events, values)
        return next((number, one) for number, one in enumerate(rule.clauses()) if one is clause)

    def _chosen(self, holder: Clause, hedges: tuple[Clause, ...], events: Events, values: Values) -> Clause:
        for hedge in hedges:
            if self.holds(hedge.condition, events, values):
                holder = hedge
            elif self.ruleset.reading == "cascade":
                break
        return holder

    def _nested(self, clause: Clause, events: Events, values: Values) -> Clause:
        inner = self._chosen(clause, clause.hedges, events, values)
        return clause if inner is clause else self._nested(inner, events, values)

    def demand(self, clause: Clause, events: Events, values: Values, since: int = 0) -> Demand:
        """What a clause demands if it is due `since` seconds from now."""
        return every(self._obligation(obligation, events, values, since) for obligation in clause.obligations)

    def _obligation(self, obligation: Obligation, events: Events, values: Values, since: int) -> Demand:
        window = None if obligation.timing is None else obligation.timing.window
        first, last = since, since if window is None else None
        if window is not None:
            first += 0 if window.start is None else _seconds(window.start, values)
            last = None if window.end is None else since + _seconds(window.end, values)
        options: list[Demand] = [Literal(obligation.name, obligation.negated, first, last)]
        if obligation.timing is not None and obligation.timing.otherwise is not None:
            then = since if last is None else last
            options.append(self.demand(self._nested(obligation.timing.otherwise, events, values), events, values, then))
        if obligation.timing is not None and obligation.timing.instead is not None:
            options.append(self.demand(self._nested(obligation.timing.instead, events, values), events, values, since))
        return some(options)

    # Relations and constraints ----------------------------------------------------------------------------

    def invariant(self, events: Events, values: Values) -> bool:
        """Whether what relations and constraints say of each instant by itself holds."""
        return all(self._invariant(statement, events, values) for statement in self.ruleset.statements)

    def _invariant(self, statement: object, events: Events, values: Values) -> bool:
        if isinstance(statement, Exclusive):
            return all(not events.issuperset(pair) for pair in combinations(statement.names, 2))
        if isinstance(statement, Never):
            return not self.holds(statement.formula, events, values)
        if isinstance(statement, Assume):
            return self.holds(statement.formula, events, values)
        if isinstance(statement, EventRelation) and statement.relation != "happenBefore":
            left, right = statement.left in events, statement.right in events
            return {"witness": not left or right, "equal": left == right, "mutualExclusive": not (left and right)}[
                statement.relation
            ]
        if isinstance(statement, Effect):
            event, state = statement.event in events, self.holds(statement.formula, events, values)
            return {"causation": event or not state, "includes": state or not event, "forbid": not (event and state)}[
                statement.relation
            ]
        if isinstance(statement, MeasureRelation):
            left = self.holds(statement.left, events, values)
            if statement.right is None:
                return left
            right = self.holds(statement.right, events, values)
            return not left or right if statement.relation == "imply" else self._iff_or_not_both(statement, left, right)
        return True

    @staticmethod
    def _iff_or_not_both(statement: MeasureRelation, left: bool, right: bool) -> bool:
        return left == right if statement.relation == "iff" else not (left and right)

    @cached_property
    def precedences(self) -> list[EventRelation]:
        return [s for s in self.ruleset.statements if isinstance(s, EventRelation) and s.relation == "happenBefore"]

    @cached_property
    def lastings(self) -> list[Lasting]:
        return [s for s in self.ruleset.statements if isinstance(s, Lasting)]

    def lasting(self, active: Lastings, events: Events, values: Values) -> Lastings | None:
        """The `when … until` and `when … for` that bind in the next second, if those of `active` bind in this one. None
        if one of them is broken now."""
        after: dict[int, int | None] = {}
        now = dict(active)
        for number, statement in enumerate(self.lastings):
            begins = statement.event in events and self.holds(statement.condition, events, values)
            left = now.get(number, 0)
            if begins:
                length = None if statement.duration is None else _seconds(statement.duration, values)
                left = None if left is None or length is None else max(left, length)
            if left == 0:
                continue
            if statement.end in events and self.holds(statement.end_condition, events, values):
                continue
            if not self.holds(statement.formula, events, values):
                return None
            after[number] = None if left is None else left - 1
        return pass_second(frozenset(after.items()))


Lastings = frozenset[tuple[int, "int | None"]]
"""For each relation that binds, by its number, for how many seconds from now on; None: until it ends."""


def pass_second(active: Lastings) -> Lastings:
    """Those that still bind."""
    return frozenset((number, left) for number, left in active if left != 0)


def silence(active: Lastings) -> Lastings:
    """Those that bind after a second in which there is no instant."""
    return pass_second(frozenset((number, None if left is None else left - 1) for number, left in active))


def _seconds(length: Length, values: Values) -> int:
    seconds = length.seconds_where({name: _number(values[name]) for name in length.measures})
    assert isinstance(seconds, int), "the oracle counts whole seconds"
    return seconds


def _number(value: Value) -> Rational:
    assert not isinstance(value, (bool, str)), "a length is a number"
    return value
