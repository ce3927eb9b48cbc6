"""Messages that wait for others that were sent before them."""

from __future__ import annotations

import time
from collections.abc import Sequence
from operator import itemgetter
from typing import Generic, TypeVar

T = TypeVar("T")


class SettlingMessages(Generic[T]):
    """Holds messages for some seconds, and gives them back in the order in which they were sent.

    A trigger reaches a task and an observer at nearly the same time. What the task then sends may reach the observer
    before the trigger does. An observer that waits sees the trigger first.
    """

    def __init__(self, seconds: float) -> None:
        self._seconds = seconds
        self._held: list[tuple[int, float, T]] = []

    def add(self, sent: int, message: T) -> None:
        """Adds a message that has just arrived. `sent` is the time at which it was sent."""
        self._held.append((sent, time.monotonic(), message))

    def take(self) -> Sequence[T]:
        """The messages that have waited for long enough, and those that were sent before them."""
        self._held.sort(key=itemgetter(0))
        latest = time.monotonic() - self._seconds
        count = max((number for number, held in enumerate(self._held, start=1) if held[1] <= latest), default=0)
        taken = [message for _, _, message in self._held[:count]]
        del self._held[:count]
        return taken

    def remaining(self) -> float | None:
        """The seconds until a message has waited for long enough; None without a message."""
        if not self._held:
            return None
        return max(0.0, min(arrived for _, arrived, _ in self._held) + self._seconds - time.monotonic())
