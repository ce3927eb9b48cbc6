"""Lengths of time, and the windows of responses (docs/times.md)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal

from sleec_runtime.model.calculation import Calculation
from sleec_runtime.model.formula import MeasureRef, Number
from sleec_runtime.model.number import Rational
from sleec_runtime.support.spans import NOWHERE, Span

Unit = Literal["seconds", "minutes", "hours", "days"]
SECONDS: Mapping[Unit, int] = {"seconds": 1, "minutes": 60, "hours": 3600, "days": 86400}
"""The seconds of each unit."""

LONGEST = 10**12
"""The longest length of time in a text, in seconds: more than 30,000 years. It is also the latest time of a clock."""


@dataclass(frozen=True, slots=True)
class Length:
    """A length of time as the text states it: an amount (a number, a constant, a measure or a calculation), and a
    unit."""

    amount: Number | MeasureRef | Calculation
    unit: Unit
    span: Span = field(default=NOWHERE, compare=False, repr=False)

    @property
    def seconds(self) -> Rational | None:
        """The length in seconds; None if it depends on measures."""
        return self.amount.value * SECONDS[self.unit] if isinstance(self.amount, Number) else None

    @property
    def measures(self) -> tuple[str, ...]:
        """The measures that the length depends on, each once."""
        if isinstance(self.amount, Calculation):
            return self.amount.measures
        return (self.amount.name,) if isinstance(self.amount, MeasureRef) else ()

    def seconds_where(self, values: Mapping[str, Rational]) -> Rational:
        """The length in seconds for these values of the measures. Raises KeyError for a measure without a value."""
        amount = self.amount
        if isinstance(amount, Calculation):
            return amount.value(values) * SECONDS[self.unit]
        return (values[amount.name] if isinstance(amount, MeasureRef) else amount.value) * SECONDS[self.unit]

    def __str__(self) -> str:
        amount = self.amount
        if isinstance(amount, Calculation):
            return f"({amount}) {self.unit}"
        if isinstance(amount, MeasureRef):
            return f"{amount.name} {self.unit}"
        return f"{amount.constant or amount.value} {self.unit[:-1] if amount.value == 1 else self.unit}"


@dataclass(frozen=True, slots=True)
class Window:
    """The time in which a response is due, counted from the trigger: from `start` (None: at once) to `end` (None:
    eventually)."""

    end: Length | None
    start: Length | None = None
    span: Span = field(default=NOWHERE, compare=False, repr=False)

    def __str__(self) -> str:
        if self.end is None:
            return "eventually"
        return f"within {self.end}" if self.start is None else f"from {self.start} to {self.end} after the trigger"
