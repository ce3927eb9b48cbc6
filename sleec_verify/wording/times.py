"""Lengths of time and windows in words."""

from __future__ import annotations

from sleec_runtime.model.calculation import Calculation
from sleec_runtime.model.formula import Number
from sleec_runtime.model.window import Length, Window
from sleec_verify.wording.names import spoken
from sleec_verify.wording.sentence import joined, plural, sentence


def duration(seconds: int) -> str:
    """``0 seconds``, ``5 minutes``, ``1 hour 30 minutes``."""
    if seconds < 0:
        return joined("-", ["", duration(-seconds)])
    days, rest = divmod(seconds, 86_400)
    hours, rest = divmod(rest, 3_600)
    minutes, rest = divmod(rest, 60)
    parts = []
    if days:
        parts.append(plural(days, "{number} day", "{number} days"))
    if hours:
        parts.append(plural(hours, "{number} hour", "{number} hours"))
    if minutes:
        parts.append(plural(minutes, "{number} minute", "{number} minutes"))
    if rest or not parts:
        parts.append(plural(rest, "{number} second", "{number} seconds"))
    return joined(" ", parts)


def length_words(length: Length) -> str:
    """``5 minutes``; for an amount that is not a number in the text, the amount in words: ``delay minutes``."""
    amount = length.amount
    number = 1 if isinstance(amount, Number) and amount.value == 1 else 2
    if isinstance(amount, Number):
        words = f"{spoken(amount.constant)} ({amount.value})" if amount.constant else str(amount.value)
    elif isinstance(amount, Calculation):
        words = f"({amount.written(spoken, str)})"
    else:
        words = spoken(amount.name)
    if length.unit == "seconds":
        return plural(number, "{amount} second", "{amount} seconds", amount=words)
    if length.unit == "minutes":
        return plural(number, "{amount} minute", "{amount} minutes", amount=words)
    if length.unit == "hours":
        return plural(number, "{amount} hour", "{amount} hours", amount=words)
    return plural(number, "{amount} day", "{amount} days", amount=words)


def window_words(window: Window) -> str:
    """``within 5 minutes``, ``eventually``"""
    if window.end is None:
        return sentence("eventually")
    if window.start is None:
        return sentence("within {length}", length=length_words(window.end))
    return sentence(
        "from {start} to {end} after the trigger", start=length_words(window.start), end=length_words(window.end)
    )
