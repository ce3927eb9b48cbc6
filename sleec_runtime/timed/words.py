"""Times, windows and prohibitions in words."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from sleec_runtime.language.formula_printer import print_number
from sleec_runtime.messages import listed

if TYPE_CHECKING:
    from sleec_runtime.timed.clocks import Time
    from sleec_runtime.timed.tasks import Task


def time_in_words(time: Time) -> str:
    """A time as people read it: exact, but for floats, which are rounded to milliseconds."""
    return f"{time:.3f}".rstrip("0").rstrip(".") if isinstance(time, float) else print_number(time)


def window_in_words(task: Task) -> str:
    """From when until when, on the clock."""
    start = f"from {time_in_words(task.first)}"
    return f"{start} on" if task.last is None else f"{start} to {time_in_words(task.last)}"


def prohibitions_in_words(prohibitions: Iterable[Task]) -> str:
    """Which rules forbid it, until when."""
    return listed([f"{task.origin.rule.label} forbids it {_until(task)}" for task in prohibitions], " and ")


def _until(task: Task) -> str:
    if task.at_once:
        return "then"
    return "for good" if task.last is None else f"until {time_in_words(task.last)}"
