"""Text for messages: of bounded length, and without control characters, for any values."""

from __future__ import annotations

from collections.abc import Iterable
from reprlib import Repr

LONGEST = 2_000
"""The maximal length of a message, and of a hint, in characters."""

SHOWN = 5
"""The number of items of a list that a message names."""

_JOINERS = "\u200c\u200d"
"""Zero-width characters that spell words of several languages."""


def bounded(text: str, longest: int = LONGEST) -> str:
    """`text`, shortened in the middle to `longest` characters."""
    return text if len(text) <= longest else f"{text[: longest - 501]}…{text[-500:]}"


def listed(items: Iterable[str], separator: str = ", ") -> str:
    """The first items, and the number of the others."""
    items = tuple(items)
    more = f" and {len(items) - SHOWN:,} more" if len(items) > SHOWN else ""
    return separator.join(items[:SHOWN]) + more


def represent(value: object) -> str:
    """`repr(value)` of bounded length; the type if `repr` fails, or is slow because of a long number."""
    try:
        return _SHORT.repr(value)
    except Exception:  # noqa: BLE001 - the repr of a user's object
        return f"<{type(value).__name__} object>"


def text_of(value: object) -> str:
    """`str(value)` of bounded length; the type if `str` fails."""
    try:
        return bounded(str(value))
    except Exception:  # noqa: BLE001 - the str of a user's object
        return f"<{type(value).__name__} object>"


def escaped(text: str, keep: str = "") -> str:
    r"""`text` with escapes such as ``\n``, ``\x1b`` and ``\u202e`` for characters that are not printable: control
    characters, line separators, bidirectional and other invisible controls, and lone surrogates. Those in `keep`
    stay."""
    if text.isprintable():
        return text
    from unicodedata import category

    return "".join(
        c
        if c.isprintable() or c in keep or c in _JOINERS or category(c) == "Zs"
        else c.encode("unicode_escape").decode("ascii")
        for c in text
    )


class _Short(Repr):
    def __init__(self) -> None:
        super().__init__()
        self.maxlevel = 3
        # The longest name of a ruleset, in quotes.
        self.maxstring = self.maxother = 202

    def repr1(self, x: object, level: int) -> str:
        # An int or a Fraction. Python prints no int of more than 4,300 digits.
        parts = [getattr(x, name, None) for name in ("numerator", "denominator")]
        longest = max((part.bit_length() for part in parts if isinstance(part, int)), default=0)
        if longest > _MOST_BITS:
            return f"<{type(x).__name__} of about {longest * 30_103 // 100_000:,} digits>"
        return super().repr1(x, level)


_MOST_BITS = 4_096
_SHORT = _Short()
