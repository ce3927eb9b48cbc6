"""Exact numbers, and the numbers of sensors read as exact ones.

Sensors deliver floats, rules use decimals. A float stands for the decimal that it prints as: 36.6 from a sensor equals
the 36.6 of the text, although its binary value does not.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Union

if TYPE_CHECKING:
    from decimal import Decimal
    from fractions import Fraction

Rational = Union[int, "Fraction"]
"""An exact number. Decimals of the text become fractions, so that 36.6 is 36.6."""

DIGITS = 1_000
"""The most digits that the numerator and the denominator of a number may have. Arithmetic with longer ones is slow."""

NUMBER = f"a number of at most {DIGITS:,} digits"

_BITS = 3_322
"""The number of bits that `DIGITS` digits need."""


def exact(value: object) -> Rational | None:
    """The exact number that `value` stands for; None if it is not a finite number of at most `DIGITS` digits.

    A truth value is not a number.
    """
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
    """The decimal that another real number stands for; None if it is not finite or has far too many digits."""
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
