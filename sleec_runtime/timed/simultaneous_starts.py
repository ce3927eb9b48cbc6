"""Timer events with the same time: they run one after the other, but count as simultaneous."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import MappingProxyType

from sleec_runtime.timed.cascade import Stage
from sleec_runtime.timed.clock import Time
from sleec_runtime.timed.refusals import prohibited
from sleec_runtime.timed.task import Task
from sleec_runtime.timed.wording import prohibitions_in_words


class SimultaneousStarts:
    """The obligations that were done, and the prohibitions that came into force, at the time `at` of timer events.
    Immutable."""

    def __init__(
        self, at: Time, done: frozenset[str] = frozenset(), forbidden: Mapping[str, Task] = MappingProxyType({})
    ) -> None:
        self.at = at
        self._done = done
        self._forbidden = forbidden

    def refuse(self, stages: Sequence[Stage], now: Time) -> None:
        """Raises Prohibited if `stages` start a forbidden obligation, or forbid one that was done at this time."""
        for task in self._starting(stages, now):
            if task.name in self._forbidden:
                by = self._forbidden[task.name]
                message = f"`{task.name}` is due, but {prohibitions_in_words([by], now)}"
                raise prohibited(message, task.name, [by], since=self.at)
        for task in self._forbidding(stages, now):
            if task.name in self._done:
                message = f"`{task.name}` was done at this moment, but {prohibitions_in_words([task], now)}"
                raise prohibited(message, task.name, [task], since=self.at)

    def with_started(self, stages: Sequence[Stage], now: Time) -> SimultaneousStarts:
        """Returns the simultaneous starts that also include those of `stages`."""
        done = {t.name for t in self._starting(stages, now) if t.name not in t.origin.instance.takes_time}
        forbidden = {task.name: task for task in self._forbidding(stages, now)}
        return SimultaneousStarts(self.at, self._done | done, {**self._forbidden, **forbidden})

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
