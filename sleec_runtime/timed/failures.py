"""What went wrong while nobody was calling: told, and kept."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

from sleec_runtime.messages import listed, text_of

if TYPE_CHECKING:
    from sleec_runtime.timed.clocks import Time

KEPT = 1_000


@dataclass(frozen=True)
class Failure:
    """What `rule` asked for failed at `time`: `error` is what a callable raised that the clock had started, why the
    clock could not start it, or a DeadlineMissed. `obligations` are those concerned."""

    time: Time
    rule: str
    obligations: tuple[str, ...]
    error: Exception

    def __str__(self) -> str:
        from sleec_runtime.timed.words import time_in_words

        return f"at {time_in_words(self.time)}, {listed(self.obligations)} ({self.rule}): {text_of(self.error)}"


class Failures:
    """The last thousand failures. Each is told to `on_error`, or, without it, to the log ``sleec_runtime``; and what
    `on_error` raises, too."""

    def __init__(self, on_error: Callable[[Failure], object] | None) -> None:
        self._on_error = on_error
        self._kept: deque[Failure] = deque(maxlen=KEPT)

    def __call__(self, failure: Failure) -> None:
        self._kept.append(failure)
        if self._on_error is None:
            _log("%s", failure)
            return
        try:
            self._on_error(failure)
        except Exception:  # noqa: BLE001 - the clock must go on
            _log("on_error failed at: %s", failure, with_traceback=True)

    def kept(self) -> tuple[Failure, ...]:
        """The oldest first."""
        return tuple(self._kept)


def _log(message: str, failure: Failure, with_traceback: bool = False) -> None:
    from logging import getLogger

    getLogger("sleec_runtime").error(message, failure, exc_info=True if with_traceback else failure.error)
