"""Conflicts in which every second matters, drawn out from those of the same rules with shorter windows.

``WHEN C THEN NOT A WITHIN [3, 3] minutes`` forbids all of a minute if each second of another one triggered it: such a
history has 60 instants before now. Where all times are whole minutes, or whole numbers of another unit, only two things
about an instant matter: in which unit from now on it is, and which of two comes first within a unit. So what is true of
the same rules with units of two seconds is a good guess for longer ones, where the second of the two stands for all but
the first: what happens there happens throughout. What is guessed is looked at afterwards, so nothing rests on this.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import fields, is_dataclass, replace
from math import gcd
from typing import TypeVar

from sleec_runtime.model import Number, Ruleset
from sleec_runtime.model_time import Length
from sleec_verify.timed.instant import Fixed
from sleec_verify.timed.names import beside_rules

SHORT = 2
"""Seconds of a unit, where it is short: the one in which now is, and all others."""

LONGEST = 700
"""Instants that are drawn out at most: ten minutes of seconds."""

_Part = TypeVar("_Part")


def shortened(ruleset: Ruleset) -> tuple[Ruleset, int] | None:
    """The rules with windows in units of `SHORT` seconds, and how many seconds a unit has; None if that is no more."""
    lengths = [length.seconds for length in beside_rules(ruleset)[2]]
    if not lengths or None in lengths:
        return None
    unit = gcd(*(int(seconds) for seconds in lengths if seconds is not None))
    if unit <= SHORT:
        return None
    return replace(ruleset, statements=_with_short_lengths(ruleset.statements, unit)), unit


def drawn_out(history: tuple[Fixed, ...], unit: int) -> Iterator[tuple[Fixed, ...]]:
    """What would have to happen if a unit had so many seconds: as many instants as before, and one at each second, if
    that is not too much. The last instant is now."""
    now = history[-1].time
    placed = [(*divmod(instant.time - now, SHORT), instant) for instant in history]
    for last in (2, unit):
        # Only the second in which now is stays as it is.
        if sum(last - 1 if second else 1 for _, second, _ in placed) > LONGEST:
            return
        found = [
            replace(instant, time=units * unit + one)
            for units, second, instant in placed
            for one in (range(1, last) if second else range(1))
        ]
        found.sort(key=lambda instant: instant.time)
        yield tuple(replace(instant, time=instant.time - found[0].time) for instant in found)


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
