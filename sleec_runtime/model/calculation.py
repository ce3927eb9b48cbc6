"""Calculations from several measures: sums of products."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from sleec_runtime.model.number import Rational


@dataclass(frozen=True, slots=True)
class Calculation:
    """A sum of several measures or of products of two measures: the left side of a comparison with a number.

    `terms` are the summands in text order, each a factor (an integer other than 0) and the names of the one or two
    measures that it multiplies. No two summands have the same measures, the factors share no divisor, and the first is
    positive. `line` is the line of the text, or 0. In a length of time, positive summands come first, one summand may
    be a factor without measures, and a single summand is allowed.
    """

    terms: tuple[tuple[int, tuple[str, ...]], ...]
    line: int = field(default=0, compare=False, repr=False)

    @property
    def measures(self) -> tuple[str, ...]:
        """The measures of the calculation, each once."""
        return tuple(dict.fromkeys(name for _, names in self.terms for name in names))

    def value(self, values: Mapping[str, Rational]) -> Rational:
        """The result for these values of the measures. Raises KeyError for a measure without a value."""
        found: Rational = 0
        for factor, names in self.terms:
            product: Rational = factor
            for name in names:
                product *= values[name]
            found += product
        return found

    def __str__(self) -> str:
        """As in ``2 * x - y * z``."""
        return self.written(str, str)

    def written(self, measure: Callable[[str], str], operation: Callable[[str], str]) -> str:
        """The calculation as text. `measure` formats each name, and `operation` each sum or product of two."""
        text = ""
        for factor, names in self.terms:
            first, *others = (*([str(abs(factor))] if abs(factor) != 1 or not names else []), *map(measure, names))
            for other in others:
                first = operation(f"{first} * {other}")
            if text:
                text = operation(f"{text} {'-' if factor < 0 else '+'} {first}")
            else:
                text = operation(f"0 - {first}") if factor < 0 else first
        return text
