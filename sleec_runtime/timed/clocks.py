"""Clocks for event loops, for main loops, and for tests.

A clock counts seconds from a start of its own. Windows are counted from the time of the trigger. Robots use
`MonotonicClock`, code in an event loop uses `AsyncioClock`, a main loop that calls `Sleec.tick` uses `PolledClock`, and
tests use `VirtualClock`.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING

from sleec_runtime.concurrency.critical_section import CriticalSection
from sleec_runtime.errors import WrongType
from sleec_runtime.model import exact
from sleec_runtime.timed.alarms import Alarms
from sleec_runtime.timed.clock import FURTHEST, Cancel, Time, checked_time

if TYPE_CHECKING:
    from asyncio import AbstractEventLoop


class VirtualClock:
    """A clock that only `advance` moves: for tests and simulations.

    The calls of alarms run in the thread that calls `advance`, each at its own time, in order.
    """

    def __init__(self, start: Time = 0) -> None:
        self._now = checked_time(start)
        self._section = CriticalSection()
        self._alarms = Alarms()

    def now(self) -> Time:
        return self._now

    def wake(self, at: Time, call: Callable[[], object]) -> Cancel:
        key = self._section.run(partial(self._alarms.add, at, call))
        return partial(self._section.run, partial(self._alarms.drop, key))

    def advance(self, seconds: Time) -> None:
        """Advances the time by `seconds`, and makes the calls of the alarms on the way. Raises WrongType for a negative
        number."""
        number = exact(seconds)
        if number is None or not 0 <= number <= FURTHEST:
            raise WrongType("the time that passes", seconds, f"a number of seconds from 0 to {FURTHEST:,}")
        target = self._now + number if not isinstance(self._now, float) else self._now + seconds
        while (call := self._section.run(partial(self._next, target))) is not None:
            call()

    def _next(self, target: Time) -> Callable[[], object] | None:
        """Moves to the next alarm up to `target`, or to `target`."""
        alarm = self._alarms.take(target)
        self._now = max(self._now, target if alarm is None else alarm[0])
        return None if alarm is None else alarm[1]

    def __repr__(self) -> str:
        return f"VirtualClock({self._now})"


class PolledClock:
    """The monotonic clock of the computer, without alarms: call `Sleec.tick` often enough instead."""

    def now(self) -> Time:
        return time.monotonic()

    def wake(self, at: Time, call: Callable[[], object]) -> Cancel:
        return _nothing


def _nothing() -> None:
    """Cancels nothing."""


class AsyncioClock:
    """The clock of an event loop, with alarms in the loop. Callables may be coroutine functions, which run as its
    tasks.

    `loop` is the running loop by default. Use the instance only in the thread of the loop; other threads call
    ``loop.call_soon_threadsafe(sleec.trigger, …)``.
    """

    def __init__(self, loop: AbstractEventLoop | None = None) -> None:
        if loop is None:
            from asyncio import get_running_loop

            loop = get_running_loop()
        self._loop = loop

    def now(self) -> Time:
        return self._loop.time()

    def wake(self, at: Time, call: Callable[[], object]) -> Cancel:
        return self._loop.call_at(float(at), call).cancel
