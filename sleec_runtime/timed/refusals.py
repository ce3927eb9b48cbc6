"""What is refused before anything runs, because of what is forbidden, now or until some time."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from math import floor
from typing import TYPE_CHECKING

from sleec_runtime.dispatch.dispatch import refuse_conflict
from sleec_runtime.errors import Prohibited
from sleec_runtime.evaluation.evaluation import Decision, Due
from sleec_runtime.model import Obligation
from sleec_runtime.timed.wording import prohibitions_in_words, window_in_words

if TYPE_CHECKING:
    from sleec_runtime.timed.agenda import Agenda
    from sleec_runtime.timed.cascade import Stage
    from sleec_runtime.timed.clocks import Time
    from sleec_runtime.timed.tasks import Task


def refuse(
    stages: Sequence[Stage], agenda: Agenda, now: Time, events: Sequence[str] = (), settled: bool = False
) -> None:
    """Raises if what `stages` start now, or bring, cannot be.

    Prohibited: for what a prohibition in force forbids, and for an obligation that is forbidden for the whole of its
    window. ConflictInContext, and UndeterminedDecision in strict mode: for what cannot be done together now. `events`
    happen now, besides what is started; if that is `settled`, no prohibition can keep them from it. O(what starts +
    prohibitions in force), and what the constraints cost.
    """
    starting = [task for stage in stages for task in stage.starting(now)]
    for name in (*(() if settled else events), *(task.name for task in starting)):
        forbidden = agenda.prohibitions(name, now)
        if forbidden:
            raise prohibited(f"{name} is due, and {prohibitions_in_words(forbidden, now)}", name, forbidden)
    _refuse_what_stays_forbidden(stages, agenda, now)
    in_force = tuple(
        Decision(task.origin.rule, task.origin.decision.clause, (task.literal,), ()) for task in agenda.forbidden(now)
    )
    happening = tuple(Obligation(name) for name in events)
    decided = [stage.decided_for(now, starting) for stage in stages]
    for stage in {id(stage.snapshot.program): stage for stage in reversed(stages)}.values():
        due = Due((*(d for decisions in decided for d in decisions), *in_force))
        refuse_conflict(stage.snapshot, stages[0].triggers, due, happening)


def prohibited(
    message: str,
    name: str,
    prohibitions: Sequence[Task],
    hint: str = "nothing was executed",
    since: Time | None = None,
) -> Prohibited:
    """The error that says so, with the first whole second at which the prohibitions are over. `since` is the end of one
    that holds but for the moment at which it is called for."""
    ends = [since if task.at_once else task.last for task in prohibitions]
    over = None if any(end is None for end in ends) else max(floor(end) + 1 for end in ends if end is not None)
    return Prohibited(message, name, over, hint)


def _refuse_what_stays_forbidden(stages: Sequence[Stage], agenda: Agenda, now: Time) -> None:
    new = [task for stage in stages if not stage.watched for task in stage.tasks]
    forbidden = [task for task in new if task.literal.negated and not task.at_once]
    for task in new:
        if not task.literal.negated and not task.at_once:
            _refuse_if_forbidden(task, [*agenda.all_prohibitions(task.name), *forbidden], now)
    for prohibition in forbidden:
        for task in agenda.to_do(prohibition.name):
            _refuse_if_forbidden(task, [prohibition], now)


def _refuse_if_forbidden(task: Task, prohibitions: Iterable[Task], now: Time) -> None:
    """Raises Prohibited if one of `prohibitions` leaves no time for `task`, and nothing may come in its place."""
    if not task.is_decided:
        return
    for other in prohibitions:
        if other.name == task.name and other.covers_all(max(task.first, now), task.last):
            raise prohibited(
                f"{task.name} is due ({task.origin.rule.label}, {window_in_words(task, now)}), and "
                f"{prohibitions_in_words([other], now)}",
                task.name,
                [other],
            )
