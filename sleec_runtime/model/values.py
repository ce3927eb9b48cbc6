"""What a condition or a measure is worth: exact numbers, and whether a value fits what the rules declare.

Sensors deliver floats, rules speak of decimals. A float is taken for the decimal that it prints as, so 36.6 from a
sensor equals the 36.6 of the text, which its binary value does not.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from sleec_runtime.errors import WrongType

if TYPE_CHECKING:
    from decimal import Decimal

    from sleec_runtime.model import Measure, Rational, Value


DIGITS = 1_000
"""How many digits the numerator and the denominator of a number may have. To calculate with longer ones takes long."""

NUMBER = f"a number of at most {DIGITS:,} digits"

_BITS = 3_322
"""As many bits as `DIGITS` digits need."""


def exact(value: object) -> Rational | None:
    """The exact number that `value` stands for, or None if it is not a finite number of at most `DIGITS` digits. A
    truth value is not a number."""
    if type(value) is int:
        return value if value.bit_length() <= _BITS else None
    if isinstance(value, bool):
        return None
    from fractions import Fraction
    from numbers import Rational as AnyRational

    if isinstance(value, AnyRational):
        numerator, denominator = int(value.numerator), int(value.denominator)
        if _are_long(numerator, denominator):
            return None
        number = Fraction(numerator, denominator)
    elif isinstance(value, float):
        # Subclasses of float (NumPy's among them) print as more than the number.
        text = float.__repr__(value)
        try:
            number = Fraction(text)
        except ValueError:
            return None
    else:
        decimal = _decimal(value)
        if decimal is None:
            return None
        number = Fraction(decimal)
    if _are_long(number.numerator, number.denominator):
        return None
    return number.numerator if number.denominator == 1 else number


def _are_long(numerator: int, denominator: int) -> bool:
    return max(numerator.bit_length(), denominator.bit_length()) > _BITS


def _decimal(value: object) -> Decimal | None:
    """The decimal that another real number stands for; None if it is not finite, or has far too many digits."""
    from decimal import Context, Decimal, InvalidOperation
    from numbers import Real

    if not isinstance(value, (Decimal, Real)):
        return None
    try:
        number = value if isinstance(value, Decimal) else Decimal(str(value))
    except InvalidOperation:
        return None
    if not number.is_finite() or abs(number.adjusted()) > DIGITS:
        return None
    # Rounding is fast, even if there are millions of digits.
    rounded = Context(prec=2 * DIGITS, traps=[]).plus(number)
    return number if rounded == number else None


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
        raise WrongType(name, value, f"a measure, {NUMBER}", "give an int, a float, a Decimal or a Fraction")
    if measure.kind == "integer" and not isinstance(number, int):
        raise WrongType(name, value, "a measure, a whole number", "round it, or declare the measure a number")
    return number
