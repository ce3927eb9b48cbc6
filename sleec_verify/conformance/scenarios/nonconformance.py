"""A scenario in which a robot does not follow the rules, in words."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

from sleec_runtime.model import Context, Obligation, obligation_text
from sleec_verify.conformance.failure import Nonconformance
from sleec_verify.conformance.oracle import ActiveClause, Expectation
from sleec_verify.conformance.scenarios.course import Course
from sleec_verify.conformance.scenarios.judgement import Fault
from sleec_verify.conformance.scenarios.requirement import Requirement
from sleec_verify.conformance.scenarios.scenario import Scenario
from sleec_verify.conformance.subject import Observation
from sleec_verify.wording.phrases import value_text


class ScenarioNonconformance(Nonconformance):
    """A robot did not follow rules with time. `scenario`, `course` and `fault` are for programs.

    `context` is that of the trigger of the broken rule, or that of the fault. `expected` and `observed` are what was
    due and what was executed in the second of the fault.
    """

    def __init__(
        self,
        scenario: Scenario,
        course: Course,
        fault: Fault,
        requirements: Sequence[Requirement],
        before: Sequence[str] = (),
    ) -> None:
        self.scenario = scenario
        self.course = course
        self.fault = fault
        self.requirements = tuple(requirements)
        broken = [fault.requirement] if fault.requirement is not None else _about(fault, requirements)
        self.context = _context(course, broken[0].since if broken else fault.at)
        self.expected = _expected(broken)
        self.observed = Observation(
            tuple(one.names[0] for one in course.happenings if one.kind == "starts" and one.at == fault.at),
            error=None if fault.happening is None else fault.happening.error,
        )
        self.what = _what(fault, course, requirements)
        self.before = tuple(before)
        AssertionError.__init__(self, "\n".join(self._lines(broken)))

    def concerns(self, label: str) -> bool:
        """Whether a rule is broken, or nothing tells which one is."""
        return self.fault.requirement is None or self.fault.requirement.rule.label == label

    def after(self, before: Sequence[str]) -> ScenarioNonconformance:
        """The same, with its history."""
        return ScenarioNonconformance(self.scenario, self.course, self.fault, self.requirements, before)

    def _lines(self, broken: Sequence[Requirement]) -> Iterator[str]:
        yield self.what
        yield "  scenario:"
        yield from (f"    {line}" for line in _scenario_lines(self.scenario, self.course))
        yield "  executed:"
        yield from (f"    {line}" for line in _executed_lines(self.course) or ["nothing"])
        yield "  required:"
        yield from (f"    {line}" for one in broken for line in _required_lines(one))
        if not broken:
            yield "    no rule requires it"
        if self.before:
            yield "  after:"
            yield from (f"    {line}" for line in self.before)


def _what(fault: Fault, course: Course, requirements: Sequence[Requirement]) -> str:
    name, one = ", ".join(fault.names), fault.requirement
    if fault.kind == "missing":
        assert one is not None
        if one.last is None:
            return f"did not execute {name}"
        late = [
            h.at for h in course.happenings if h.kind == "starts" and h.names == fault.names and h.at > (one.last or 0)
        ]
        when = f"at {one.last} s" if one.at_once else f"by {one.last} s"
        return f"did not execute {name} {when}" + (f", but at {late[0]} s" if late else "")
    if fault.kind == "forbidden":
        return f"executed {name} at {fault.at} s, although forbidden"
    if fault.kind == "not required":
        return f"executed {name} at {fault.at} s, although not required" + _why_not_required(
            fault, course, requirements
        )
    error = None if fault.happening is None else fault.happening.error
    if fault.kind == "rejected":
        return f"rejected {name} at {fault.at} s, although the rules can be followed: {error}"
    if fault.kind == "raised":
        return f"raised {type(error).__name__} when {name} occurred at {fault.at} s: {error}"
    return f"broke `{fault.statement}` at {fault.at} s"


def _why_not_required(fault: Fault, course: Course, requirements: Sequence[Requirement]) -> str:
    """The reason, where some rule requires the same at another time or in another case."""
    assert fault.happening is not None
    before = replace(course, happenings=course.happenings[: course.happenings.index(fault.happening)])
    for one in _about(fault, requirements):
        replaced = one.replaces
        if replaced is not None and one.overdue:
            done = [at for at, name in before.occurrences() if name == replaced.name and replaced.covers(at)]
            if done and not replaced.negated:
                return f": {replaced.name} was done at {done[0]} s, in time"
            if replaced.last is not None and fault.at < replaced.last:
                return f": it is due only if {replaced.response.obligation} is not met by {replaced.last} s"
        if fault.at < one.first:
            return f": it is due from {one.first} s on"
        if one.covers(fault.at):
            return ": it was already executed"
    return ""


def _about(fault: Fault, requirements: Sequence[Requirement]) -> list[Requirement]:
    """The requirements of the same event whose triggers came before the fault."""
    return [one for one in requirements if one.name in fault.names and not one.negated and one.since <= fault.at]


def _context(course: Course, time: int) -> Context:
    names = (name for one in course.happenings if one.at == time and one.kind == "occurs" for name in one.names)
    return Context(frozenset(names), course.values_at(time))


def _expected(broken: Sequence[Requirement]) -> Expectation:
    active = tuple(
        ActiveClause(one.rule.label, one.clause, one.rule.layer(one.clause), (one.response.obligation,))
        for one in broken
    )
    obligations: list[Obligation] = [one.response.obligation for one in broken]
    return Expectation(
        active,
        tuple(o.name for o in obligations if not o.negated),
        tuple(o.name for o in obligations if o.negated),
        False,
        True,
    )


def _scenario_lines(scenario: Scenario, course: Course) -> Iterator[str]:
    for step in scenario.steps:
        facts = [
            f"{name} is {'not known' if value is None else value_text(value)}" for name, value in step.given.items()
        ]
        occur = [f"{', '.join(f'`{name}`' for name in step.when)} {'occurs' if len(step.when) == 1 else 'occur'}"]
        yield f"{step.at} s: {', '.join((occur if step.when else []) + facts) or 'nothing changes'}"
    unfinished = {
        one.names[0]
        for place, one in enumerate(course.happenings)
        if one.kind == "starts" and _ends_at_once(course, place) is None
    }
    # Several executions of one name may have the same completion.
    for completion in dict.fromkeys(scenario.completions):
        if completion.name in unfinished:
            when = "never" if completion.at is None else f"at {completion.at} s"
            yield f"{completion.name}, if due from {completion.since} s on, is completed {when}"


def _executed_lines(course: Course) -> list[str]:
    lines: list[str] = []
    at_once: set[int] = set()
    for place, one in enumerate(course.happenings):
        name = one.names[0]
        if one.kind == "starts":
            end = _ends_at_once(course, place)
            if end is not None:
                at_once.add(end)
            lines.append(f"{one.at} s: {name}{'' if end is not None else ' starts'}")
        elif one.kind == "done" and place not in at_once:
            lines.append(f"{one.at} s: {name} is done")
        elif one.kind == "fails":
            lines.append(f"{one.at} s: {name} raises {type(one.error).__name__}")
        elif one.kind == "rejected":
            lines.append(f"{one.at} s: rejects {', '.join(one.names)}")
    return lines


def _ends_at_once(course: Course, place: int) -> int | None:
    """The place at which an execution is done, if this is in the second of its start."""
    start = course.happenings[place]
    for other, one in enumerate(course.happenings[place + 1 :], place + 1):
        if one.at > start.at:
            return None
        if one.names == start.names and one.kind in ("done", "fails"):
            return other if one.kind == "done" else None
    return None


def _required_lines(one: Requirement) -> Iterator[str]:
    chain = [one]
    while chain[0].replaces is not None:
        chain.insert(0, chain[0].replaces)
    first = chain[0]
    yield (
        f"by rule {first.rule.label}, clause {first.clause}, triggered at {first.since} s: "
        f"{obligation_text(first.response.obligation)}"
    )
    for part in chain:
        literal = part.response.obligation
        if part.last is None:
            window = f"from {part.first} s on"
        else:
            window = f"at {part.first} s" if part.at_once else f"from {part.first} s to {part.last} s"
        yield f"  {'otherwise ' if part.overdue else 'or ' if part.replaces else ''}{literal}: {window}"
