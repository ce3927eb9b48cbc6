"""The judgement of a course: does what happened follow the rules, and did only that happen?

The requirements say what is missing, and what nothing requires. They are decided by clauses and a solver, because the
robot may run the evaluator of the runtime.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Literal

from sleec_runtime.errors import ConflictInContext, UndeterminedDecision
from sleec_runtime.model import RELATIONS, Rule, Ruleset
from sleec_verify.conformance.scenarios.course import Course, Happening
from sleec_verify.conformance.scenarios.execution import Execution
from sleec_verify.conformance.scenarios.fulfilment import Fulfilment
from sleec_verify.conformance.scenarios.impossibility import Impossibility
from sleec_verify.conformance.scenarios.lawfulness import Broken, Lawfulness
from sleec_verify.conformance.scenarios.requirement import Requirement, Requirements
from sleec_verify.traces.trace import TraceInstant

FaultKind = Literal["missing", "forbidden", "not required", "rejected", "raised", "relation"]


@dataclass(frozen=True)
class Fault:
    """What is wrong with a course, at the time `at`. `requirement` is the broken one, and `statement` the broken
    constraint or relation."""

    kind: FaultKind
    at: int
    names: tuple[str, ...]
    requirement: Requirement | None = None
    happening: Happening | None = None
    statement: object = None


class Judge:
    """Judges courses by the rules of `ruleset`, those of one domain. Without `chains`, responses trigger nothing."""

    def __init__(self, ruleset: Ruleset, chains: bool = True) -> None:
        self.ruleset = ruleset
        self._apart = frozenset() if chains else ruleset.triggers & ruleset.obligations
        self._judged = _with_triggers_apart(ruleset, self._apart) if self._apart else ruleset
        self._requirements = Requirements(self._judged)
        self._impossibility = Impossibility(self._judged, self._requirements)
        self._laws = Lawfulness(self._judged, requirements=self._requirements)

    def fault(self, course: Course) -> Fault | None:
        """The first fault of a course."""
        return min(self.faults(course), key=lambda fault: fault.at, default=None)

    def faults(self, course: Course) -> Iterator[Fault]:
        """The faults of a course."""
        if self._apart:
            course = _with_names_apart(course, self._apart)
        yield from _CourseJudgement(
            course, self._judged, self._laws, Fulfilment(course, self._requirements, self._impossibility)
        ).faults()

    def requirements(self, course: Course) -> tuple[Requirement, ...]:
        """What the rules require in a course."""
        return tuple(self._requirements.of_course(_with_names_apart(course, self._apart) if self._apart else course))


@dataclass
class _CourseJudgement:
    course: Course
    ruleset: Ruleset
    laws: Lawfulness
    fulfilment: Fulfilment

    def faults(self) -> Iterator[Fault]:
        yield from self._errors()
        yield from self._broken_rules()
        yield from self._unrequired()

    # Triggers ---------------------------------------------------------------------------------------------------------

    def _errors(self) -> Iterator[Fault]:
        for place, one in enumerate(self.course.happenings):
            if one.kind == "rejected":
                if not self._may_reject(place, one):
                    yield Fault("rejected", one.at, one.names, happening=one)
            elif one.kind == "occurs" and one.error is not None and not isinstance(one.error, ConflictInContext):
                yield Fault("raised", one.at, one.names, happening=one)

    def _may_reject(self, place: int, one: Happening) -> bool:
        values = self.course.values_at(one.at)
        if isinstance(one.error, UndeterminedDecision):
            return not values.keys() >= self.ruleset.conditions | self.ruleset.measures.keys()
        return self.fulfilment.contradicts(one.names, one.at, place)

    # Rules that are broken -------------------------------------------------------------------------------------------

    def _broken_rules(self) -> Iterator[Fault]:
        unmet: dict[tuple[str, int], dict[int, list[Requirement]]] = {}
        for one in self.fulfilment.requirements:
            if one.replaces is None:
                triggerings = unmet.setdefault((one.rule.label, one.since), {})
                triggerings.setdefault(one.place, []).extend([] if self.fulfilment.is_met(one) else [one])
        for triggerings in unmet.values():
            # An event that occurs again in the same second is one event of the trace.
            for one in min(triggerings.values(), key=len):
                yield self._fault_of(self._unmet(one))
        for broken in self.laws.broken_relations(self.course.trace()):
            if self._by_one_act(broken):
                yield Fault("relation", broken.time, (), statement=broken.statement)

    def _by_one_act(self, broken: Broken) -> bool:
        """Whether one act breaks a constraint or relation. Acts of one second come one after the other."""
        if isinstance(broken.statement, RELATIONS):
            return True
        values = self.course.values_at(broken.time)
        acts: dict[int, set[str]] = {}
        for name, events in self.fulfilment.events.items():
            for _, at, act in events:
                if at == broken.time:
                    acts.setdefault(act, set()).add(name)
        return any(
            broken in self.laws.broken_relations([TraceInstant(broken.time, frozenset(names), values)])
            for names in acts.values()
        )

    def _unmet(self, one: Requirement) -> Requirement:
        """The requirement to blame: the first one that the robot did not try, and could have met."""
        for other in one.otherwise if self.fulfilment.is_excused(one) else ():
            if not self.fulfilment.is_met(other):
                return self._unmet(other)
        return one

    def _fault_of(self, one: Requirement) -> Fault:
        if one.negated:
            execution = next(
                execution for execution in self.fulfilment.of_name(one.name) if self.fulfilment.breaks(execution, one)
            )
            return Fault("forbidden", execution.start.at, (one.name,), one, execution.start)
        return Fault("missing", one.first if one.last is None else one.last, (one.name,), one)

    # Executions that nothing requires --------------------------------------------------------------------------------

    def _unrequired(self) -> Iterator[Fault]:
        used: set[Requirement] = set()
        for execution in self.fulfilment.executions:
            start = execution.start
            candidates = [
                one
                for one in self._demands.get(execution.name, ())
                if one not in used
                and one.place < execution.place
                and one.covers(start.at)
                and self.fulfilment.applies(one, execution.place, start.at)
                and (not self._is_discharged(one, execution) or self._is_of_clause(one, execution))
            ]
            if candidates:
                if execution.end is None or execution.end.kind != "fails":
                    used.add(min(candidates, key=lambda one: _preference(one, start.act)))
            elif not self._relation_requires(execution):
                yield Fault("not required", start.at, (execution.name,), None, start)

    @cached_property
    def _demands(self) -> Mapping[str, list[Requirement]]:
        found: dict[str, list[Requirement]] = {}
        for one in (*self.fulfilment.requirements, *self.fulfilment.contradictory):
            if not one.negated:
                found.setdefault(one.name, []).append(one)
        return found

    def _is_discharged(self, one: Requirement, execution: Execution) -> bool:
        """Whether a requirement was fulfilled before an execution. What happens by itself before an alternative is due
        does not count for it."""
        replaced = one.replaces
        if replaced is not None and (replaced.last is None or not one.overdue):
            return False
        after = -1 if replaced is None or replaced.last is None else replaced.last
        return self.fulfilment.is_done(one, execution.place, execution.start.act, after)

    def _is_of_clause(self, one: Requirement, execution: Execution) -> bool:
        """Whether the code of a clause runs as a whole as its windows open, because something else of it is due."""
        return execution.start.at == one.first and any(
            other.start.act == execution.start.act and not self._is_discharged(due, other)
            for due in self.fulfilment.requirements
            if due.rule is one.rule and due.place == one.place and due.first == one.first and due.name != one.name
            for other in self.fulfilment.of_name(due.name)
        )

    def _relation_requires(self, execution: Execution) -> bool:
        """Whether a relation is broken without the event of an execution."""
        if execution.end is None or not any(isinstance(s, RELATIONS) for s in self.ruleset.statements):
            return False
        without = tuple(one for one in self.course.happenings if one is not execution.end)
        trace = replace(self.course, happenings=without).trace()
        return self._broken_relations(trace) > self._broken_relations(self.course.trace())

    def _broken_relations(self, trace: Sequence[TraceInstant]) -> int:
        return sum(isinstance(one.statement, RELATIONS) for one in self.laws.broken_relations(trace))


def _preference(one: Requirement, act: int) -> tuple[object, ...]:
    """The order in which an execution fulfils requirements: first those of its own act, then the earliest deadline."""
    return one.replaces is not None, one.act != act, one.last is None, one.last


def _with_triggers_apart(ruleset: Ruleset, names: frozenset[str]) -> Ruleset:
    return replace(
        ruleset,
        statements=tuple(
            replace(s, trigger=_apart(s.trigger)) if isinstance(s, Rule) and s.trigger in names else s
            for s in ruleset.statements
        ),
    )


def _with_names_apart(course: Course, names: frozenset[str]) -> Course:
    happenings = tuple(
        replace(one, names=tuple(_apart(name) if name in names else name for name in one.names))
        if one.kind in ("occurs", "rejected")
        else one
        for one in course.happenings
    )
    return replace(course, happenings=happenings)


def _apart(name: str) -> str:
    """The name of an event as a trigger, where it is also a response."""
    return f"{name} (trigger)"
