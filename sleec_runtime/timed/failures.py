"""What went wrong while nobody was calling: reported, and kept."""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING

from sleec_runtime.support.messages import listed, represent, text_of

if TYPE_CHECKING:
    from sleec_runtime.timed.clocks import Time
    from sleec_runtime.timed.executor import Execute

KEPT = 1_000


@dataclass(frozen=True)
class Failure:
    """What `rule` asked for failed at `time`. `error` is what a callable raised that the clock had started, a
    StillRunning if it does not return, why the clock could not start it, or a DeadlineMissed. `obligations` are those
    concerned."""

    time: Time
    rule: str
    obligations: tuple[str, ...]
    error: BaseException

    def __str__(self) -> str:
        error = text_of(self.error) or type(self.error).__name__
        return f"{listed(self.obligations)} ({self.rule}): {error}"


class Failures:
    """The last thousand failures. Each is given to `on_error`, by `execute`, or, without it, to the log
    ``sleec_runtime``. The log also has what goes wrong with `on_error`."""

    def __init__(self, on_error: Callable[[Failure], object] | None, execute: Execute) -> None:
        self._on_error = on_error
        self._execute = execute
        self._kept: deque[Failure] = deque(maxlen=KEPT)

    def __call__(self, failure: Failure) -> None:
        self.keep(failure)
        self.tell(failure)

    def keep(self, failure: Failure) -> None:
        """Keeps it."""
        self._kept.append(failure)

    def forget(self, failure: Failure) -> None:
        """Undoes `keep`; nothing happens if it is not kept."""
        with suppress(ValueError):
            self._kept.remove(failure)

    def tell(self, failure: Failure) -> None:
        """Gives it to `on_error`, or to the log."""
        self._execute(partial(self._tell, failure), lambda error: log_error("on_error: %s", error))

    def _tell(self, failure: Failure) -> None:
        if self._on_error is None:
            log_error("%s", failure, failure.error)
            return
        try:
            self._on_error(failure)
        except BaseException as error:  # noqa: BLE001 - the clock must go on
            log_error("on_error failed at: %s", failure, error)
            raise_interrupt(error)

    def kept(self) -> tuple[Failure, ...]:
        """The oldest first."""
        return tuple(self._kept)


def raise_interrupt(error: BaseException) -> None:
    """Raises `error` if it is what Ctrl-C raises, where Ctrl-C raises it: a program must be able to end."""
    if isinstance(error, KeyboardInterrupt) and threading.current_thread() is threading.main_thread():
        raise error


def call_and_log(call: Callable[[], object]) -> None:
    """Calls `call`, for a thread that must go on: what it raises is logged."""
    try:
        call()
    except BaseException as error:  # noqa: BLE001 - the thread must go on
        log_error("a call by the clock failed: %s", represent(error), error)


def log_error(message: str, about: object, error: BaseException | None = None) -> None:
    """Logs `message` about something, with the traceback of `error`."""
    from logging import getLogger

    getLogger("sleec_runtime").error(message, about, exc_info=error)
