"""What is called for at one moment, step by step: by the triggers, then by each event that a response is."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

from sleec_runtime.dispatch.dispatch import cell_of, outcomes_of
from sleec_runtime.errors import UndeterminedDecision
from sleec_runtime.evaluation.evaluation import Decision, Undetermined
from sleec_runtime.timed.execution_plan import Unit, composed_units, units_of
from sleec_runtime.timed.tasks import Origin, Task, tasks_of

if TYPE_CHECKING:
    from sleec_runtime.dispatch.instance import Instance
    from sleec_runtime.dispatch.snapshot import Snapshot
    from sleec_runtime.timed.clocks import Time


@dataclass
class Stage:
    """What some rules ask for at one moment, in the context and rules of `snapshot`. It counts only if `event` happens,
    where there is one. `watched`: its tasks are on the agenda already."""

    event: str | None
    triggers: tuple[str, ...]
    snapshot: Snapshot
    decisions: tuple[Decision, ...]
    tasks: tuple[Task, ...]
    units: tuple[Unit, ...]
    watched: bool = False

    def starting(self, now: Time) -> list[Task]:
        """What is started at `now`."""
        return [task for unit in self.units if unit.at <= now for task in unit.tasks if task.is_open]

    def decided_for(self, now: Time, starting: Sequence[Task]) -> tuple[Decision, ...]:
        """The decisions, with those literals alone that count at `now`: what is started, and what is forbidden."""
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
    """When, in which context, by which code, and with which arguments triggers occur."""

    now: Time
    snapshot: Snapshot
    instance: Instance
    args: tuple[Any, ...]
    kwargs: Mapping[str, Any]


def called_by(
    triggers: tuple[str, ...],
    moment: Moment,
    event: str | None = None,
    code: bool = True,
    others: Iterable[str] = (),
) -> Stage:
    """What the rules of `triggers` ask for where `others` occur as well. O(rules of the triggers).

    Without `code`, nothing is looked up that would do it. Raises UnknownTrigger, UndeterminedDecision, WrongType and
    NotBound.
    """
    snapshot = moment.snapshot
    for trigger in triggers:
        cell_of(snapshot, trigger)
    outcomes = [outcome for _, outcome in outcomes_of(snapshot, triggers, others)]
    missing = [name for outcome in outcomes if isinstance(outcome, Undetermined) for name in outcome.missing]
    if missing:
        raise UndeterminedDecision(triggers, tuple(dict.fromkeys(missing)))
    decisions = tuple(outcome for outcome in outcomes if isinstance(outcome, Decision))
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


def in_place_of(task: Task, alternatives: tuple[Task, ...], snapshot: Snapshot) -> Stage:
    """What is due in the place of `task`."""
    origin = task.origin
    units = composed_units(origin, alternatives)
    return Stage(None, (), _own(origin, snapshot), (), alternatives, units)


def opened(unit: Unit, snapshot: Snapshot) -> Stage:
    """What is started because its window has opened."""
    return Stage(None, (), _own(unit.origin, snapshot), (), unit.tasks, (unit,), watched=True)


def _own(origin: Origin, snapshot: Snapshot) -> Snapshot:
    """The context of now, or, if other rules are in force now, the last that is known under the rule's own."""
    return snapshot if snapshot.program is origin.snapshot.program else origin.snapshot


def with_chains(first: Stage, moment: Moment) -> list[Stage]:
    """`first`, and what the responses call for that are done at once, and what those call for: each event once.

    O(rules of all these events). Raises as `called_by`.
    """
    stages = [first]
    triggers, begun_only = moment.snapshot.program.number_of, moment.instance.takes_time
    seen = set(first.triggers)
    for stage in stages:
        for task in stage.starting(moment.now):
            name = task.name
            if name in triggers and name not in seen and name not in begun_only:
                seen.add(name)
                with_its_arguments = replace(moment, args=task.origin.args, kwargs=task.origin.kwargs)
                stages.append(called_by((name,), with_its_arguments, event=name, others=first.triggers))
    return stages
