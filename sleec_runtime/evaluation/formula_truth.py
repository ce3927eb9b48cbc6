"""The truth of formulas in a situation: χ ⊨ φ (paper, Section 3.2).

There are two worlds. In the closed world (Definition 1), an unreported condition is false, and so is a comparison with
a measure without a value. In the open world both are unknown (Kleene's three-valued logic).
"""

from __future__ import annotations

import operator
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Any

from sleec_runtime.errors import WrongType
from sleec_runtime.model import (
    NUMBER,
    And,
    Atom,
    Calculation,
    Comparison,
    Context,
    Formula,
    Measure,
    MeasureRef,
    Not,
    Number,
    Operator,
    Or,
    Rational,
    ScaleValue,
    Term,
    Truth,
    exact,
    fit,
    leaves,
    measures_of,
)

NO_MEASURES: Mapping[str, Measure] = MappingProxyType({})
_NOTHING_OBLIGED: Mapping[str, bool] = MappingProxyType({})

OPERATORS: Mapping[Operator, Callable[[Any, Any], bool]] = {
    "<": operator.lt,
    "<=": operator.le,
    "=": operator.eq,
    "!=": operator.ne,
    ">=": operator.ge,
    ">": operator.gt,
}


@dataclass(frozen=True, slots=True)
class Situation:
    """What determines the truth of a formula.

    `absent` is the truth of an unreported condition: False in the closed world, None (unknown) in the open world.
    `obliged` are the obligations with a fixed truth; the others are unknown. `other_event` is the truth of a trigger
    that is not in the context: False, or None if it may still occur.
    """

    context: Context
    measures: Mapping[str, Measure] = field(default_factory=lambda: NO_MEASURES)
    absent: bool | None = False
    obliged: Mapping[str, bool] = field(default_factory=lambda: _NOTHING_OBLIGED)
    other_event: bool | None = False


def truth(formula: Formula, situation: Situation) -> bool | None:
    """The truth of `formula`; None if it depends on unknown values. O(size of the formula).

    Raises WrongType for a value that does not fit its use in the formula.
    """
    if isinstance(formula, Atom):
        return _atom(formula, situation)
    if isinstance(formula, Comparison):
        return _comparison(formula, situation)
    if isinstance(formula, Not):
        value = truth(formula.operand, situation)
        return None if value is None else not value
    if isinstance(formula, Truth):
        return formula.value
    deciding = isinstance(formula, Or)
    result: bool | None = not deciding
    for operand in formula.operands:
        value = truth(operand, situation)
        if value is deciding:
            return deciding
        if value is None:
            result = None
    return result


def holds(formula: Formula, context: Context, measures: Mapping[str, Measure] = NO_MEASURES) -> bool:
    """χ ⊨ φ in the closed world (paper, Section 3.2), for a formula over triggers and conditions.

    `measures` gives the scales (`Ruleset.measures`). Without it, values of a scale have no order. Raises WrongType as
    `truth` does, and ValueError for a formula that depends on obligations.
    """
    value = truth(formula, Situation(context, measures))
    if value is None:
        raise ValueError("the truth of an obligation is not part of a context")
    return value


def unreported(formula: Formula, situation: Situation) -> Iterator[str]:
    """The conditions and measures without a value that make `formula` unknown, in text order."""
    if truth(formula, situation) is not None:
        return
    if isinstance(formula, Not):
        yield from unreported(formula.operand, situation)
    elif isinstance(formula, (And, Or)):
        for operand in formula.operands:
            yield from unreported(operand, situation)
    else:
        for leaf in leaves(formula):
            if isinstance(leaf, Comparison):
                yield from (name for name in measures_of(leaf) if situation.context.conditions.get(name) is None)
            elif leaf.kind == "condition":
                yield leaf.name


def _atom(atom: Atom, situation: Situation) -> bool | None:
    if atom.kind == "condition":
        value = situation.context.conditions.get(atom.name)
        if value is None:
            return situation.absent
        return bool(fit(atom.name, value, None))
    if atom.kind == "trigger":
        return atom.name in situation.context.triggers or situation.other_event
    return situation.obliged.get(atom.name)


def _comparison(comparison: Comparison, situation: Situation) -> bool | None:
    left, right = comparison.left, comparison.right
    if isinstance(left, Calculation):
        calculated = _calculated(left, situation)
        if calculated is None:
            return situation.absent
        return OPERATORS[comparison.operator](calculated, _value_of(right, left, situation))
    measured = [situation.context.conditions.get(side.name) for side in (left, right) if isinstance(side, MeasureRef)]
    if None in measured:
        return situation.absent
    return OPERATORS[comparison.operator](_value_of(left, right, situation), _value_of(right, left, situation))


def _calculated(side: Calculation, situation: Situation) -> Rational | None:
    """The result of a calculation; None if one of its measures has no value."""
    values: dict[str, Rational] = {}
    for name in side.measures:
        value = situation.context.conditions.get(name)
        if value is None:
            return None
        number = exact(value)
        if number is None:
            raise WrongType(name, value, NUMBER)
        values[name] = number
    return side.value(values)


def _value_of(side: Term, other: Term, situation: Situation) -> object:
    """The value of a side of a comparison: an exact number, or a rank in a scale."""
    if isinstance(side, Number):
        return side.value
    if isinstance(side, ScaleValue):
        return side.rank
    assert isinstance(side, MeasureRef), "a calculation is not compared with a calculation"
    value = situation.context.conditions[side.name]
    measure = situation.measures.get(side.name)
    if isinstance(value, str):
        if measure is not None:
            return measure.values.index(str(fit(side.name, value, measure)))
        if isinstance(other, ScaleValue) and value == other.value:
            return other.rank
        raise WrongType(side.name, value, "a measure with no known scale", "pass the ruleset's measures")
    number = exact(value)
    if number is None or isinstance(other, ScaleValue):
        raise WrongType(side.name, value, "a value of a scale" if number is not None else NUMBER)
    return number
