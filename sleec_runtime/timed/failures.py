"""Failures of what the clock started: they are reported and kept, because no caller gets them."""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from functools import partial

from sleec_runtime.support.messages import listed, represent, text_of
from sleec_runtime.timed.clock import Execute, Time

KEPT = 1_000


@dataclass(frozen=True)
class Failure:
    """A failure of `obligations` of `rule`, at `time` in seconds on the clock of the instance.

    `error` is the error of a callable that the clock started, a StillRunning if it does not return, the reason why it
    could not be started, or a DeadlineMissed.
    """

    time: Time
    rule: str
    obligations: tuple[str, ...]
    error: BaseException

    def __str__(self) -> str:
        error = text_of(self.error) or type(self.error).__name__
        return f"{listed(self.obligations)} ({self.rule}): {error}"


class Failures:
    """The last thousand failures. `execute` runs `on_error` for each. Without `on_error`, they go to the log
    ``sleec_runtime``, as do errors of `on_error`."""

    def __init__(self, on_error: Callable[[Failure], object] | None, execute: Execute) -> None:
        self._on_error = on_error
        self._execute = execute
        self._kept: deque[Failure] = deque(maxlen=KEPT)

    def __call__(self, failure: Failure) -> None:
        self.keep(failure)
        self.tell(failure)

    def keep(self, failure: Failure) -> None:
        """Keeps the failure."""
        self._kept.append(failure)

    def forget(self, failure: Failure) -> None:
        """Undoes `keep`. Ignores a failure that is not kept."""
        with suppress(ValueError):
            self._kept.remove(failure)

    def tell(self, failure: Failure) -> None:
        """Passes the failure to `on_error`, or to the log."""
        self._execute(partial(self._tell, failure), lambda error: log_error("on_error: %s", error))

    def _tell(self, failure: Failure) -> None:
        if self._on_error is None:
            log_error("%s", failure, failure.error)
            return
        try:
            self._on_error(failure)
        except BaseException as error:  # noqa: BLE001 - the clock must continue
            log_error("on_error failed at: %s", failure, error)
            raise_interrupt(error)

    def kept(self) -> tuple[Failure, ...]:
        """The failures, oldest first."""
        return tuple(self._kept)


def raise_interrupt(error: BaseException) -> None:
    """Raises `error` if it is a KeyboardInterrupt in the main thread: Ctrl-C must end the program."""
    if isinstance(error, KeyboardInterrupt) and threading.current_thread() is threading.main_thread():
        raise error


def call_and_log(call: Callable[[], object]) -> None:
    """Calls `call` and logs its errors, for a thread that must continue."""
    try:
        call()
    except BaseException as error:  # noqa: BLE001 - the thread must continue
        log_error("a call by the clock failed: %s", represent(error), error)


def log_error(message: str, about: object, error: BaseException | None = None) -> None:
    """Logs `message` with `about` as its argument, and the traceback of `error`."""
    from logging import getLogger

    getLogger("sleec_runtime").error(message, about, exc_info=error)
