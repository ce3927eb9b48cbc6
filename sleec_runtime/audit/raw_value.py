"""Values of logs as text."""

from __future__ import annotations

from sleec_runtime.language.common.formula_printer import print_number
from sleec_runtime.model import Rational, exact
from sleec_runtime.support.messages import represent


def raw_text(raw: object) -> str:
    """A value as the log has it. The readers of logs give exact numbers, whose `repr` is that of a Fraction."""
    number = exact(raw)
    if number is not None:
        return number_text(number, 40)
    from decimal import Decimal

    # A Decimal that is not exact is too large.
    return f"{raw:.6g}" if isinstance(raw, Decimal) else represent(raw)


def number_text(number: Rational, longest: int) -> str:
    """A number; with more than `longest` characters, it is rounded. It may be larger than a float can be."""
    text = print_number(number)
    if len(text) <= longest:
        return text
    from decimal import Context, Decimal

    rounded = Context(prec=6).divide(Decimal(number.numerator), Decimal(number.denominator))
    return f"{rounded.normalize():g}"
