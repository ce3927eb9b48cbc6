"""What the runtime requires of a clock: the time, and alarms."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from typing import Protocol, Union

from sleec_runtime.errors import SleecError, WrongType
from sleec_runtime.model import LONGEST, exact

Time = Union[int, float, Fraction]
"""A time on a clock, in seconds."""

FURTHEST = LONGEST
"""The latest time of a clock, and the longest window, in seconds: more than 30,000 years. Up to there, a float has a
resolution of milliseconds."""

Cancel = Callable[[], None]
"""Cancels an alarm."""

Report = Callable[[SleecError], object]
"""Gets the problem of a call, in any thread: it does not return, or cannot be started."""

Execute = Callable[[Callable[[], object], Report], object]
"""Runs a call, and reports a call that it cannot start or that does not return."""


class Clock(Protocol):
    """A clock, which any thread that uses the instance may call. The instance holds its lock when it calls `wake`.

    Alarms run code. A clock with a method `execute` (see `Execute`) runs this code itself, so that it does not delay
    other alarms.
    """

    def now(self) -> Time:
        """The time in seconds. It never decreases."""
        ...

    def wake(self, at: Time, call: Callable[[], object]) -> Cancel:
        """Sets an alarm that calls `call` at the time `at`, or soon if `at` is past, but never within `wake` itself.
        Returns a function that cancels it."""
        ...


def check_clock(clock: object) -> None:
    """Raises WrongType for an object that is not a `Clock`, such as a class of clocks."""
    methods = [getattr(clock, name, None) for name in ("now", "wake")]
    if isinstance(clock, type) or not all(map(callable, methods)):
        raise WrongType("clock", clock, "a clock, with now() and wake(at, call)", "as in clock=VirtualClock()")


def checked_time(time: object, name: str = "the time of the clock") -> Time:
    """`time`, if it is a valid time of a clock. Raises WrongType, with `name` in its message."""
    number = time if isinstance(time, (int, float)) and not isinstance(time, bool) else exact(time)
    if number is not None and -FURTHEST <= number <= FURTHEST:
        return number
    raise WrongType(
        name, time, f"a number of seconds from -{FURTHEST:,} to {FURTHEST:,}", "give the seconds as a number"
    )


def execute_here(call: Callable[[], object], report: Report) -> None:
    """Runs the call at once, in this thread."""
    call()


class CheckedClock:
    """A clock whose times are checked: `now` raises WrongType for a time out of bounds. `execute` is the method of the
    clock, if it has one."""

    def __init__(self, clock: Clock) -> None:
        self._clock = clock
        self.execute: Execute = getattr(clock, "execute", execute_here)

    def now(self) -> Time:
        return checked_time(self._clock.now())

    def wake(self, at: Time, call: Callable[[], object]) -> Cancel:
        return self._clock.wake(at, call)
