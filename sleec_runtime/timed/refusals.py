"""Refusals: errors for what is forbidden, now or until some time, before anything runs."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from math import floor

from sleec_runtime.dispatch.decisions import refuse_conflict
from sleec_runtime.errors import Prohibited
from sleec_runtime.evaluation.due import Due
from sleec_runtime.evaluation.hedge_chain import Decision
from sleec_runtime.model import Obligation
from sleec_runtime.timed.agenda import Agenda
from sleec_runtime.timed.cascade import Stage
from sleec_runtime.timed.clock import Time
from sleec_runtime.timed.task import Task
from sleec_runtime.timed.wording import prohibitions_in_words, window_in_words


def refuse(
    stages: Sequence[Stage], agenda: Agenda, now: Time, events: Sequence[str] = (), settled: bool = False
) -> None:
    """Raises if the tasks of `stages` contradict each other, a constraint, or a prohibition in force.

    `events` happen now too; if they are `settled`, prohibitions do not refuse them. Raises Prohibited for a task that a
    prohibition in force forbids now or for its whole window; ConflictInContext, and UndeterminedDecision in strict
    mode, for tasks that cannot start together. O(starting tasks + prohibitions in force), plus the cost of constraints.
    """
    starting = [task for stage in stages for task in stage.starting(now)]
    for name in (*(() if settled else events), *(task.name for task in starting)):
        forbidden = agenda.prohibitions(name, now)
        if forbidden:
            raise prohibited(f"`{name}` is due, but {prohibitions_in_words(forbidden, now)}", name, forbidden)
    _refuse_what_stays_forbidden(stages, agenda, now)
    in_force = tuple(
        Decision(task.origin.rule, task.origin.decision.clause, (task.literal,), ()) for task in agenda.forbidden(now)
    )
    happening = tuple(Obligation(name) for name in events)
    decided = [stage.decided_for(now, starting) for stage in stages]
    for stage in {id(stage.snapshot.index): stage for stage in reversed(stages)}.values():
        due = Due((*(d for decisions in decided for d in decisions), *in_force))
        refuse_conflict(stage.snapshot, stages[0].triggers, due, happening)


def prohibited(
    message: str,
    name: str,
    prohibitions: Sequence[Task],
    hint: str = "nothing was executed",
    since: Time | None = None,
) -> Prohibited:
    """The error for a forbidden `name`, with the first whole second at which the prohibitions are over.

    `since` is the end of prohibitions that hold only at the time of their trigger.
    """
    ends = [since if task.at_once and task.last is None else task.last for task in prohibitions]
    over = None if any(end is None for end in ends) else max(floor(end) + 1 for end in ends if end is not None)
    return Prohibited(message, name, over, hint)


def _refuse_what_stays_forbidden(stages: Sequence[Stage], agenda: Agenda, now: Time) -> None:
    new = [task for stage in stages if not stage.watched for task in stage.tasks]
    lasting = [task for task in new if not task.at_once or task.first > now]
    forbidden = [task for task in lasting if task.literal.negated]
    for task in lasting:
        if not task.literal.negated:
            _refuse_if_forbidden(task, [*agenda.all_prohibitions(task.name), *forbidden], now)
    for prohibition in forbidden:
        for task in agenda.to_do(prohibition.name):
            _refuse_if_forbidden(task, [prohibition], now)


def _refuse_if_forbidden(task: Task, prohibitions: Iterable[Task], now: Time) -> None:
    """Raises Prohibited if one of `prohibitions` covers the window of `task`, and the task has no alternatives."""
    if not task.is_decided or (task.at_once and task.state != "waiting"):
        return
    # An obligation that is due at once is fulfilled by its start, even if its execution takes time.
    last = task.first if task.at_once else task.last
    for other in prohibitions:
        if other.name == task.name and other.covers_all(max(task.first, now), last):
            raise prohibited(
                f"`{task.name}` is due ({task.origin.rule.label}, {window_in_words(task, now)}), but "
                f"{prohibitions_in_words([other], now)}",
                task.name,
                [other],
            )


def done_though_forbidden(name: str, prohibitions: Sequence[Task], now: Time) -> Prohibited:
    """The error for `name`, which was done although `prohibitions` forbid it."""
    message = f"`{name}` was done, but {prohibitions_in_words(prohibitions, now)}"
    return prohibited(message, name, prohibitions, "it was started before that")
