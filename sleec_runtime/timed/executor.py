"""Runs code on threads of its own, so that code that does not return delays no deadline."""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Callable
from functools import partial
from time import monotonic

from sleec_runtime.errors import SleecError, StillRunning
from sleec_runtime.timed.clock import Cancel, Report
from sleec_runtime.timed.failures import call_and_log

OVERLAP = 0.1
"""The seconds after which a job that has not ended no longer delays the next one."""


class _Job:
    __slots__ = ("alarm", "call", "ended", "report")

    alarm: Cancel

    def __init__(self, call: Callable[[], object], report: Report) -> None:
        self.call = call
        self.report = report
        self.ended = False


class Executor:
    """Runs jobs in order, on a thread that lives while there are jobs.

    When a job has run for `OVERLAP` seconds, the next one begins on another thread. When it has run for `limit`
    seconds, it is reported. `wake` sets an alarm, in seconds of `time.monotonic`. Unlike the executors of the standard
    library, this one lets the program end while a job runs.
    """

    def __init__(self, wake: Callable[[float, Callable[[], object]], Cancel], limit: float) -> None:
        self._wake = wake
        self._limit = limit
        self._lock = threading.RLock()
        self._waiting: deque[_Job] = deque()
        self._current: _Job | None = None
        """The job that the waiting jobs wait for."""
        self._threads: set[threading.Thread] = set()

    def execute(self, call: Callable[[], object], report: Report) -> None:
        """Arranges that `call` is called soon, and returns at once."""
        with self._lock:
            self._waiting.append(_Job(call, report))
        self._proceed()

    def runs_this_thread(self) -> bool:
        """Whether the current thread runs a job."""
        return threading.current_thread() in self._threads

    def _proceed(self) -> None:
        """Begins the next job if no other job delays it."""
        while True:
            with self._lock:
                job = self._take() if self._current is None else None
            if job is None:
                return
            try:
                threading.Thread(target=self._work, args=(job,), name="sleec code", daemon=True).start()
            except RuntimeError as error:
                self._end(job)
                job.report(SleecError(f"no thread can be started for it: {error}", "end code that does not return"))

    def _take(self) -> _Job | None:
        try:
            job = self._waiting.popleft()
        except IndexError:
            return None
        try:
            job.alarm = self._wake(monotonic() + OVERLAP, partial(self._overlap, job))
        except RuntimeError:  # no thread for the clock
            self._waiting.appendleft(job)
            raise
        self._current = job
        return job

    def _work(self, job: _Job | None) -> None:
        self._threads.add(threading.current_thread())
        while job is not None:
            call_and_log(job.call)
            with self._lock:
                holds_up = self._current is job
                self._end(job)
                job = self._take() if holds_up else None
        self._threads.discard(threading.current_thread())

    def _end(self, job: _Job) -> None:
        with self._lock:
            job.ended = True
            job.alarm()
            if self._current is job:
                self._current = None

    def _overlap(self, job: _Job) -> None:
        with self._lock:
            if job.ended:
                return
            job.alarm = self._wake(monotonic() + self._limit - OVERLAP, partial(self._overdue, job))
            if self._current is job:
                self._current = None
        self._proceed()

    def _overdue(self, job: _Job) -> None:
        if not job.ended:
            job.report(StillRunning(self._limit))
