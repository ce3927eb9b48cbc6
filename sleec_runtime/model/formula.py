"""Formulas over triggers, conditions, obligations and measures, as values.

A formula is built from atoms and comparisons with NOT, AND and OR. Its meaning is in `evaluation.formula_truth`.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Literal, Union

from sleec_runtime.model.calculation import Calculation
from sleec_runtime.model.number import Rational
from sleec_runtime.support.spans import NOWHERE, Span

Kind = Literal["trigger", "condition", "obligation"]
Operator = Literal["<", "<=", "=", "!=", ">=", ">"]
NEGATED: Mapping[Operator, Operator] = {"<": ">=", "<=": ">", "=": "!=", "!=": "=", ">=": "<", ">": "<="}
"""The operator of a comparison that holds exactly if one with the given operator does not."""


@dataclass(frozen=True, slots=True)
class Truth:
    """The constants ``true`` and ``false``."""

    value: bool
    span: Span = field(default=NOWHERE, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Atom:
    """A name that is true or false, with its resolved kind.

    One name may be a trigger in one place and an obligation in another: "it happened" and "it is to be done" differ.
    """

    kind: Kind
    name: str
    span: Span = field(default=NOWHERE, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class MeasureRef:
    """The current value of a measure, as a side of a comparison."""

    name: str


@dataclass(frozen=True, slots=True)
class Number:
    """An exact number, as a side of a comparison. `constant` is the name of the constant that the text uses, if any."""

    value: Rational
    constant: str | None = None


@dataclass(frozen=True, slots=True)
class ScaleValue:
    """A value of the scale of the measure on the other side; `rank` is its rank in that scale, from 0.

    A name that is not a value of the scale, which is a `Defect`, may have a rank outside of the scale.
    """

    value: str
    rank: int


Term = Union[MeasureRef, Number, ScaleValue, Calculation]


@dataclass(frozen=True, slots=True)
class Comparison:
    """``left operator right``. One side is a `MeasureRef`, or the left side is a `Calculation`.

    The parser guarantees that both sides have the same type.
    """

    left: Term
    operator: Operator
    right: Term
    span: Span = field(default=NOWHERE, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Not:
    """A negation."""

    operand: Formula
    span: Span = field(default=NOWHERE, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class And:
    """A conjunction of two or more formulas."""

    operands: tuple[Formula, ...]
    span: Span = field(default=NOWHERE, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Or:
    """A disjunction of two or more formulas."""

    operands: tuple[Formula, ...]
    span: Span = field(default=NOWHERE, compare=False, repr=False)


Formula = Union[Truth, Atom, Comparison, Not, And, Or]


def leaves(formula: Formula) -> Iterator[Atom | Comparison]:
    """The atoms and comparisons of a formula, in text order, with repetitions."""
    if isinstance(formula, (Atom, Comparison)):
        yield formula
    elif isinstance(formula, Not):
        yield from leaves(formula.operand)
    elif isinstance(formula, (And, Or)):
        for operand in formula.operands:
            yield from leaves(operand)


def measures_of(comparison: Comparison) -> tuple[str, ...]:
    """The measures of a comparison: one or two, or those of its calculation."""
    if isinstance(comparison.left, Calculation):
        return comparison.left.measures
    return tuple(side.name for side in (comparison.left, comparison.right) if isinstance(side, MeasureRef))


def names_of(formula: Formula) -> Iterator[str]:
    """The names of atoms and measures in a formula, in text order, with repetitions."""
    for leaf in leaves(formula):
        if isinstance(leaf, Atom):
            yield leaf.name
        else:
            yield from measures_of(leaf)
