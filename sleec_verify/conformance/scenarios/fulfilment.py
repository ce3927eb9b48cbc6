"""What was fulfilled in a course, and what the robot could not fulfil."""

from __future__ import annotations

from collections.abc import Iterable
from functools import cached_property
from itertools import groupby

from sleec_verify.conformance.scenarios.course import Course
from sleec_verify.conformance.scenarios.execution import Execution, executions
from sleec_verify.conformance.scenarios.impossibility import Impossibility, Span
from sleec_verify.conformance.scenarios.player import WithheldCompletion
from sleec_verify.conformance.scenarios.requirement import Requirement, Requirements

_MOST_TIMES = 60


class Fulfilment:
    """The requirements of a course, and which of them are met.

    `contradictory` are the requirements of completions that lead to a contradiction: they cannot be rejected, and
    nothing has to be executed then.
    """

    def __init__(self, course: Course, source: Requirements, impossibility: Impossibility) -> None:
        self.course = course
        self.impossibility = impossibility
        self.executions = tuple(executions(self.course))
        self.events: dict[str, list[tuple[int, int, int]]] = {}
        """For each event, its places, times and acts."""
        for place, one in enumerate(self.course.happenings):
            if one.kind in ("occurs", "done"):
                for name in one.names:
                    self.events.setdefault(name, []).append((place, one.at, one.act))
        self.requirements: tuple[Requirement, ...] = ()
        self.contradictory: tuple[Requirement, ...] = ()
        for place, made in groupby(source.of_course(self.course), key=lambda one: one.place):
            group = tuple(made)
            if self._could_be_rejected(group[0]) or not self.contradicts(
                self.course.happenings[place].names, group[0].since, place
            ):
                self.requirements += group
            else:
                self.contradictory += group

    def contradicts(self, names: Iterable[str], time: int, place: int, happening: Iterable[str] = ()) -> bool:
        """Whether the events `names` lead to a contradiction at a place of the course."""
        happenings = self.course.happenings
        act = happenings[place].act if place < len(happenings) else None
        # A prohibition of one instant holds for its own act.
        known = [
            one
            for one in self.requirements
            if one.place < place
            and (act in (None, one.act) or not one.of_its_trigger)
            and (self.applies(one, place, time) or self._may_apply(one, place, time))
        ]
        return self.impossibility.contradicts(
            names,
            time,
            self.course.values_at(time),
            [_span(one) for one in known if one.negated],
            [
                _span(one)
                for one in known
                if not (one.negated or one.otherwise or one.choices or self.is_done(one, place))
                and (one.last is None or one.last >= time)
            ],
            happening,
        )

    def is_met(self, one: Requirement) -> bool:
        """Whether a requirement or its alternative is fulfilled, or cannot be fulfilled by the robot."""
        if self.is_fulfilled(one):
            return True
        if one.last is None and one.first > self.course.end:
            return True
        if one.last is not None and one.last > self.course.end:
            return True
        if _has_empty_alternative(one):
            return True
        for late in (True, False):
            group = [choice for choice in one.choices if choice.response.overdue == late]
            if group and all(map(self.is_met, group)):
                return True
        if one.otherwise:
            return all(map(self.is_met, one.otherwise))
        return self.is_excused(one)

    def is_fulfilled(self, one: Requirement) -> bool:
        events = self.events.get(one.name, ())
        if one.negated:
            # What comes before the trigger in the same second is not undone.
            return not any(one.covers(at) and place > one.place for place, at, _ in events)
        return any(one.covers(at) for _, at, _ in events)

    def is_excused(self, one: Requirement) -> bool:
        """Whether the robot did what it could: the scenario withheld the completion, or something else forbade it."""
        if one.negated:
            return not any(self.breaks(execution, one) for execution in self.of_name(one.name))
        tried = [execution for execution in self.of_name(one.name) if self._is_attempt(execution, one)]
        if tried:
            failed = [attempt.end for attempt in tried if attempt.end is not None and attempt.end.kind == "fails"]
            if one.at_once and not failed:
                return True  # What takes time is started at that instant, and has no deadline.
            missed = failed[-1].at if failed else one.last
            # `otherwise` after `eventually` is never due.
            choices = [choice for choice in one.choices if one.last is not None or not choice.response.overdue]
            return missed is None or not any(_is_possible_at(choice, missed) for choice in choices)
        return self._is_stopped_with_another(one) or self._is_impossible(one)

    def _is_stopped_with_another(self, one: Requirement) -> bool:
        """Whether the exception that the scenario raised in the code of a clause, or of an alternative, stopped it
        before this obligation of the same code."""
        clause = {
            other.name
            for other in self.requirements
            if other.rule is one.rule and other.place == one.place and other.replaces is one.replaces
        }
        for name in clause - {one.name}:
            of_window = (e for e in self.of_name(name) if e.place > one.place and one.covers(e.start.at))
            first = next(of_window, None)
            if first is not None and first.end is not None and isinstance(first.end.error, WithheldCompletion):
                return True
        return False

    def _is_attempt(self, execution: Execution, one: Requirement) -> bool:
        """Whether an execution would have fulfilled a requirement if the scenario had let it complete."""
        end = execution.end
        if end is not None and end.kind == "fails":
            if not isinstance(end.error, WithheldCompletion):
                return False
        elif one.name not in self.course.takes_time:
            return False  # A coroutine that takes too long.
        in_window = one.covers(execution.start.at) and execution.place > one.place
        under_way = execution.runs_at(one.place) and (one.last is None or execution.start.at <= one.last)
        ends_later = end is None or end.kind == "fails" or (one.last is not None and end.at > one.last)
        return ends_later and (in_window or under_way)

    def breaks(self, execution: Execution, one: Requirement) -> bool:
        """Whether an execution begins although `one` forbids it, and completes what it forbids."""
        done = execution.done_at
        if execution.place < one.place or done is None or not one.covers(done):
            return False
        if one.overdue and one.replaces is not None and execution.start.at == one.replaces.last:
            return False  # It may have come before the clock.
        if not one.covers(execution.start.at) or not self.applies(one, execution.place, execution.start.at):
            return False
        return not one.of_its_trigger or execution.start.act == one.act

    def _is_impossible(self, one: Requirement) -> bool:
        """Whether something forbids a requirement at each time of its window, which its trigger did not show."""
        if one.replaces is None and self._could_be_rejected(one):
            if one.of_its_trigger:
                return False
            demand = _span(one)
            undecided = one.otherwise or one.choices
            bans = [
                other
                for other in self.requirements
                if other.negated and other.replaces is None and (one.last is None or other.since <= one.last)
            ]
            if not undecided and any(
                not other.at_once and _span(other).covers_all(demand, max(one.since, other.since)) for other in bans
            ):
                return False
        return all(self._is_impossible_at(one, time) for time in self._times_in(one))

    def _could_be_rejected(self, one: Requirement) -> bool:
        """Whether the rule was triggered by a trigger, or at once by what a trigger started."""
        return any(
            other.kind == "occurs" and other.act == one.act and other.at == one.since
            for other in self.course.happenings[: one.place + 1]
        )

    def _is_impossible_at(self, one: Requirement, time: int) -> bool:
        events = [name for name, found in self.events.items() if any(at == time for _, at, _ in found)]
        return self.contradicts((one.name,), time, len(self.course.happenings), events)

    def _times_in(self, one: Requirement) -> list[int]:
        """The times of a window at which something may change."""
        last = self.course.end if one.last is None else min(one.last, self.course.end)
        times = {one.first, last, *self.course.values}
        for other in self.requirements:
            times.add(other.first)
            if other.last is not None:
                times.add(other.last + 1)
        times |= {time + 1 for found in self.events.values() for _, time, _ in found}
        return sorted(time for time in times if one.first <= time <= last)[:_MOST_TIMES]

    def applies(self, one: Requirement, place: int, time: int) -> bool:
        """Whether a requirement is due, before a place of the course: an alternative is, once what it replaces is
        not fulfilled in time."""
        replaced = one.replaces
        if replaced is None:
            return True
        if not self.applies(replaced, place, time):
            return False
        if replaced.negated:
            broken = self.is_done(replaced, place)
            return broken and replaced.last is not None and time >= replaced.last
        if one.overdue and (replaced.last is None or time < replaced.last):
            return False
        failed = any(
            execution.end is not None and execution.end.kind == "fails" and not execution.runs_at(place)
            for execution in self.of_name(replaced.name)
            if replaced.place < execution.place < place
        )
        if one.overdue and replaced.last is not None:
            # A completion in the last second is in time for the clock only if it comes before the clock.
            place = min(place, self._clock_starts.get(replaced.last, place))
        return (failed and not one.overdue) or not self.is_done(replaced, place)

    @cached_property
    def _clock_starts(self) -> dict[int, int]:
        """For each time at which the clock starts something, the place of the first start."""
        acts: set[int] = set()
        found: dict[int, int] = {}
        for place, one in enumerate(self.course.happenings):
            if one.kind == "starts" and one.act not in acts:
                found.setdefault(one.at, place)
            acts.add(one.act)
        return found

    def _may_apply(self, one: Requirement, place: int, time: int) -> bool:
        """Whether a requirement is due if its predecessor was completed in its last second, but after the clock."""
        replaced = one.replaces
        if replaced is None or replaced.last is None or not one.overdue or replaced.negated or time < replaced.last:
            return False
        events = self.events.get(replaced.name, ())
        return not any(replaced.first <= at < replaced.last and replaced.place < other for other, at, _ in events)

    def is_done(self, one: Requirement, place: int, act: int | None = None, after: int = -1) -> bool:
        """Whether the event of a requirement occurred in its window after its trigger and before a place. Events of the
        act `act`, and up to the time `after`, do not count."""
        return any(
            one.place < other < place and one.covers(at) and done_in != act and at > after
            for other, at, done_in in self.events.get(one.name, ())
        )

    def of_name(self, name: str) -> list[Execution]:
        return [execution for execution in self.executions if execution.name == name]


def _span(one: Requirement) -> Span:
    return Span(one.name, one.first, one.last)


def _has_empty_alternative(one: Requirement) -> bool:
    """Whether an alternative requires nothing."""
    timing = one.response.obligation.timing
    if timing is None:
        return False
    overdue = [other.response.overdue for other in (*one.otherwise, *one.choices)]
    return (timing.otherwise is not None and True not in overdue) or (
        timing.instead is not None and False not in overdue
    )


def _is_possible_at(choice: Requirement, time: int) -> bool:
    """Whether a choice can still be fulfilled after a time."""
    return not choice.negated and not choice.at_once and (choice.last is None or choice.last >= time)
