"""What is to be done, what is forbidden, and what comes when. Not safe by itself: `Timekeeper` holds the lock."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from heapq import heapify, heappop, heappush
from itertools import count, islice
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from sleec_runtime.timed.clocks import Time
    from sleec_runtime.timed.tasks import Task

OPENS, CLOSES = 0, 1
"""At one time, what opens comes first: it may do what closes undone otherwise."""

_Entry = tuple["Time", int, int, "tuple[Task, ...]", Callable[["Time"], object]]

# Entries of what is done stay in the heap until they come up, or until they are too many.
_FEW = 64


class Agenda:
    """The open obligations and prohibitions by name, and a heap of what the clock starts and ends."""

    def __init__(self) -> None:
        self._open: dict[str, dict[Task, None]] = {}
        self._forbidden: dict[str, dict[Task, None]] = {}
        self._heap: list[_Entry] = []
        self._numbers = count()
        self._compact_at = _FEW

    def add(self, task: Task) -> None:
        """It is open from now on."""
        task.number = next(self._numbers)
        by_name = self._forbidden if task.literal.negated else self._open
        by_name.setdefault(task.name, {})[task] = None

    def remove(self, task: Task) -> None:
        """It is over; nothing happens if it was not there."""
        by_name = self._forbidden if task.literal.negated else self._open
        tasks = by_name.get(task.name)
        if tasks is not None:
            tasks.pop(task, None)
            if not tasks:
                del by_name[task.name]

    def schedule(self, at: Time, kind: int, tasks: Iterable[Task], call: Callable[[Time], object]) -> None:
        """Has `call` come up at the time `at`, if any of `tasks` is open then; it is given that time."""
        heappush(self._heap, (at, kind, next(self._numbers), tuple(tasks), call))
        if len(self._heap) > self._compact_at:
            self._heap = [entry for entry in self._heap if _counts(entry)]
            heapify(self._heap)
            self._compact_at = max(_FEW, 2 * len(self._heap))

    def next_time(self) -> Time | None:
        """When something comes up next."""
        while self._heap and not _counts(self._heap[0]):
            heappop(self._heap)
        return self._heap[0][0] if self._heap else None

    def pop(self, now: Time) -> tuple[Time, Callable[[Time], object]] | None:
        """The next call that has come up by `now`, if there is one, and its time."""
        at = self.next_time()
        return (at, heappop(self._heap)[-1]) if at is not None and at <= now else None

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


def _counts(entry: _Entry) -> bool:
    return any(task.is_open for task in entry[3])
