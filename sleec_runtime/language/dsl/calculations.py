"""Calculations as they are written, and the polynomials that they are equal to."""

from __future__ import annotations

from typing import NamedTuple, Union

from sleec_runtime.language.common.comparisons import Side
from sleec_runtime.model import Span


class Expression(NamedTuple):
    """Two sides joined by ``+``, ``-`` or ``*``."""

    operator: str
    left: Side | Expression
    right: Side | Expression
    span: Span


Operand = Union[Side, Expression]


class Polynomial(NamedTuple):
    """A sum of integer multiples of measures or products of two measures, and a number."""

    terms: dict[tuple[str, ...], int]
    """The factor of each product of measures."""

    number: int

    def plus(self, other: Polynomial, times: int = 1) -> Polynomial:
        names = [*self.terms, *(name for name in other.terms if name not in self.terms)]
        found = {name: self.terms.get(name, 0) + times * other.terms.get(name, 0) for name in names}
        return Polynomial(
            {name: factor for name, factor in found.items() if factor}, self.number + times * other.number
        )

    def multiplied(self, other: Polynomial) -> Polynomial:
        found = Polynomial({}, self.number * other.number)
        for one in (*self.terms.items(), ((), self.number)):
            for two in (*other.terms.items(), ((), other.number)):
                if names := (*one[0], *two[0]):
                    found = found.plus(Polynomial({tuple(sorted(names)): one[1] * two[1]}, 0))
        return found

    def digits(self) -> int:
        """The number of digits of its longest number."""
        return max(len(str(abs(number))) for number in (self.number, *self.terms.values()))
