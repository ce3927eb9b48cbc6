"""The agenda: open obligations and prohibitions, and timer events. Only `Ledger` changes it, under its lock."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterator
from itertools import islice
from typing import NamedTuple

from sleec_runtime.timed.clock import Time
from sleec_runtime.timed.task import Task
from sleec_runtime.timed.unit import Unit

OPENS, CLOSES, ENDS = 0, 1, 2
"""The kinds of timer events. At one time, windows open before others close, because what opens may fulfil what would
close unfulfilled. A prohibition ends after the last second of its window."""

# Entries of tasks that are over stay until their time, or until there are too many.
_FEW = 64


class Entry(NamedTuple):
    """A timer event for `tasks`, which counts if one of them is open at its time. `unit` is the unit that opens.

    Entries of one time and kind are ordered by `number`, which is unique.
    """

    at: Time
    kind: int
    number: int
    tasks: tuple[Task, ...]
    unit: Unit | None = None

    @property
    def counts(self) -> bool:
        """Whether it is still needed."""
        return any(task.is_open for task in self.tasks)


class Agenda:
    """The open obligations and prohibitions by name, and the entries of timer events.

    Each method is atomic, even if a signal handler or the comparison of two times raises.
    """

    def __init__(self) -> None:
        self._open: dict[str, dict[Task, None]] = {}
        self._forbidden: dict[str, dict[Task, None]] = {}
        self._entries: list[Entry] = []
        """Sorted. A comparison that raises would destroy the order of a heap."""
        self._compact_at = _FEW

    def add(self, task: Task) -> None:
        """Adds an open task."""
        by_name = self._forbidden if task.literal.negated else self._open
        by_name.setdefault(task.name, {})[task] = None

    def remove(self, task: Task) -> None:
        """Removes a task. Ignores one that is not there."""
        by_name = self._forbidden if task.literal.negated else self._open
        tasks = by_name.get(task.name)
        if tasks is not None:
            tasks.pop(task, None)
            if not tasks:
                by_name.pop(task.name, None)

    def __len__(self) -> int:
        """The number of entries."""
        return len(self._entries)

    def __contains__(self, task: Task) -> bool:
        by_name = self._forbidden if task.literal.negated else self._open
        return task in by_name.get(task.name, ())

    def insert(self, entry: Entry) -> None:
        """Adds an entry. Ignores one that is there. O(entries) to copy the pointers."""
        place = bisect_left(self._entries, entry)
        if self._entries[place : place + 1] != [entry]:
            self._entries.insert(place, entry)

    def drop(self, entry: Entry) -> None:
        """Removes an entry. Ignores one that is not there."""
        place = bisect_left(self._entries, entry)
        if self._entries[place : place + 1] == [entry]:
            del self._entries[place]

    def next_entry(self) -> Entry | None:
        """The next entry that counts."""
        return next((entry for entry in self._entries if entry.counts), None)

    def tidy(self) -> None:
        """Removes entries that no longer count: the first ones, and all if there are many. O(1) on average."""
        while self._entries and not self._entries[0].counts:
            del self._entries[0]
        if len(self._entries) > self._compact_at:
            self._entries = [entry for entry in self._entries if entry.counts]
            self._compact_at = max(_FEW, 2 * len(self._entries))

    def to_do(self, name: str) -> tuple[Task, ...]:
        """The open obligations of `name`."""
        return tuple(self._open.get(name, ()))

    def prohibitions(self, name: str, now: Time) -> tuple[Task, ...]:
        """The prohibitions of `name` that are in force at `now`."""
        return tuple(task for task in self._forbidden.get(name, ()) if task.covers(now))

    def forbidden(self, now: Time) -> Iterator[Task]:
        """For each name, one prohibition that is in force at `now`, if there is one. The newest are tried first,
        because they are most likely to be in force."""
        for tasks in self._forbidden.values():
            yield from islice((task for task in reversed(tasks) if task.covers(now)), 1)

    def all_prohibitions(self, name: str) -> tuple[Task, ...]:
        """The current and future prohibitions of `name`."""
        return tuple(self._forbidden.get(name, ()))

    def __iter__(self) -> Iterator[Task]:
        for by_name in (self._open, self._forbidden):
            for tasks in by_name.values():
                yield from tasks
