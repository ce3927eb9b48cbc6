"""What users see of an obligation that is not over yet."""

from __future__ import annotations

from typing import TYPE_CHECKING

from sleec_runtime.timed.wording import window_in_words

if TYPE_CHECKING:
    from sleec_runtime.timed.clocks import Time
    from sleec_runtime.timed.scheduler import Timekeeper
    from sleec_runtime.timed.tasks import State, Task


class Pending:
    """An obligation with its window, or a prohibition. It follows what becomes of it: `state` changes.

    Two are equal if they are of the same obligation of the same dispatch.
    """

    __slots__ = ("_keeper", "_task")

    def __init__(self, task: Task, keeper: Timekeeper) -> None:
        self._task = task
        self._keeper = keeper

    @property
    def obligation(self) -> str:
        """What is to be done, or not to be done."""
        return self._task.name

    @property
    def prohibited(self) -> bool:
        """Whether it is a prohibition."""
        return self._task.literal.negated

    @property
    def rule(self) -> str:
        """The label of the rule that asks for it."""
        return self._task.origin.rule.label

    @property
    def start(self) -> Time:
        """When the window opens, on the clock of the instance."""
        return self._task.first

    @property
    def until(self) -> Time | None:
        """When it closes; None if there is no deadline."""
        return self._task.last

    @property
    def state(self) -> State:
        """What has become of it."""
        return self._task.state_at(self._keeper.clock.now())

    @property
    def is_open(self) -> bool:
        """Whether it is still to be done, or still forbidden."""
        return self._task.is_open_at(self._keeper.clock.now())

    def completed(self) -> None:
        """It is done: as ``sleec.completed(obligation)``, for code that has this at hand. Raises as that does, and
        SleecError for a prohibition."""
        self._keeper.completed(self._task.name, self._task)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Pending) and other._task is self._task

    def __hash__(self) -> int:
        return hash(self._task)

    def __str__(self) -> str:
        now = self._keeper.clock.now()
        window = f", {window_in_words(self._task, now)}" if self._task.is_open_at(now) else ""
        return f"{self._task.literal} ({self.rule}): {self._task.state_at(now)}{window}"

    def __repr__(self) -> str:
        return f"<Pending {self}>"
