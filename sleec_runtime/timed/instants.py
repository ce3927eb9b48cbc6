"""What the clock has started at one nominal time. It comes one after the other, and happens at once all the same."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from sleec_runtime.timed.refusals import prohibited
from sleec_runtime.timed.words import prohibitions_in_words

if TYPE_CHECKING:
    from sleec_runtime.timed.clocks import Time
    from sleec_runtime.timed.stages import Stage
    from sleec_runtime.timed.tasks import Task


class Instant:
    """The time `at` at which something was to start or to end, with what was done, and what came to be forbidden."""

    def __init__(self, at: Time) -> None:
        self.at = at
        self._done: set[str] = set()
        self._forbidden: dict[str, Task] = {}

    def refuse(self, stages: Sequence[Stage], now: Time) -> None:
        """Raises Prohibited if `stages` do what has been forbidden at this time, or forbid what has been done."""
        for task in self._starting(stages, now):
            if task.name in self._forbidden:
                by = self._forbidden[task.name]
                message = f"{task.name} is due, and {prohibitions_in_words([by], now)}"
                raise prohibited(message, task.name, [by], since=self.at)
        for task in self._forbidding(stages, now):
            if task.name in self._done:
                message = f"{task.name} was done at this moment, and {prohibitions_in_words([task], now)}"
                raise prohibited(message, task.name, [task], since=self.at)

    def note(self, stages: Sequence[Stage], now: Time) -> None:
        """`stages` are started now."""
        for task in self._starting(stages, now):
            if task.name not in task.origin.instance.takes_time:
                self._done.add(task.name)
        for task in self._forbidding(stages, now):
            self._forbidden[task.name] = task

    @staticmethod
    def _starting(stages: Sequence[Stage], now: Time) -> list[Task]:
        return [task for stage in stages for task in stage.starting(now)]

    @staticmethod
    def _forbidding(stages: Sequence[Stage], now: Time) -> list[Task]:
        return [
            task
            for stage in stages
            if not stage.watched
            for task in stage.tasks
            if task.literal.negated and task.counts_at(now)
        ]
