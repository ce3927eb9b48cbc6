"""The tasks of a response. They are decided at the trigger, with all alternatives.

The hedges of alternatives are decided, and the measures in lengths are read, in the context of the trigger. So the
whole tree of possible tasks is known before anything runs.
"""

from __future__ import annotations

from collections.abc import Sequence

from sleec_runtime.errors import UndeterminedDecision, WrongType
from sleec_runtime.evaluation.formula_truth import Situation
from sleec_runtime.evaluation.hedge_chain import Undetermined, decide_chain
from sleec_runtime.model import Clause, Length, Obligation, Rational
from sleec_runtime.timed.clock import FURTHEST, Time
from sleec_runtime.timed.task import Origin, Path, Task

_LENGTH = f"the length of a window, from 0 to {FURTHEST:,} seconds"


def tasks_of(obligations: Sequence[Obligation], due: Time, origin: Origin, path: Path = ()) -> tuple[Task, ...]:
    """The tasks of `obligations` that are due from the time `due` on; `path` leads to them.

    O(size of the responses). Raises UndeterminedDecision if a hedge of an alternative or the length of a window depends
    on unreported values, and WrongType for an invalid length.
    """
    return tuple(_task(obligation, due, origin, (*path, index)) for index, obligation in enumerate(obligations))


def _task(obligation: Obligation, due: Time, origin: Origin, path: Path) -> Task:
    timing = obligation.timing
    window = None if timing is None else timing.window
    last: Time | None
    if window is None:
        first, last, at_once = due, None, True
    else:
        start = 0 if window.start is None else _seconds(window.start, origin)
        first = due + start
        if window.end is None:
            last, at_once = None, False
        else:
            end = _seconds(window.end, origin)
            if end < start:
                raise WrongType(
                    str(window.end), end, f"the end of a window that starts after {start} seconds", "end it later"
                )
            # For a window of length 0, a start at that time is enough.
            last, at_once = due + end, end == start
    task = Task(obligation, origin, first, last, at_once, path)
    if timing is not None and timing.otherwise is not None:
        over = due if last is None else last
        task.otherwise = tasks_of(_active(timing.otherwise, origin), over, origin, (*path, "otherwise"))
    if timing is not None and timing.instead is not None:
        task.instead = tasks_of(_active(timing.instead, origin), due, origin, (*path, "else"))
    return task


def _active(clause: Clause, origin: Origin) -> tuple[Obligation, ...]:
    """The obligations of the active clause of an alternative, decided as the chain of a rule."""
    index = origin.snapshot.index
    situation = Situation(origin.snapshot.context(origin.triggers), index.measures, None if index.strict else False)
    outcome = decide_chain(clause, situation, index.ruleset.reading)
    if isinstance(outcome, Undetermined):
        raise UndeterminedDecision((origin.rule.trigger,), outcome.missing)
    return outcome.obligations


def _seconds(length: Length, origin: Origin) -> Rational:
    values = {}
    for name in length.measures:
        value = origin.snapshot.conditions.get(name)
        if value is None:
            raise UndeterminedDecision(
                (origin.rule.trigger,), (name,), f"report `{name}` with update(): it gives the length of a window"
            )
        if isinstance(value, (bool, str)):
            raise WrongType(name, value, _LENGTH)
        values[name] = value
    found = length.seconds_where(values)
    if not 0 <= found <= FURTHEST:
        raise WrongType(str(length), found, _LENGTH)
    return found
