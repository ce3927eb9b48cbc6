"""Which times a clock may show, and how long a window may be."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from sleec_runtime.errors import WrongType
from sleec_runtime.model import exact
from sleec_runtime.timed.executor import Execute, execute_here

if TYPE_CHECKING:
    from sleec_runtime.timed.clocks import Cancel, Clock, Time

FURTHEST = 10**12
"""The last time of a clock, and the longest window, in seconds: more than 30,000 years. Up to there, a float tells
milliseconds apart."""


def checked_time(time: object, name: str = "the time of the clock") -> Time:
    """`time`, if a clock may show it. Raises WrongType, which calls it `name`."""
    number = time if isinstance(time, (int, float)) and not isinstance(time, bool) else exact(time)
    if number is not None and -FURTHEST <= number <= FURTHEST:
        return number
    raise WrongType(
        name, time, f"a number of seconds from -{FURTHEST:,} to {FURTHEST:,}", "give the seconds as a number"
    )


class CheckedClock:
    """A clock of the user, whose times are checked: `now` raises WrongType for one that is out of bounds. `execute` is
    that of the clock, if it has one."""

    def __init__(self, clock: Clock) -> None:
        self._clock = clock
        self.execute: Execute = getattr(clock, "execute", execute_here)

    def now(self) -> Time:
        return checked_time(self._clock.now())

    def wake(self, at: Time, call: Callable[[], object]) -> Cancel:
        return self._clock.wake(at, call)
