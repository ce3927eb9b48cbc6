"""Units of time, as they are written in either language."""

from __future__ import annotations

UNITS = frozenset({"seconds", "minutes", "hours", "days", "second", "minute", "hour", "day"})

_SHORT = {
    **dict.fromkeys(("s", "sec", "secs"), "seconds"),
    **dict.fromkeys(("m", "min", "mins"), "minutes"),
    **dict.fromkeys(("h", "hr", "hrs"), "hours"),
    "d": "days",
}


def unit_meant(word: str) -> str | None:
    """The unit that a word which is none may stand for: its abbreviation, or misspelt."""
    from sleec_runtime.support.suggestions import nearest

    return _SHORT.get(word.casefold()) or nearest(word, ("seconds", "minutes", "hours", "days"))
