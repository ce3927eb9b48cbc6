"""What a condition or a measure is worth: exact numbers, and whether a value fits what the rules declare.

Sensors deliver floats, rules speak of decimals. A float is taken for the decimal that it prints as, so 36.6 from a
sensor equals the 36.6 of the text, which its binary value does not.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from sleec_runtime.errors import WrongType

if TYPE_CHECKING:
    from sleec_runtime.model import Measure, Rational, Value


def exact(value: object) -> Rational | None:
    """The exact number that `value` stands for, or None if it is no finite number. A truth value is no number."""
    if type(value) is int:
        return value
    if isinstance(value, bool):
        return None
    from decimal import Decimal
    from fractions import Fraction
    from numbers import Rational as AnyRational
    from numbers import Real

    if isinstance(value, AnyRational):
        number = Fraction(int(value.numerator), int(value.denominator))
    elif isinstance(value, (float, Decimal, Real)):
        # Subclasses of float (NumPy's among them) print as more than the number.
        text = float.__repr__(value) if isinstance(value, float) else str(value)
        try:
            number = Fraction(text)
        except ValueError:
            return None
    else:
        return None
    return number.numerator if number.denominator == 1 else number


def fit(name: str, value: object, measure: Measure | None) -> Value:
    """`value` as the rules compare it: a truth value if `measure` is None, else a number or a value of its scale.

    Raises WrongType, which says what would fit.
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
        raise WrongType(name, value, "a measure, a number", "give an int, a float, a Decimal or a Fraction")
    if measure.kind == "integer" and not isinstance(number, int):
        raise WrongType(name, value, "a measure, a whole number", "round it, or declare the measure a number")
    return number
