"""Admission: what a dispatch brings is checked, and then put on the agenda."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from sleec_runtime.dispatch.instance import Instance
from sleec_runtime.dispatch.snapshot import Snapshot
from sleec_runtime.errors import NeedsAwait, SleecError
from sleec_runtime.support.messages import listed
from sleec_runtime.timed.agenda import CLOSES, OPENS
from sleec_runtime.timed.cascade import Moment, Stage, with_chains
from sleec_runtime.timed.clock import Time
from sleec_runtime.timed.ledger import Ledger
from sleec_runtime.timed.refusals import refuse
from sleec_runtime.timed.task import Task


class Admission:
    """Checks stages, and puts their tasks on the agenda. All of it happens within a change of the ledger.

    `state` returns the current context and code. With `chains`, a response is an event that triggers rules.
    """

    def __init__(self, state: Callable[[], tuple[Snapshot, Instance]], ledger: Ledger, chains: bool) -> None:
        self._state = state
        self._ledger = ledger
        self._chains = chains

    def moment(self, args: tuple[Any, ...] = (), kwargs: Mapping[str, Any] | None = None) -> Moment:
        """The current moment, for a trigger with these arguments."""
        snapshot, instance = self._state()
        return Moment(self._ledger.clock.now(), snapshot, instance, args, kwargs or {})

    def closure(self, stage: Stage, moment: Moment) -> list[Stage]:
        """`stage`, and with chains the stages that follow from it at once. Raises as `with_chains`."""
        return with_chains(stage, moment) if self._chains else [stage]

    def admit(
        self, stages: Sequence[Stage], now: Time, in_loop: bool, events: Sequence[str] = (), settled: bool = False
    ) -> None:
        """Checks all tasks of `stages`, and puts them on the agenda. Raises before it changes anything."""
        refuse(stages, self._ledger.agenda, now, events, settled)
        if not in_loop and any(stage.needs_loop(now) for stage in stages):
            labels = [unit.origin.rule.label for stage in stages for unit in stage.units if unit.asynchronous]
            raise NeedsAwait(
                f"code of {listed(dict.fromkeys(labels))} is a coroutine function",
                "await trigger_async(…) instead; what the clock starts needs an AsyncioClock",
            )
        watched = [task for stage in stages if not stage.watched for task in stage.tasks if self._is_watched(task, now)]
        if watched and self._ledger.closed:
            raise SleecError("the instance is closed and schedules no more obligations", "load the rules again")
        for task in watched:
            self.watch(task)
        for stage in stages:
            for unit in stage.units:
                if unit.at > now:
                    self._ledger.schedule(unit.at, OPENS, unit.tasks, unit)
        for stage in stages:
            for task in stage.tasks:
                if task.literal.negated and task not in watched and not stage.watched:
                    self._ledger.set(task, "state", "over")

    def _is_watched(self, task: Task, now: Time) -> bool:
        """Whether the task outlasts the moment, or may."""
        if not task.at_once or task.first > now:
            return True
        # An alternative is nowhere else once the task that it replaces is over.
        return not task.literal.negated and (task.is_alternative or task.name in task.origin.instance.takes_time)

    def watch(self, task: Task) -> None:
        """Puts a task on the agenda, with its timer event."""
        self._ledger.add(task)
        if task.at_once and not task.literal.negated:
            if task.name in task.origin.instance.takes_time:
                task.last = None
        elif task.last is not None:
            self._ledger.schedule(task.last, CLOSES, (task,))
