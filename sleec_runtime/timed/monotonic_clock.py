"""The default clock: the monotonic clock of the computer, with a thread for alarms."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from functools import partial
from math import inf

from sleec_runtime.concurrency.fork import renew_after_fork
from sleec_runtime.errors import WrongType
from sleec_runtime.model import exact
from sleec_runtime.timed.alarms import Alarms
from sleec_runtime.timed.clock import Cancel, Report, Time
from sleec_runtime.timed.executor import Executor
from sleec_runtime.timed.failures import call_and_log


class MonotonicClock:
    """The monotonic clock of the computer, with a thread that lives while there are alarms, and ends with the program.

    This thread only waits. Code runs on other threads, in the order in which it is started. Code that takes longer than
    a tenth of a second does not delay the code after it. Code that takes longer than `limit` seconds is reported as
    StillRunning.
    """

    def __init__(self, limit: float = 5) -> None:
        number = exact(limit)
        if number is None or number <= 0:
            raise WrongType("limit", limit, "a number of seconds above 0")
        self._limit = float(number)
        self.after_fork()
        renew_after_fork(self)

    def after_fork(self) -> None:
        """Starts without alarms and threads."""
        self._changed = threading.Condition()
        self._alarms = Alarms()
        self._thread: threading.Thread | None = None
        self._executor = Executor(partial(self._wake, lasts=True), self._limit)

    def now(self) -> Time:
        return time.monotonic()

    def wake(self, at: Time, call: Callable[[], object]) -> Cancel:
        return self._wake(at, call)

    def execute(self, call: Callable[[], object], report: Report) -> None:
        self._executor.execute(call, report)

    def close(self) -> None:
        """Cancels all alarms, and waits up to `limit` seconds for running code, unless this code or the clock calls
        it."""
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
        """Waits for the next alarm and returns its call; None if there is no alarm."""
        with self._changed:
            while (earliest := self._alarms.earliest()) is not None:
                alarm = self._alarms.take(time.monotonic())
                if alarm is not None:
                    return alarm[1]
                self._changed.wait(min(max(float(earliest) - time.monotonic(), 0), threading.TIMEOUT_MAX))
            self._thread = None
            return None
