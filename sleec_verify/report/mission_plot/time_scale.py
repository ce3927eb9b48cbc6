"""From the times of a mission to places in a picture, and the labels of its axis."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from math import ceil

from sleec_runtime.model import Rational

_STEPS = (1, 2, 5, 10, 15, 30, 60, 120, 300, 600, 900, 1800, 3600, 7200, 10800, 21600, 43200, 86400)
"""Seconds between two labels."""
_CHARACTER, _GAP = 6, 12
"""Pixels."""
_EPOCH = 10**8
"""Times from here on count from 1970: three years is longer than a mission."""


@dataclass(frozen=True)
class TimeScale:
    """Maps times from `start` to `end` to places from `left` on, `width` pixels in all."""

    start: Rational
    end: Rational
    left: float
    width: float

    def x(self, time: Rational) -> float:
        """The place of a time. A time outside is at the border."""
        inside = min(max(time, self.start), self.end)
        span = self.end - self.start
        return self.left + (float(Fraction(inside - self.start) / span) * self.width if span else 0.0)

    def ticks(self, distance: float = 90) -> Iterator[tuple[float, str]]:
        """Places with labels, at least `distance` pixels from each other, and more for long labels."""
        span = Fraction(self.end - self.start)
        distance = max(distance, len(self.label(self.end)) * _CHARACTER + _GAP)
        least = span * Fraction(distance) / Fraction(self.width)
        step = _step(least)
        number = 0
        while number * step <= span:
            yield self.x(self.start + number * step), self.label(self.start + number * step, step)
            number += 1

    def label(self, time: Rational, step: Rational = Fraction(1, 100)) -> str:
        """A time since the start: ``12 s``, ``1:05 min`` or ``2:00:05 h``, as exact as `step`."""
        seconds = Fraction(time - self.start)
        digits = 0 if step >= 1 else 1 if step >= Fraction(1, 10) else 2 if step >= Fraction(1, 100) else 3
        if self.end - self.start < 120:
            text = f"{float(seconds):.{digits}f}"
            return f"{text.rstrip('0').rstrip('.') if '.' in text else text} s"
        whole = round(seconds)
        hours, minutes = divmod(whole // 60, 60)
        if self.end - self.start < 7200:
            return f"{whole // 60}:{whole % 60:02d} min"
        return f"{hours}:{minutes:02d}:{whole % 60:02d} h"

    def start_text(self) -> str:
        """What time 0 of the axis is."""
        if self.start < _EPOCH:
            return f"time 0 is {float(self.start):g} s in the log"
        from datetime import datetime, timezone

        try:
            stamp = datetime.fromtimestamp(float(self.start), timezone.utc)
        except (OverflowError, OSError, ValueError):
            return f"time 0 is {float(self.start):g} s in the log"
        return f"time 0 is {stamp:%Y-%m-%d %H:%M:%S} UTC"


def _step(least: Fraction) -> Fraction:
    """The smallest usual distance of labels that is at least `least` seconds."""
    if least <= 0:
        return Fraction(1)
    if least <= 1:
        step = Fraction(1)
        for divisor in (2, 5, 10, 20, 50, 100, 200, 500, 1000):
            if Fraction(1, divisor) >= least:
                step = Fraction(1, divisor)
        return step
    for usual in _STEPS:
        if usual >= least:
            return Fraction(usual)
    return Fraction(86400 * ceil(least / 86400))
