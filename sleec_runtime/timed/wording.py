"""Windows and prohibitions in messages: as the time that is left, because times of a clock mean nothing to people."""

from __future__ import annotations

from collections.abc import Iterable

from sleec_runtime.support.messages import listed
from sleec_runtime.timed.clock import Time
from sleec_runtime.timed.task import Task


def duration_in_words(length: Time, more: str = "") -> str:
    """A length of time to the millisecond, such as "3.2 seconds". `more` is put before the unit: "3.2 more seconds"."""
    number = f"{max(float(length), 0.001):,.3f}".rstrip("0").rstrip(".")
    return f"{number} {more}second{'' if number == '1' else 's'}"


def window_in_words(task: Task, now: Time) -> str:
    """When the window of `task` opens and closes, relative to `now`."""
    opens = f"opens in {duration_in_words(task.first - now)}, " if now < task.first else ""
    if task.last is None:
        return f"{opens}never closes"
    if task.last <= now:
        return f"closed {duration_in_words(now - task.last)} ago" if task.last < now else f"{opens}closes now"
    return f"{opens}closes in {duration_in_words(task.last - now)}"


def prohibitions_in_words(prohibitions: Iterable[Task], now: Time) -> str:
    """The rules that forbid something, each with the remaining time from `now` on."""
    return listed(
        [f"rule `{task.origin.rule.label}` forbids it {_for_how_long(task, now)}" for task in prohibitions], " and "
    )


def _for_how_long(task: Task, now: Time) -> str:
    later = f", {duration_in_words(task.first - now)} from now" if now < task.first else ""
    begin = max(now, task.first)
    if task.at_once or task.last == begin:
        return f"for a moment{later}" if later else "at this moment"
    if task.last is None:
        return f"permanently{later}"
    return f"for {duration_in_words(task.last - begin, '' if later else 'more ')}{later}"
