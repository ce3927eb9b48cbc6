"""The sides of comparisons as they are written, and what calculations come to."""

from __future__ import annotations

from typing import NamedTuple, Union

from sleec_runtime.language.common.comparisons import Side
from sleec_runtime.model import Span


class Calculation(NamedTuple):
    """Two sides joined by ``+``, ``-`` or ``*``."""

    operator: str
    left: Side | Calculation
    right: Side | Calculation
    span: Span


Operand = Union[Side, Calculation]


class Sum(NamedTuple):
    """What a calculation comes to: so many times each measure or product of two, and a number."""

    terms: dict[tuple[str, ...], int]
    number: int

    def plus(self, other: Sum, times: int = 1) -> Sum:
        names = [*self.terms, *(name for name in other.terms if name not in self.terms)]
        found = {name: self.terms.get(name, 0) + times * other.terms.get(name, 0) for name in names}
        return Sum({name: factor for name, factor in found.items() if factor}, self.number + times * other.number)

    def multiplied(self, other: Sum) -> Sum:
        found = Sum({}, self.number * other.number)
        for one in (*self.terms.items(), ((), self.number)):
            for two in (*other.terms.items(), ((), other.number)):
                if names := (*one[0], *two[0]):
                    found = found.plus(Sum({tuple(sorted(names)): one[1] * two[1]}, 0))
        return found

    def digits(self) -> int:
        """Those of the longest number in it."""
        return max(len(str(abs(number))) for number in (self.number, *self.terms.values()))
