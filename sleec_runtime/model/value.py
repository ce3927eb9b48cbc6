"""The values of conditions and measures, and whether one fits its declaration."""

from __future__ import annotations

from typing import TYPE_CHECKING, Union

from sleec_runtime.errors import WrongType
from sleec_runtime.model.declaration import Measure
from sleec_runtime.model.number import NUMBER, exact

if TYPE_CHECKING:
    from fractions import Fraction

Value = Union[bool, int, "Fraction", str]
"""The value of a condition or measure: a truth value, an exact number, or a value of a scale."""


def fit(name: str, value: object, measure: Measure | None) -> Value:
    """`value` as the rules compare it: a truth value if `measure` is None, else a number or a value of its scale.

    Raises WrongType, which names the expected type.
    """
    if measure is None:
        if isinstance(value, bool):
            return value
        raise WrongType(name, value, "a condition, true or false", "give True or False")
    if measure.kind == "scale":
        if isinstance(value, str) and value in measure.values:
            return value
        raise WrongType(name, value, "a measure on the scale " + " < ".join(measure.values), "give one of these names")
    number = exact(value)
    if number is None:
        raise WrongType(name, value, f"a measure, {NUMBER}", "give an int, a float, a Decimal or a Fraction")
    if measure.kind == "integer" and not isinstance(number, int):
        raise WrongType(name, value, "a measure, a whole number", "round it, or declare the measure a number")
    return number
