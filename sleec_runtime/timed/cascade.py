"""The cascade of one moment: the stage of the triggers, then a stage for each response that is an event."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from sleec_runtime.dispatch.decisions import decisions_of
from sleec_runtime.dispatch.instance import Instance
from sleec_runtime.dispatch.snapshot import Snapshot
from sleec_runtime.evaluation.hedge_chain import Decision
from sleec_runtime.timed.clock import Time
from sleec_runtime.timed.response_tasks import tasks_of
from sleec_runtime.timed.task import Origin, Task
from sleec_runtime.timed.unit import Unit, composed_units, units_of


@dataclass
class Stage:
    """The tasks and units of some rules at one moment, in the context and rules of `snapshot`.

    If there is an `event`, the stage counts only if the event happens. `watched`: its tasks are on the agenda already.
    """

    event: str | None
    triggers: tuple[str, ...]
    snapshot: Snapshot
    decisions: tuple[Decision, ...]
    tasks: tuple[Task, ...]
    units: tuple[Unit, ...]
    watched: bool = False

    def starting(self, now: Time) -> list[Task]:
        """The tasks that start at `now`."""
        return [task for unit in self.units if unit.at <= now for task in unit.tasks if task.is_open]

    def needs_loop(self, now: Time) -> bool:
        """Whether a unit that starts by `now` contains a coroutine function."""
        return any(unit.asynchronous for unit in self.units if unit.at <= now)

    def decided_for(self, now: Time, starting: Sequence[Task]) -> tuple[Decision, ...]:
        """The decisions, reduced to the literals that count at `now`: what starts, and what is forbidden."""
        literals: dict[int, list[Task]] = {}
        for task in self.tasks:
            if task in starting or (task.literal.negated and task.counts_at(now)):
                literals.setdefault(id(task.origin), []).append(task)
        return tuple(
            replace(tasks[0].origin.decision, obligations=tuple(task.literal for task in tasks))
            for tasks in literals.values()
        )


@dataclass(frozen=True)
class Moment:
    """The time, context, code and arguments with which triggers occur."""

    now: Time
    snapshot: Snapshot
    instance: Instance
    args: tuple[Any, ...]
    kwargs: Mapping[str, Any]


def triggered_stage(
    triggers: tuple[str, ...],
    moment: Moment,
    event: str | None = None,
    code: bool = True,
    others: Iterable[str] = (),
) -> Stage:
    """The stage of the rules of `triggers` if `others` occur too. O(rules of the triggers).

    Without `code`, no code need be bound. Raises UnknownTrigger, UndeterminedDecision, WrongType and NotBound.
    """
    snapshot = moment.snapshot
    decisions = decisions_of(snapshot, triggers, others)
    tasks: list[Task] = []
    units: list[Unit] = []
    occurring = frozenset(triggers).union(others)
    for decision in decisions:
        origin = Origin(decision, moment.now, snapshot, moment.instance, moment.args, moment.kwargs, occurring)
        asked = tasks_of(decision.obligations, moment.now, origin)
        tasks += asked
        if code:
            units += units_of(origin, asked)
        else:
            units += composed_units(origin, asked)
    for task in tasks:
        task.conditional = event is not None
    return Stage(event, triggers, snapshot, decisions, tuple(tasks), tuple(units))


def alternative_stage(task: Task, alternatives: tuple[Task, ...], snapshot: Snapshot) -> Stage:
    """The stage of the `alternatives` to `task`."""
    origin = task.origin
    units = composed_units(origin, alternatives)
    return Stage(None, (), _own(origin, snapshot), (), alternatives, units)


def opening_stage(unit: Unit, snapshot: Snapshot) -> Stage:
    """The stage of a unit whose window opens."""
    return Stage(None, (), _own(unit.origin, snapshot), (), unit.tasks, (unit,), watched=True)


def _own(origin: Origin, snapshot: Snapshot) -> Snapshot:
    """The current context; if other rules are in force now, that of the trigger."""
    return snapshot if snapshot.index is origin.snapshot.index else origin.snapshot


def with_chains(first: Stage, moment: Moment) -> list[Stage]:
    """`first`, and the stages of its immediate responses that are events, and so on: each event once.

    O(rules of all these events). Raises as `triggered_stage`.
    """
    stages = [first]
    triggers, begun_only = moment.snapshot.index.number_of, moment.instance.takes_time
    seen = set(first.triggers)
    for stage in stages:
        for task in stage.starting(moment.now):
            name = task.name
            if name in triggers and name not in seen and name not in begun_only:
                seen.add(name)
                with_its_arguments = replace(moment, args=task.origin.args, kwargs=task.origin.kwargs)
                stages.append(triggered_stage((name,), with_its_arguments, event=name, others=first.triggers))
    return stages
