"""Units of time."""

from __future__ import annotations

from sleec_runtime.support.suggestions import did_you_mean, nearest

UNITS = frozenset({"seconds", "minutes", "hours", "days", "second", "minute", "hour", "day"})

_ABBREVIATIONS = {
    **dict.fromkeys(("s", "sec", "secs"), "seconds"),
    **dict.fromkeys(("m", "min", "mins"), "minutes"),
    **dict.fromkeys(("h", "hr", "hrs"), "hours"),
    "d": "days",
}
_OTHER_UNITS = {
    **dict.fromkeys(
        ("week", "weeks", "month", "months", "year", "years"), "the longest unit is days: 1 week is 7 days"
    ),
    **dict.fromkeys(("milliseconds", "millisecond", "ms", "msec"), "the shortest unit is seconds"),
}


def unit_hint(word: str) -> str:
    """What to write instead of `word`, in lowercase, where a unit is expected."""
    units = ("seconds", "minutes", "hours", "days")
    meant = word if word in UNITS else _ABBREVIATIONS.get(word) or nearest(word, units)
    return _OTHER_UNITS.get(word) or did_you_mean(meant) or "the units are seconds, minutes, hours and days"
