"""What rules calculate from several measures, as a value: a sum of products."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from sleec_runtime.model import Rational


@dataclass(frozen=True, slots=True)
class Calculated:
    """A sum that is calculated from several measures, or from a product of two, as the left side of a comparison with
    a number (resolved by the language).

    `terms` are the summands in the order of the text: a whole factor other than 0, and the one or two measures that it
    multiplies, by name. No two have the same measures, the factors share no divisor, and the first is positive. `line`
    is that of the text, 0 if there is none. In a length of time, what is added comes first, and one summand may be a
    number: a factor without measures; or there may be one summand only.
    """

    terms: tuple[tuple[int, tuple[str, ...]], ...]
    line: int = field(default=0, compare=False, repr=False)

    @property
    def measures(self) -> tuple[str, ...]:
        """The measures that it is calculated from, each once."""
        return tuple(dict.fromkeys(name for _, names in self.terms for name in names))

    def value(self, values: Mapping[str, Rational]) -> Rational:
        """What it comes to where the measures have these values. Raises KeyError for one that has none."""
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
        """As text, each name as `measure` writes it, and each sum and product of two as `operation` does."""
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
