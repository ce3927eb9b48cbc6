"""What tells the runtime the time, and wakes it.

A clock counts seconds from a start of its own; windows are counted from the moment of the trigger. `MonotonicClock` is
the one for robots, `AsyncioClock` for code that lives in an event loop, `PolledClock` for a main loop that calls
`Sleec.tick`, and `VirtualClock` for tests.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from functools import partial
from math import inf
from typing import TYPE_CHECKING, Protocol, Union

from sleec_runtime.concurrency.critical_section import CriticalSection
from sleec_runtime.concurrency.fork import renew_after_fork
from sleec_runtime.errors import WrongType
from sleec_runtime.model import exact
from sleec_runtime.timed.bounds import FURTHEST, checked_time
from sleec_runtime.timed.executor import Executor
from sleec_runtime.timed.failures import call_and_log

if TYPE_CHECKING:
    from asyncio import AbstractEventLoop
    from fractions import Fraction

    from sleec_runtime.timed.executor import Report

Time = Union[int, float, "Fraction"]
"""Seconds on some clock."""

Cancel = Callable[[], None]


class Clock(Protocol):
    """What the runtime asks of a clock, in any thread that uses the instance; `wake` under the instance's lock.

    The calls that `wake` sets run code. A clock with a method `execute` (see `executor.Execute`) runs that code itself,
    so that it holds up no other call.
    """

    def now(self) -> Time:
        """The time, which never goes back."""
        ...

    def wake(self, at: Time, call: Callable[[], object]) -> Cancel:
        """Has `call` called once it is `at`, soon if that is past, and never within `wake` itself. Returns what calls
        it off."""
        ...


def check_clock(clock: object) -> None:
    """Raises WrongType for what is no `Clock`, a class of clocks among them."""
    methods = [getattr(clock, name, None) for name in ("now", "wake")]
    if isinstance(clock, type) or not all(map(callable, methods)):
        raise WrongType("clock", clock, "a clock, with now() and wake(at, call)", "as in clock=VirtualClock()")


class _Alarms:
    """Calls to be made, by time."""

    def __init__(self) -> None:
        self._calls: dict[object, tuple[Time, Callable[[], object], bool]] = {}

    def add(self, at: Time, call: Callable[[], object], lasts: bool = False) -> object:
        """`lasts`: it is not cleared."""
        key = object()
        self._calls[key] = at, call, lasts
        return key

    def drop(self, key: object) -> None:
        self._calls.pop(key, None)

    def clear(self) -> None:
        self._calls = {key: alarm for key, alarm in tuple(self._calls.items()) if alarm[2]}

    def earliest(self) -> Time | None:
        # An instance has one alarm set at a time, so these are as many as share the clock.
        return min((at for at, _, _ in self._calls.values()), default=None)

    def take(self, until: Time) -> tuple[Time, Callable[[], object]] | None:
        """The earliest call that is not later than `until`, taken out."""
        key = min(self._calls, key=lambda key: self._calls[key][0], default=None)
        return self._calls.pop(key)[:2] if key is not None and self._calls[key][0] <= until else None


class VirtualClock:
    """A clock that stands still until it is told otherwise: for tests, and for simulations.

    What is due on the way runs in the thread that calls `advance`, each at its own time, in order.
    """

    def __init__(self, start: Time = 0) -> None:
        self._now = checked_time(start)
        self._section = CriticalSection()
        self._alarms = _Alarms()

    def now(self) -> Time:
        return self._now

    def wake(self, at: Time, call: Callable[[], object]) -> Cancel:
        key = self._section.run(partial(self._alarms.add, at, call))
        return partial(self._section.run, partial(self._alarms.drop, key))

    def advance(self, seconds: Time) -> None:
        """Lets `seconds` pass, and all happen that is due until then. Raises WrongType for a negative number."""
        number = exact(seconds)
        if number is None or not 0 <= number <= FURTHEST:
            raise WrongType("the time that passes", seconds, f"a number of seconds from 0 to {FURTHEST:,}")
        target = self._now + number if not isinstance(self._now, float) else self._now + seconds
        while (call := self._section.run(partial(self._next, target))) is not None:
            call()

    def _next(self, target: Time) -> Callable[[], object] | None:
        """Goes to the next alarm before `target`, or to `target`."""
        alarm = self._alarms.take(target)
        self._now = max(self._now, target if alarm is None else alarm[0])
        return None if alarm is None else alarm[1]

    def __repr__(self) -> str:
        return f"VirtualClock({self._now})"


class PolledClock:
    """The computer's monotonic clock, which wakes nobody: call `Sleec.tick` often enough instead."""

    def now(self) -> Time:
        return time.monotonic()

    def wake(self, at: Time, call: Callable[[], object]) -> Cancel:
        return _nothing


def _nothing() -> None:
    """There is nothing to call off."""


class MonotonicClock:
    """The computer's monotonic clock, with a thread that wakes: it lives only while there is something to wait for, and
    ends with the program.

    That thread only watches. Code runs on other threads, in the order in which it is started: code that takes longer
    than a tenth of a second holds up nothing that comes after it. Code that takes longer than `limit` seconds is
    reported with StillRunning.
    """

    def __init__(self, limit: float = 5) -> None:
        number = exact(limit)
        if number is None or number <= 0:
            raise WrongType("limit", limit, "a number of seconds above 0")
        self._limit = float(number)
        self.after_fork()
        renew_after_fork(self)

    def after_fork(self) -> None:
        """Nothing is set, and no thread runs."""
        self._changed = threading.Condition()
        self._alarms = _Alarms()
        self._thread: threading.Thread | None = None
        self._executor = Executor(partial(self._wake, lasts=True), self._limit)

    def now(self) -> Time:
        return time.monotonic()

    def wake(self, at: Time, call: Callable[[], object]) -> Cancel:
        return self._wake(at, call)

    def execute(self, call: Callable[[], object], report: Report) -> None:
        self._executor.execute(call, report)

    def close(self) -> None:
        """Calls all off, and waits up to `limit` seconds for code that runs; does not wait if such code, or the clock,
        calls it."""
        with self._changed:
            self._alarms.clear()
            self._changed.notify()
            thread = self._thread
        if thread is not None and thread is not threading.current_thread() and not self._executor.runs_this_thread():
            thread.join(self._limit)

    def _wake(self, at: Time, call: Callable[[], object], lasts: bool = False) -> Cancel:
        try:
            seconds = float(at)
        except OverflowError:
            seconds = inf
        with self._changed:
            if self._thread is None:
                thread = threading.Thread(target=self._watch, name="sleec clock", daemon=True)
                thread.start()
                self._thread = thread
            key = self._alarms.add(seconds, call, lasts)
            self._changed.notify()

        def cancel() -> None:
            with self._changed:
                self._alarms.drop(key)
                self._changed.notify()

        return cancel

    def _watch(self) -> None:
        while (call := self._next()) is not None:
            call_and_log(call)

    def _next(self) -> Callable[[], object] | None:
        """Waits for the next alarm; None if there is none."""
        with self._changed:
            while (earliest := self._alarms.earliest()) is not None:
                alarm = self._alarms.take(time.monotonic())
                if alarm is not None:
                    return alarm[1]
                self._changed.wait(min(max(float(earliest) - time.monotonic(), 0), threading.TIMEOUT_MAX))
            self._thread = None
            return None


class AsyncioClock:
    """The clock of an event loop, which wakes in it: callables may be coroutine functions, and are run as its tasks.

    `loop` is the running one if it is not given. Use the instance in that loop's thread only; from others, by
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
