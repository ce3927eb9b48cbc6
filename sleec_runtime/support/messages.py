"""Text for messages, whatever the values are that it speaks of: of bounded length, and without control characters."""

from __future__ import annotations

from collections.abc import Iterable
from reprlib import Repr

LONGEST = 2_000
"""The most characters of a message, and of a hint."""

SHOWN = 5
"""How many items of a list a message names."""

_JOINERS = "\u200c\u200d"
"""Zero-width characters that spell words of several languages."""


def bounded(text: str, longest: int = LONGEST) -> str:
    """`text`, cut in its middle to `longest` characters."""
    return text if len(text) <= longest else f"{text[: longest - 501]}…{text[-500:]}"


def listed(items: Iterable[str], separator: str = ", ") -> str:
    """The first items, and how many more there are."""
    items = tuple(items)
    more = f" and {len(items) - SHOWN:,} more" if len(items) > SHOWN else ""
    return separator.join(items[:SHOWN]) + more


def represent(value: object) -> str:
    """`repr(value)` of bounded length. Where that fails, or takes long because of the digits of a number, the type."""
    try:
        return _SHORT.repr(value)
    except Exception:  # noqa: BLE001 - the repr of a user's object
        return f"<{type(value).__name__} object>"


def text_of(value: object) -> str:
    """`str(value)` of bounded length. Where that fails, the type."""
    try:
        return bounded(str(value))
    except Exception:  # noqa: BLE001 - the str of a user's object
        return f"<{type(value).__name__} object>"


def escaped(text: str, keep: str = "") -> str:
    r"""`text` with escapes such as ``\n``, ``\x1b`` and ``\u202e`` for what is not printable, except what is in `keep`:
    control characters, line separators, bidirectional and other invisible controls, and lone surrogates."""
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
