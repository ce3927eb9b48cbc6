"""Conflicts in which every second matters, drawn out from those of the same rules with shorter windows.

``WHEN C THEN NOT A WITHIN [3, 3] minutes`` forbids all of a minute if each of its seconds triggered it: the history has
60 instants before now. Where all windows are as many units of time long, such as minutes, only two things about times
matter: in which unit from now on one is, and which of two comes first within the unit. So what is true of the rules in
units of two seconds, of which the second is all but the first, is a good guess for units of any length: what happens in
the second one happens throughout. What is guessed is looked at afterwards, so nothing rests on this.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import fields, is_dataclass, replace
from math import gcd
from typing import TypeVar

from sleec_runtime.model import Number, Ruleset
from sleec_runtime.model_time import Length
from sleec_verify.timed.instant import Fixed

SHORT = 2
"""Seconds of a unit, where it is short: the one in which now is, and all others."""

LONGEST = 700
"""Instants that are drawn out at most: ten minutes of seconds."""

_Part = TypeVar("_Part")


def shortened(ruleset: Ruleset) -> tuple[Ruleset, int] | None:
    """The rules with windows in units of `SHORT` seconds, and how many seconds a unit has; None if that is no more."""
    lengths = [length.seconds for length in _lengths(ruleset.statements)]
    if not lengths or None in lengths:
        return None
    unit = gcd(*(int(seconds) for seconds in lengths if seconds is not None))
    if unit <= SHORT:
        return None
    return replace(ruleset, statements=_with_short_lengths(ruleset.statements, unit)), unit


def drawn_out(history: tuple[Fixed, ...], unit: int) -> tuple[Fixed, ...] | None:
    """What would have to happen if a unit had so many seconds; the last instant is now. None if that is too much."""
    now = history[-1].time
    found = []
    for instant in history:
        units, second = divmod(instant.time - now, SHORT)
        # Only the second in which now is stays as it is.
        seconds = range(1, unit) if second else range(1)
        found += [replace(instant, time=units * unit + one) for one in seconds]
    if len(found) > LONGEST:
        return None
    begins = min(instant.time for instant in found)
    return tuple(replace(one, time=one.time - begins) for one in sorted(found, key=lambda one: one.time))


def _lengths(part: object) -> Iterator[Length]:
    if isinstance(part, Length):
        yield part
    elif type(part) is tuple:
        for one in part:
            yield from _lengths(one)
    elif is_dataclass(part):
        for field in fields(part):
            yield from _lengths(getattr(part, field.name))


def _with_short_lengths(part: _Part, unit: int) -> _Part:
    """The same with all lengths of time in short units."""
    if isinstance(part, Length):
        assert part.seconds is not None, "lengths that measures say are not shortened"
        return Length(Number(int(part.seconds) // unit * SHORT), "seconds", part.span)  # type: ignore[return-value]
    if isinstance(part, tuple) and type(part) is tuple:
        return tuple(_with_short_lengths(one, unit) for one in part)  # type: ignore[return-value]
    if not is_dataclass(part) or isinstance(part, type):
        return part
    changed = {field.name: _with_short_lengths(getattr(part, field.name), unit) for field in fields(part) if field.init}
    return replace(part, **changed)
