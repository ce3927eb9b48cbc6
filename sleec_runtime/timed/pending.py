"""Pending obligations and prohibitions, as users see them."""

from __future__ import annotations

from typing import Protocol

from sleec_runtime.timed.clock import CheckedClock, Time
from sleec_runtime.timed.task import State, Task
from sleec_runtime.timed.wording import window_in_words


class PendingHost(Protocol):
    """What follows the tasks: a `Scheduler`."""

    @property
    def clock(self) -> CheckedClock:
        """The clock of the instance."""
        ...

    def completed(self, name: str, task: Task | None = None) -> object:
        """`name` is done, for `task`."""
        ...


class Pending:
    """An obligation or prohibition with its window. Its `state` changes over time.

    Two objects are equal if they belong to the same obligation of the same dispatch.
    """

    __slots__ = ("_host", "_task")

    def __init__(self, task: Task, host: PendingHost) -> None:
        self._task = task
        self._host = host

    @property
    def obligation(self) -> str:
        """The name of the obligation, or of what is prohibited."""
        return self._task.name

    @property
    def prohibited(self) -> bool:
        """Whether it is a prohibition."""
        return self._task.literal.negated

    @property
    def rule(self) -> str:
        """The label of the rule."""
        return self._task.origin.rule.label

    @property
    def start(self) -> Time:
        """The time at which the window opens, in seconds on the clock of the instance."""
        return self._task.first

    @property
    def until(self) -> Time | None:
        """The time at which the window closes; None if there is no deadline."""
        return self._task.last

    @property
    def state(self) -> State:
        """Its state: see docs/runtime.md."""
        return self._task.state_at(self._host.clock.now())

    @property
    def is_open(self) -> bool:
        """Whether the obligation is still to be done, or the prohibition still in force."""
        return self._task.is_open_at(self._host.clock.now())

    def completed(self) -> None:
        """The obligation is done now: as ``sleec.completed(obligation)``. Raises as that does, and SleecError for a
        prohibition."""
        self._host.completed(self._task.name, self._task)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Pending) and other._task is self._task

    def __hash__(self) -> int:
        return hash(self._task)

    def __str__(self) -> str:
        now = self._host.clock.now()
        window = f", {window_in_words(self._task, now)}" if self._task.is_open_at(now) else ""
        return f"{self._task.literal} ({self.rule}): {self._task.state_at(now)}{window}"

    def __repr__(self) -> str:
        return f"<Pending {self}>"
