"""Decisions that are kept: what Algorithm 1 yields for each combination of truth values of a rule's conditions.

The interpreter in `evaluation.hedge_chain` decides each combination once; after that, a dictionary does (memoisation,
Michie 1968). The conditions are compiled to functions, one for each formula, over the values of a snapshot.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

from sleec_runtime.dispatch.plan import Plan
from sleec_runtime.evaluation.formula_truth import OPERATORS
from sleec_runtime.evaluation.hedge_chain import Outcome
from sleec_runtime.model import (
    And,
    Atom,
    Calculation,
    Comparison,
    Formula,
    Measure,
    MeasureRef,
    Not,
    Number,
    Rule,
    ScaleValue,
    Term,
    Truth,
    leaves,
)

Rows = Sequence[Sequence[Any]]
"""The values of conditions and measures, as rows of a `Chunks`."""

Places = Mapping[str, "tuple[int, int]"]
"""The row and the column of each condition and measure."""

Test = Callable[[Rows], bool]

MOST = 1_024
"""The combinations that are kept of one rule, or of the rules of one trigger. Rules that people write have few."""


class TriggerOutcomes:
    """The outcomes of the rules of one trigger in one context, and its plan once it is made."""

    __slots__ = ("outcomes", "plan")

    def __init__(self, outcomes: tuple[Outcome, ...]) -> None:
        self.outcomes = outcomes
        self.plan: Plan | None = None


class RuleMemo:
    """The outcomes of a rule in the closed world, if its trigger occurs alone."""

    __slots__ = ("_known", "_tests")

    def __init__(self, rule: Rule, places: Places, measures: Mapping[str, Measure]) -> None:
        """Compiles the conditions of `rule`, which has no calculations."""
        tests = [_compiled(condition, rule.trigger, places, measures) for condition in _conditions(rule)]
        self._tests = tuple(tests)
        self._known: dict[tuple[bool, ...], Outcome] = {}

    def outcome(self, rows: Rows, decide: Callable[[], Outcome]) -> Outcome:
        """The outcome for these values; `decide` is the interpreter. O(conditions) once a combination is known."""
        key = tuple([test(rows) for test in self._tests])
        try:
            return self._known[key]
        except KeyError:
            if len(self._known) >= MOST:
                self._known.clear()
            found = self._known[key] = decide()
            return found


class TriggerMemo:
    """The `TriggerOutcomes` of one trigger. The same outcomes have the same plan, so that it is made once."""

    __slots__ = ("_known",)

    def __init__(self) -> None:
        self._known: dict[tuple[int, ...], TriggerOutcomes] = {}

    def of(self, outcomes: Sequence[Outcome]) -> TriggerOutcomes:
        """The object for these outcomes, which are known by identity."""
        key = tuple(map(id, outcomes))
        try:
            return self._known[key]
        except KeyError:
            if len(self._known) >= MOST:
                self._known.clear()
            # It keeps the outcomes alive, so that no other object gets their identities.
            found = self._known[key] = TriggerOutcomes(tuple(outcomes))
            return found


def has_calculations(rule: Rule) -> bool:
    """Whether a condition of the rule calculates with measures. Only the interpreter does that."""
    return any(
        isinstance(leaf, Comparison) and isinstance(leaf.left, Calculation)
        for condition in _conditions(rule)
        for leaf in leaves(condition)
    )


def _conditions(rule: Rule) -> Iterable[Formula]:
    """The guard and the conditions of the clauses, each once."""
    conditions = (rule.guard, *(clause.condition for clause in rule.clauses()))
    return dict.fromkeys(condition for condition in conditions if condition is not None)


def _compiled(formula: Formula, trigger: str, places: Places, measures: Mapping[str, Measure]) -> Test:
    """The truth of a formula in the closed world, where only `trigger` occurs."""
    if isinstance(formula, Atom):
        if formula.kind == "condition":
            row, column = places[formula.name]
            return lambda rows: rows[row][column] is True
        occurs = formula.name == trigger
        return lambda rows: occurs
    if isinstance(formula, Truth):
        value = formula.value
        return lambda rows: value
    if isinstance(formula, Comparison):
        return _comparison(formula, places, measures)
    if isinstance(formula, Not):
        negated = _compiled(formula.operand, trigger, places, measures)
        return lambda rows: not negated(rows)
    tests = [_compiled(operand, trigger, places, measures) for operand in formula.operands]
    if isinstance(formula, And):
        return lambda rows: all(test(rows) for test in tests)
    return lambda rows: any(test(rows) for test in tests)


def _comparison(comparison: Comparison, places: Places, measures: Mapping[str, Measure]) -> Test:
    left, right = comparison.left, comparison.right
    compare = OPERATORS[comparison.operator]
    if isinstance(left, MeasureRef) and isinstance(right, MeasureRef):
        one, other = _value(left, places, measures), _value(right, places, measures)
        return lambda rows: (a := one(rows)) is not None and (b := other(rows)) is not None and compare(a, b)
    if isinstance(left, MeasureRef):
        one, bound = _value(left, places, measures), _constant(right)
        return lambda rows: (a := one(rows)) is not None and compare(a, bound)
    assert isinstance(right, MeasureRef), "one side of a comparison is a measure"
    other, least = _value(right, places, measures), _constant(left)
    return lambda rows: (b := other(rows)) is not None and compare(least, b)


def _constant(term: Term) -> Any:
    if isinstance(term, Number):
        return term.value
    assert isinstance(term, ScaleValue), "the other side of a comparison is a measure"
    return term.rank


def _value(measure: MeasureRef, places: Places, measures: Mapping[str, Measure]) -> Callable[[Rows], Any]:
    """The value of a measure, on a scale its rank; None if it is not known."""
    row, column = places[measure.name]
    declared = measures[measure.name]
    if declared.kind == "scale":
        rank: dict[object, int] = {name: number for number, name in enumerate(declared.values)}
        return lambda rows: rank.get(rows[row][column])
    return lambda rows: rows[row][column]
