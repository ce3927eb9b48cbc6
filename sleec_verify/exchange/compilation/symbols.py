"""Names and bounds of windows as symbols of formulas."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction

from sleec_runtime.model import SECONDS, Calculation, Length, MeasureRef, Number
from sleec_verify.exchange.compilation.temporal_logic import Bound


def bound_text(bound: Bound, measure: Callable[[MeasureRef | Calculation], str]) -> str:
    """A bound of a window in seconds, such as ``60`` or ``30 + 60*patience``. `measure` writes measures."""
    fixed = Fraction(0)
    parts = []
    for length in bound:
        if isinstance(length.amount, Number):
            fixed += Fraction(length.amount.value) * SECONDS[length.unit]
        else:
            parts.append(_product(length, measure(length.amount)))
    return " + ".join([*([str(fixed)] if fixed or not parts else []), *parts])


def _product(length: Length, amount: str) -> str:
    factor = SECONDS[length.unit]
    return amount if factor == 1 else f"{factor}*{amount}"


def escaped(text: str) -> str:
    """A text as LaTeX."""
    for character in "_#%&$":
        text = text.replace(character, f"\\{character}")
    return text.replace(" ", r"\ ")
