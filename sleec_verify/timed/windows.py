"""Windows of time around an instant, and when one is part of another."""

from __future__ import annotations

from typing import Protocol


class Window(Protocol):
    """From `start` to `end`, in seconds after some instant, both included; None is no bound."""

    @property
    def start(self) -> int | None: ...
    @property
    def end(self) -> int | None: ...


Bounds = tuple[int | None, int | None] | None
"""From when to when, both included, if at any time; None is no bound."""


def inside(window: Window, other: Window) -> Bounds:
    """How many seconds the instant of `window` may come after that of `other` for it to be part of that: from 0 to 50
    for one from 0 to 10 seconds in one from 0 to 60."""
    if (other.start is not None and window.start is None) or (other.end is not None and window.end is None):
        return None
    start = None if other.start is None or window.start is None else other.start - window.start
    return start, None if other.end is None or window.end is None else other.end - window.end


def allows(bounds: Bounds, after: int) -> bool:
    """Whether a number of seconds is within bounds."""
    if bounds is None:
        return False
    start, end = bounds
    return (start is None or start <= after) and (end is None or after <= end)
