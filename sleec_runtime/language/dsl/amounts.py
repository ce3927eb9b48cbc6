"""Amounts: numbers, constants, measures, and calculations with these."""

from __future__ import annotations

from typing import Union

from sleec_runtime.language.common.comparisons import MAX_DIGITS, Side
from sleec_runtime.language.dsl.calculations import Operand, Polynomial
from sleec_runtime.language.dsl.name_resolution import DslNames
from sleec_runtime.model import Calculation, MeasureRef, Number, Span

MAX_TERMS = 20
"""The most terms of a polynomial: written with all parentheses, they are no longer than a calculation may be."""


class DslAmounts(DslNames):
    """Makes amounts of the names of one text."""

    def amount(self, operand: Operand) -> Union[Number, MeasureRef, Calculation, None]:
        """The amount that an operand stands for; None, and a problem, if there is none."""
        if isinstance(operand, Side):
            return self.number(operand)
        whole = self.polynomial(operand)
        if whole is None:
            return None
        if not whole.terms:
            return Number(whole.number)
        (measures, factor), *more = whole.terms.items()
        if (len(measures), factor, whole.number) == (1, 1, 0) and not more:
            return self.measure_ref(measures[0])
        terms = [(factor, names) for names, factor in whole.terms.items()]
        number = [(whole.number, ())] if whole.number else []
        return Calculation(tuple(sorted([*terms, *number], key=lambda term: term[0] < 0)), self.line(operand.span))

    def number(self, side: Side) -> Union[Number, MeasureRef, None]:
        """A number, a constant or a numeric measure; None, and a problem, if the side is none of these."""
        name = side.written
        if not isinstance(name, str):
            return Number(name)
        constant = self.constants.get(name)
        if constant is not None and not side.braced:
            return Number(constant.value, name)
        measure = self.measures.get(name)
        if measure is not None and measure.kind != "scale":
            return self.measure_ref(name)
        if name not in self.kinds:
            if self.complete:
                self._without_definition(
                    name, side.span, "constant or numeric measure", "measure", f"measure {name}: numeric"
                )
        elif constant is not None:
            self.problem(
                f"{self.described(name)}; only a measure can be in braces", side.span, f"write {name} without braces"
            )
        else:
            self.problem(
                f"{self.described(name)}, not a number",
                side.span,
                "write a whole number, a constant or a numeric measure",
            )
        return None

    def polynomial(self, side: Operand) -> Polynomial | None:
        """The polynomial that a side is equal to; None, and a problem, if there is none."""
        if isinstance(side, Side):
            term = self.number(side)
            if term is None:
                return None
            if isinstance(term, MeasureRef):
                return Polynomial({(term.name,): 1}, 0)
            if term.constant is not None:
                self.calculated_with.add(term.constant)
            return Polynomial({}, int(term.value))
        left, right = self.polynomial(side.left), self.polynomial(side.right)
        if left is None or right is None:
            return None
        if side.operator != "*":
            found = left.plus(right, 1 if side.operator == "+" else -1)
        elif max(map(len, left.terms), default=0) + max(map(len, right.terms), default=0) > 2:
            self.problem(
                "a product of more than two measures is not supported", side.span, "multiply two measures at most"
            )
            return None
        else:
            found = left.multiplied(right)
        return self.checked_size(found, side.span)

    def checked_size(self, found: Polynomial, span: Span) -> Polynomial | None:
        """The polynomial itself; None, and a problem, if it is too long."""
        if len(found.terms) > MAX_TERMS:
            self.problem(
                f"this calculation has {len(found.terms)} terms, more than {MAX_TERMS}",
                span,
                "simplify it, or compare parts of it",
            )
            return None
        if found.digits() > MAX_DIGITS:
            message = f"a number in this calculation has more than {MAX_DIGITS} digits"
            self.problem(message, span, "use a larger unit")
            return None
        return found
