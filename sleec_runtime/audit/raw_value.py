"""Values of logs in messages."""

from __future__ import annotations

from sleec_runtime.language.common.formula_printer import print_number
from sleec_runtime.model import exact
from sleec_runtime.support.messages import represent

_LONGEST = 40
"""The most characters of a number that is written in full."""


def raw_text(raw: object) -> str:
    """A value as the log has it. The readers of logs give exact numbers, whose `repr` is that of a Fraction."""
    number = exact(raw)
    text = None if number is None else print_number(number)
    return represent(raw) if text is None or len(text) > _LONGEST else text
