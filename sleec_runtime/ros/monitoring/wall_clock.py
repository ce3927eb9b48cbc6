"""The clock of nodes that write times for others: seconds since 1970."""

from __future__ import annotations

import time
from collections.abc import Callable

from sleec_runtime.timed.clock import Cancel, Time
from sleec_runtime.timed.monotonic_clock import MonotonicClock


class WallClock:
    """Seconds since 1970, with alarms. See `Clock`. A thread waits for alarms while there are any.

    It reads the wall clock of the computer once, and then counts with the monotonic clock. So a correction of the wall
    clock does not change how long a window takes.
    """

    def __init__(self) -> None:
        self._clock = MonotonicClock()
        self._start = time.time() - time.monotonic()
        self.execute = self._clock.execute

    def now(self) -> Time:
        return self._start + time.monotonic()

    def wake(self, at: Time, call: Callable[[], object]) -> Cancel:
        return self._clock.wake(float(at) - self._start, call)
