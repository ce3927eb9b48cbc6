"""Comparisons as they are written: operators, numbers, sides and scales."""

from __future__ import annotations

from typing import NamedTuple

from sleec_runtime.language.common.problems import quoted
from sleec_runtime.model import Measure, Operator, Rational, Span
from sleec_runtime.support.suggestions import did_you_mean

MAX_DIGITS = 100

OPERATORS: dict[str, Operator] = {
    "<": "<",
    "<=": "<=",
    "\u2264": "<=",
    "=": "=",
    "==": "=",
    "!=": "!=",
    "<>": "!=",
    "\u2260": "!=",
    ">=": ">=",
    "\u2265": ">=",
    ">": ">",
}


class Side(NamedTuple):
    """One side of a comparison as it is written: a name or a number. `braced` is true of a DSL measure in braces."""

    written: str | Rational
    span: Span
    braced: bool = False


def scale_text(measure: Measure) -> str:
    """The values of a scale, lowest first; a long scale is shortened."""
    values = measure.values
    return " < ".join((*values[:4], "...", values[-1]) if len(values) > 8 else values)


def values_hint(measure: Measure, near: str | None = None) -> str:
    """The values of a scale as a hint, after the nearest value, if any."""
    values = f"values of {quoted(measure.name)} are {scale_text(measure)}"
    return f"{did_you_mean(near)} The {values}" if near else f"the {values}"
