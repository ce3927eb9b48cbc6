"""The duties that are not settled yet, and what settles them: occurrences and time."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from heapq import heapify, heappop, heappush
from itertools import count

from sleec_runtime.audit.duty import Due, Duty
from sleec_runtime.model import Rational

_FEW = 64


class OpenDuties:
    """The open duties of a mission.

    A log has delays. So an obligation may be executed up to `tolerance` seconds after the end of its window. A
    prohibition without a window is in force for `tolerance` seconds, except if the rules require the event.

    Obligations without a window that begin at different times need one execution each. An execution counts for the
    oldest of them (earliest deadline first), which misses no deadline if all can be met (Jackson 1955).
    """

    def __init__(self, tolerance: Rational) -> None:
        self.tolerance = tolerance
        self._by_event: dict[str, dict[int, tuple[Due, Duty]]] = {}
        self._ends: list[tuple[Rational, int, Due, Duty]] = []
        self._numbers = count()
        self._size = 0

    def __iter__(self) -> Iterator[Duty]:
        """The open duties, by time."""
        found = {id(duty): duty for entries in self._by_event.values() for _, duty in entries.values()}
        return iter(sorted(found.values(), key=lambda one: (one.triggered.time, one.triggered.rule, one.number)))

    def add(self, duty: Duty, occurring: Collection[str], now: Rational) -> None:
        """Begins a duty at the time `now`, at which the events `occurring` occur. It may be settled at once."""
        for due in duty.task.dues():
            if due.met is None and due.obligation.name in occurring and self._covers(due, now):
                due.met, due.at = not due.obligation.negated, now
        self.resume(duty)

    def resume(self, duty: Duty) -> None:
        """Watches the open dues of a duty."""
        for due in duty.task.dues():
            if due.met is None:
                self._by_event.setdefault(due.obligation.name, {})[id(due)] = (due, duty)
                self._size += 1
                if due.last is not None:
                    heappush(self._ends, (due.last + self._extension(due), next(self._numbers), due, duty))
        self._settle(duty)

    def requires(self, event: str, now: Rational) -> list[Rational | None]:
        """The ends of the open dues that require `event` now; None for one without an end."""
        return [
            None if due.last is None else due.last + self._extension(due)
            for due, _ in self._by_event.get(event, {}).values()
            if not due.obligation.negated and self._covers(due, now)
        ]

    def occur(self, event: str, now: Rational, times: int = 1) -> list[Duty]:
        """The duties that `event` settles, which occurs so many `times` now."""
        entries = [entry for entry in self._by_event.get(event, {}).values() if self._covers(entry[0], now)]
        requiring = {duty.triggered.time for due, duty in entries if not due.obligation.negated}
        oldest = sorted({due.first for due, _ in entries if _is_due_at_once(due)})[:times]
        touched = {}
        for due, duty in entries:
            if _is_due_at_once(due) and due.first not in oldest:
                continue
            exact = due.last is None or now <= due.last
            if due.obligation.negated and not exact and requiring - {duty.triggered.time}:
                continue
            self._decide(due, not due.obligation.negated, now)
            touched[id(duty)] = duty
        return [duty for duty in touched.values() if self._settle(duty)]

    def advance(self, now: Rational) -> list[Duty]:
        """The duties that are settled because their windows end before `now`."""
        settled = []
        while self._ends and self._ends[0][0] < now:
            _, _, due, duty = heappop(self._ends)
            if due.met is None and not duty.settled:
                self._decide(due, due.obligation.negated, due.last)
                if self._settle(duty):
                    settled.append(duty)
        return settled

    def _covers(self, due: Due, time: Rational) -> bool:
        if time < due.first or due.last is None:
            return time >= due.first
        return due.first <= due.last and time <= due.last + self._extension(due)

    def _extension(self, due: Due) -> Rational:
        return 0 if due.obligation.negated and not due.at_once else self.tolerance

    def _decide(self, due: Due, met: bool, at: Rational | None) -> None:
        due.met, due.at = met, at
        self._forget(due)

    def _settle(self, duty: Duty) -> bool:
        """Whether the duty is decided, or depends only on values that were not reported."""
        if duty.task.met() is None and any(due.met is None for due in duty.task.dues()):
            return False
        duty.settled = True
        for due in duty.task.dues():
            self._forget(due)
        if len(self._ends) > 2 * self._size + _FEW:
            self._ends = [end for end in self._ends if end[2].met is None and not end[3].settled]
            heapify(self._ends)
        return True

    def _forget(self, due: Due) -> None:
        entries = self._by_event.get(due.obligation.name, {})
        if entries.pop(id(due), None) is not None:
            self._size -= 1


def _is_due_at_once(due: Due) -> bool:
    return due.at_once and not due.obligation.negated
