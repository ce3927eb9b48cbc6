"""Comparisons of measures, numbers and values of scales."""

from __future__ import annotations

import operator as operators
from collections.abc import Callable, Mapping
from dataclasses import replace
from fractions import Fraction
from math import ceil, floor, gcd

from sleec_runtime.language.common.comparisons import Side, scale_text, values_hint
from sleec_runtime.language.common.problems import quoted
from sleec_runtime.language.dsl.amounts import DslAmounts
from sleec_runtime.language.dsl.calculations import Operand
from sleec_runtime.model import (
    Calculation,
    Comparison,
    Defect,
    DefectKind,
    Formula,
    Measure,
    MeasureRef,
    Number,
    Operator,
    Rational,
    ScaleValue,
    Span,
    Term,
    Truth,
)

_COMPARED: Mapping[Operator, Callable[[Rational, Rational], bool]] = {
    "<": operators.lt,
    "<=": operators.le,
    "=": operators.eq,
    "!=": operators.ne,
    ">=": operators.ge,
    ">": operators.gt,
}
_MIRRORED: Mapping[Operator, Operator] = {"<": ">", "<=": ">=", ">": "<", ">=": "<=", "=": "=", "!=": "!="}


class DslComparisons(DslAmounts):
    """Makes comparisons of the names of one text."""

    def comparison(self, left: Side, operator: Operator, right: Side, span: Span) -> Comparison | Truth | None:
        """``left operator right``; None, and a problem, if the sides do not fit. A comparison of two numbers is a truth
        value."""
        if self._with_boolean(left, right):
            return None
        one, two = self._scale(left), self._scale(right)
        terms: tuple[Term | None, Term | None]
        if one is not None and two is not None:
            if one.values != two.values:
                self.problem(
                    f"{quoted(one.name)} and {quoted(two.name)} have different scales: "
                    f"{scale_text(one)} and {scale_text(two)}",
                    span,
                    "compare measures of the same scale only",
                )
                return None
            terms = self.measure_ref(one.name), self.measure_ref(two.name)
        elif one is not None:
            terms = self.measure_ref(one.name), self._value(one, right)
        elif two is not None:
            terms = self._value(two, left), self.measure_ref(two.name)
        else:
            if self._stray(left, right) or self._stray(right, left):
                return None
            terms = number, other = self.number(left), self.number(right)
            if isinstance(number, Number) and isinstance(other, Number):
                self.calculated_with.update(name for name in (number.constant, other.constant) if name is not None)
                return Truth(_COMPARED[operator](number.value, other.value), span)
        first, second = terms
        return None if first is None or second is None else Comparison(first, operator, second, span)

    def calculated(self, left: Operand, operator: Operator, right: Operand, span: Span) -> Formula | None:
        """A comparison of calculations in normal form: a term with a number, or two measures; None, and
        a problem, if there is none."""
        one, two = self.polynomial(left), self.polynomial(right)
        if one is None or two is None:
            return None
        whole = self.checked_size(one.plus(two, -1), span)
        if whole is None:
            return None
        if not whole.terms:
            return Truth(_COMPARED[operator](whole.number, 0), span)
        (names, factor), *more = whole.terms.items()
        if factor < 0:
            operator = _MIRRORED[operator]
        divisor = gcd(*whole.terms.values()) * (1 if factor > 0 else -1)
        number = Fraction(-whole.number, divisor)
        if not more and len(names) == 1:
            return _with_integer(self.measure_ref(names[0]), operator, number, span)
        if whole.number == 0 and [(len(other), times) for other, times in more] == [(1, -factor)] and len(names) == 1:
            return Comparison(self.measure_ref(names[0]), operator, self.measure_ref(more[0][0][0]), span)
        terms = tuple((times // divisor, product) for product, times in whole.terms.items())
        found = _with_integer(Calculation(terms, self.line(span)), operator, number, span)
        # A constant that is alone on one side keeps its name.
        for side, other in ((right, one), (left, two)):
            if isinstance(side, Side) and isinstance(found, Comparison) and other.number == 0:
                alone = self.number(side)
                if isinstance(alone, Number) and isinstance(found.right, Number) and alone.value == found.right.value:
                    return replace(found, right=alone)
        return found

    def _with_boolean(self, left: Side, right: Side) -> bool:
        """Reports a boolean measure on either side. Returns whether there is one."""
        for side, other in ((left, right), (right, left)):
            if not isinstance(side.written, str) or self.kinds.get(side.written) != "boolean":
                continue
            scale = self._scale(other)
            if scale is not None and side.written in scale.values:
                return False
            self.problem(
                f"{self.described(side.written)}, which cannot be compared with {quoted(str(other.written))}",
                side.span,
                f"write {side.written} alone, or not {side.written}{self._instead(side.written, other.written)}",
            )
            return True
        return False

    def _instead(self, boolean: str, other: str | Rational) -> str:
        """Another possible meaning of a comparison of a boolean measure with `other`."""
        measure = self._owners.get(str(other)) or self.measures.get(str(other))
        if measure is not None and measure.kind == "scale":
            return f"; {values_hint(measure)}"
        kind = self.kinds.get(str(other))
        if kind == "boolean" and other != boolean:
            return f"; if both are equal, write ({boolean} and {other}) or (not {boolean} and not {other})"
        if kind in ("measure", "constant") or not isinstance(other, str):
            return f"; if it is a number, write measure {boolean}: numeric"
        return ""

    def _scale(self, side: Side) -> Measure | None:
        measure = self.measures.get(side.written) if isinstance(side.written, str) else None
        return measure if measure is not None and measure.kind == "scale" else None

    def _value(self, measure: Measure, side: Side) -> ScaleValue | None:
        """The other side of a comparison with a scale. A literal of another scale and a number are read by their rank,
        as in other tools, and are defects."""
        value = side.written
        if isinstance(value, str) and not side.braced:
            if value in measure.values:
                return ScaleValue(value, measure.values.index(value))
            owner = self._owners.get(value)
            if owner is not None:
                said = f"`{value}` is a value of `{owner.name}`, not of `{measure.name}`"
                return self._by_place(measure, value, owner.values.index(value), "foreign-value", said, side.span)
        number = self.constants[value].value if isinstance(value, str) and value in self.constants else value
        if isinstance(number, int) and not side.braced:
            named = f"`{value}` (= {number})" if isinstance(value, str) else str(number)
            said = f"`{measure.name}` is a scale, but {named} is a number"
            return self._by_place(measure, str(value), number, "number-as-value", said, side.span)
        known = isinstance(value, str) and value in self.kinds
        near = self.nearest(value, measure.values) if isinstance(value, str) and not known else None
        what = self.described(value) + ", and" if isinstance(value, str) and known else f"{quoted(str(value))} is"
        self.problem(
            f"{what} not a value of {quoted(measure.name)}",
            side.span,
            values_hint(measure, near),
        )
        return None

    def _by_place(
        self, measure: Measure, written: str, rank: int, kind: DefectKind, said: str, span: Span
    ) -> ScaleValue:
        """The value of the scale at `rank`, for something that is not a value of it."""
        values = values_hint(measure)
        if 0 <= rank < len(measure.values):
            meant = measure.values[rank]
            place = "the same place" if kind == "foreign-value" else f"place {rank}, counted from 0"
            read = f"it is read as `{meant}`, which has {place}"
            hint = f"write {meant} if you mean that; {values}"
        else:
            side = "below" if rank > 0 else "above"
            read = f"every value of `{measure.name}` is {side} it, so the result is always the same"
            hint = f"write the value that you mean; {values}"
        self.defects.append(Defect(kind, f"{said}; {read}", span, hint))
        return ScaleValue(written, rank)

    def _stray(self, side: Side, other: Side) -> bool:
        """Reports a value of a scale that is compared with something else. Returns whether there is one."""
        value = side.written
        if not isinstance(value, str) or value in self.kinds or value not in self._owners:
            return False
        compared = other.written
        if isinstance(compared, str) and compared not in self.kinds and compared not in self._owners:
            if self.complete:
                self._without_definition(
                    compared, other.span, "measure", "measure", f"measure {compared}: scale({value}, ...)"
                )
            return True
        one = self.described(compared) if isinstance(compared, str) else f"{quoted(str(compared))} is a number"
        self.problem(
            f"{one}, and {self.described(value)}; they cannot be compared",
            side.span,
            f"compare {quoted(self._owners[value].name)} with it, or write a number",
        )
        return True


def _with_integer(measure: MeasureRef | Calculation, operator: Operator, number: Fraction, span: Span) -> Formula:
    """A comparison of an integer term with any number, rounded to an integer."""
    if number.denominator == 1:
        return Comparison(measure, operator, Number(int(number)), span)
    if operator in ("=", "!="):
        return Truth(operator == "!=", span)
    up = operator in ("<", ">=")
    return Comparison(measure, operator, Number(ceil(number) if up else floor(number)), span)
