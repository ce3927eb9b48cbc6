"""What is open, and when the clock is to wake for it."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import TYPE_CHECKING

from sleec_runtime.timed.agenda import Agenda

if TYPE_CHECKING:
    from sleec_runtime.timed.clocks import Cancel, Clock, Time
    from sleec_runtime.timed.tasks import State, Task


class Ledger:
    """The agenda, with the lock that it is used under and the clock that wakes for it: `tick` is called then."""

    def __init__(self, clock: Clock, tick: Callable[[], object]) -> None:
        self.lock = threading.RLock()
        self.agenda = Agenda()
        self.clock = clock
        self.closed = False
        self._tick = tick
        self._woken_at: Time | None = None
        self._cancel: Cancel | None = None

    def end(self, task: Task, state: State) -> None:
        """It is over, and what it is then."""
        task.state = state
        self.agenda.remove(task)

    def note(self, name: str, own: Task | None = None) -> tuple[list[Task], list[Task]]:
        """`name` happens now: the obligations that are done by it, and the prohibitions that it breaks, with nothing in
        their place."""
        now = self.clock.now()
        discharged = [task for task in self.agenda.to_do(name) if task.covers(now)]
        if own is not None and own.at_once and own not in discharged:
            discharged.append(own)
        for task in discharged:
            self.end(task, "done")
        broken = self.agenda.prohibitions(name, now)
        for task in broken:
            task.broken = True
        if discharged:
            self.rewake()
        return discharged, [task for task in broken if task.is_decided]

    def next_call(self) -> tuple[Time, Callable[[Time], object]] | None:
        """What is due next, with its time, if that has come; else the clock is told when to wake."""
        next_one = None if self.closed else self.agenda.pop(self.clock.now())
        if next_one is None:
            self._woken_at = None
            self.rewake()
        return next_one

    def rewake(self) -> None:
        """Has the clock wake for what comes next, if that is not what it wakes for already."""
        at = None if self.closed else self.agenda.next_time()
        if at == self._woken_at:
            return
        if self._cancel is not None:
            self._cancel()
        self._woken_at = at
        self._cancel = None if at is None else self.clock.wake(at, self._tick)
