"""What is to be done, what is forbidden, and what comes when. Not safe by itself: `Ledger` changes it."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Callable, Iterator
from itertools import islice
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from sleec_runtime.timed.clocks import Time
    from sleec_runtime.timed.tasks import Task

OPENS, CLOSES = 0, 1
"""At one time, what opens comes first: it may do what closes undone otherwise."""

# Entries of what is done stay until they come up, or until they are too many.
_FEW = 64


class Entry(NamedTuple):
    """Something that comes up at a time, if one of `tasks` is open then. No two have one `number`: it says in which
    order those of one time and kind come up."""

    at: Time
    kind: int
    number: int
    tasks: tuple[Task, ...]
    decide: Callable[[Time], object]

    @property
    def counts(self) -> bool:
        """Whether it still has to come up."""
        return any(task.is_open for task in self.tasks)


class Agenda:
    """The open obligations and prohibitions by name, and entries for what the clock starts and ends.

    Each method changes it at once or not at all, even if a signal handler or the comparison of two times raises.
    """

    def __init__(self) -> None:
        self._open: dict[str, dict[Task, None]] = {}
        self._forbidden: dict[str, dict[Task, None]] = {}
        self._entries: list[Entry] = []
        """In order. A heap would be left in disorder by a comparison that raises."""
        self._compact_at = _FEW

    def add(self, task: Task) -> None:
        """It is open from now on."""
        by_name = self._forbidden if task.literal.negated else self._open
        by_name.setdefault(task.name, {})[task] = None

    def remove(self, task: Task) -> None:
        """It is over; nothing happens if it was not there."""
        by_name = self._forbidden if task.literal.negated else self._open
        tasks = by_name.get(task.name)
        if tasks is not None:
            tasks.pop(task, None)
            if not tasks:
                by_name.pop(task.name, None)

    def __contains__(self, task: Task) -> bool:
        by_name = self._forbidden if task.literal.negated else self._open
        return task in by_name.get(task.name, ())

    def insert(self, entry: Entry) -> None:
        """It comes up at its time; nothing happens if it is there. O(entries), as the time to copy so many pointers."""
        place = bisect_left(self._entries, entry)
        if self._entries[place : place + 1] != [entry]:
            self._entries.insert(place, entry)

    def drop(self, entry: Entry) -> None:
        """It does not come up; nothing happens if it was not there."""
        place = bisect_left(self._entries, entry)
        if self._entries[place : place + 1] == [entry]:
            del self._entries[place]

    def next_entry(self) -> Entry | None:
        """What comes up next."""
        return next((entry for entry in self._entries if entry.counts), None)

    def tidy(self) -> None:
        """Forgets entries that no longer count: the first ones, and, if there are many, all. O(1) on average."""
        while self._entries and not self._entries[0].counts:
            del self._entries[0]
        if len(self._entries) > self._compact_at:
            self._entries = [entry for entry in self._entries if entry.counts]
            self._compact_at = max(_FEW, 2 * len(self._entries))

    def to_do(self, name: str) -> tuple[Task, ...]:
        """The open obligations to do `name`."""
        return tuple(self._open.get(name, ()))

    def prohibitions(self, name: str, now: Time) -> tuple[Task, ...]:
        """The prohibitions of `name` that are in force at `now`."""
        return tuple(task for task in self._forbidden.get(name, ()) if task.covers(now))

    def forbidden(self, now: Time) -> Iterator[Task]:
        """A prohibition that is in force at `now` of each name that has one. The newest are looked at first: however
        many there are, one of these most often is."""
        for tasks in self._forbidden.values():
            yield from islice((task for task in reversed(tasks) if task.covers(now)), 1)

    def all_prohibitions(self, name: str) -> tuple[Task, ...]:
        """Those of `name` that are in force, or come to be."""
        return tuple(self._forbidden.get(name, ()))

    def __iter__(self) -> Iterator[Task]:
        for by_name in (self._open, self._forbidden):
            for tasks in by_name.values():
                yield from tasks
