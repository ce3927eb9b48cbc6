"""Duties: what a triggered rule requires, with windows and alternatives, until it is met or missed.

Whether a duty is met is a formula over its dues, as in `evaluation.trace_violations`: an obligation is met by itself,
or by all obligations of an alternative. Dues and alternatives can be unknown, so the formula has three values (Kleene).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import NamedTuple

from sleec_runtime.audit.deviation import Triggered
from sleec_runtime.evaluation.formula_truth import Situation
from sleec_runtime.evaluation.hedge_chain import Undetermined, decide_chain
from sleec_runtime.evaluation.trace import Untimed
from sleec_runtime.model import LONGEST, Clause, Length, Obligation, Rational, Reading, Window, exact


@dataclass(slots=True, eq=False)
class Due:
    """An event that must occur, or must not occur, from `first` to `last`, or from `first` on if `last` is None.

    `at_once`: it has no window. `met` is None while it is open, and `at` is the time at which it was met or missed.
    """

    obligation: Obligation
    since: Rational
    first: Rational
    last: Rational | None
    at_once: bool
    met: bool | None = None
    at: Rational | None = None


@dataclass(slots=True, eq=False)
class Task:
    """An obligation and its alternatives, each a set of tasks or None if its clause is unknown. `due` is None if the
    window is unknown. `missing` are the values that were not reported."""

    due: Due | None
    alternatives: tuple[tuple[Task, ...] | None, ...]
    missing: tuple[str, ...]

    def met(self) -> bool | None:
        """Whether the task is met; None if this is not known yet, or depends on `missing`."""
        own = None if self.due is None else self.due.met
        if own:
            return True
        values = [own, *(None if tasks is None else _all(tasks) for tasks in self.alternatives)]
        return True if True in values else None if None in values else False

    def dues(self) -> Iterator[Due]:
        """The dues of the task and of its alternatives."""
        if self.due is not None:
            yield self.due
        for tasks in self.alternatives:
            for task in tasks or ():
                yield from task.dues()

    def unreported(self) -> Iterator[str]:
        """The values that were not reported, also for the alternatives."""
        yield from self.missing
        for tasks in self.alternatives:
            for task in tasks or ():
                yield from task.unreported()


def _all(tasks: tuple[Task, ...]) -> bool | None:
    values = [task.met() for task in tasks]
    return False if False in values else None if None in values else True


@dataclass(slots=True, eq=False)
class Duty:
    """An obligation of a triggered rule, the one with the number `number` in its active clause."""

    triggered: Triggered
    number: int
    task: Task
    settled: bool = False


class DutyMaker(NamedTuple):
    """Makes duties, in a reading, and with a meaning of responses without a window."""

    reading: Reading
    untimed: Untimed

    def duties(self, triggered: Triggered, situation: Situation) -> Iterator[Duty]:
        """The duties of a triggered rule. `situation` is that of its time, in the open world."""
        assert triggered.decision is not None
        for number, obligation in enumerate(triggered.decision.obligations):
            yield Duty(triggered, number, self._task(obligation, triggered.time, situation))

    def _task(self, obligation: Obligation, since: Rational, situation: Situation) -> Task:
        timing = obligation.timing
        window = None if timing is None else timing.window
        missing: dict[str, None] = {}
        due: Due | None
        last: Rational | None
        if window is None:
            at_once = self.untimed == "at"
            due = Due(obligation, since, since, since if at_once else None, at_once)
            last = since
        else:
            start = 0 if window.start is None else _seconds(window.start, situation, missing)
            length = None if window.end is None else _seconds(window.end, situation, missing)
            last = None if length is None else since + length
            due = None if start is None or missing else Due(obligation, since, since + start, last, False)
        alternatives: list[tuple[Task, ...] | None] = []
        if timing is not None and timing.otherwise is not None:
            end = self._end(window, since, last)
            if end is None:
                alternatives.append(None)
            else:
                alternatives.append(self._clause(timing.otherwise, end, situation, missing))
        if timing is not None and timing.instead is not None:
            alternatives.append(self._clause(timing.instead, since, situation, missing))
        return Task(due, tuple(alternatives), tuple(missing))

    def _end(self, window: Window | None, since: Rational, last: Rational | None) -> Rational | None:
        """The time from which what follows ``otherwise`` is due. None: it is unknown, or before the trigger, because a
        measure gives a negative length; occurrences of that time are not stored."""
        if window is None or window.end is None:
            return since
        return None if last is None or last < since else last

    def _clause(
        self, clause: Clause, since: Rational, situation: Situation, missing: dict[str, None]
    ) -> tuple[Task, ...] | None:
        decision = decide_chain(clause, situation, self.reading)
        if isinstance(decision, Undetermined):
            missing.update(dict.fromkeys(decision.missing))
            return None
        return tuple(self._task(obligation, since, situation) for obligation in decision.obligations)


def within_reach(seconds: Rational) -> Rational:
    """A distance in time, at most twice the time of the latest possible observation. Longer ones have the same effect,
    and measures give numbers that a float cannot have."""
    return max(-2 * LONGEST, min(seconds, 2 * LONGEST))


def _seconds(length: Length, situation: Situation, missing: dict[str, None]) -> Rational | None:
    """The length in seconds; None if it depends on values that were not reported, which are added to `missing`."""
    values = {}
    for name in length.measures:
        value = exact(situation.context.conditions.get(name))
        if value is None:
            missing[name] = None
        else:
            values[name] = value
    return within_reach(length.seconds_where(values)) if len(values) == len(length.measures) else None
