"""Conversion of values to plain data for JSON, and back, without loss."""

from __future__ import annotations

import re
from math import isfinite
from typing import Any, Union

from sleec_runtime.model import DIGITS, exact
from sleec_runtime.timed.clock import Time

PLAIN = "None, truth values, numbers, texts, or lists and dicts of these"

DEEPEST = 50
"""The most lists and dicts within each other."""

_FRACTION = re.compile(rf"-?[0-9]{{1,{DIGITS}}}/[0-9]{{1,{DIGITS}}}", re.ASCII)

Number = Union[int, float, str]


def is_plain(value: object, depth: int = DEEPEST) -> bool:
    """Whether `value` is unchanged after it is written as JSON and read again. Tuples and subclasses are not."""
    kind = type(value)
    if kind is int or kind is float:
        return _is_number(value)
    if kind is list:
        return depth > 0 and all(is_plain(one, depth - 1) for one in value)  # type: ignore[attr-defined]
    if kind is dict:
        items = value.items()  # type: ignore[attr-defined]
        return depth > 0 and all(type(key) is str and is_plain(one, depth - 1) for key, one in items)
    return value is None or kind is bool or kind is str


def copied(value: Any) -> Any:
    """A deep copy of plain data."""
    if type(value) is list:
        return [copied(one) for one in value]
    return {key: copied(one) for key, one in value.items()} if type(value) is dict else value


def number_to_plain(number: Time) -> Number:
    """A number as plain data: a fraction becomes a text such as "1/3"."""
    if isinstance(number, (int, float)):
        return number
    return f"{number.numerator}/{number.denominator}"


def number_from_plain(value: object) -> Time | None:
    """The inverse of `number_to_plain`; None if `value` is not its result."""
    if type(value) is str and _FRACTION.fullmatch(value):
        from fractions import Fraction

        numerator, _, denominator = value.partition("/")
        return Fraction(int(numerator), int(denominator)) if int(denominator) else None
    return value if _is_number(value) else None  # type: ignore[return-value]


def _is_number(value: object) -> bool:
    return (type(value) is int and exact(value) is not None) or (type(value) is float and isfinite(value))
