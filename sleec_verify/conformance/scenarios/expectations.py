"""Whether what a scenario states is what the rules require in it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence

from sleec_runtime.model import Ruleset, Value
from sleec_verify.conformance.scenarios.lawfulness import Lawfulness
from sleec_verify.conformance.scenarios.scenario import Scenario
from sleec_verify.results.timeline import Due
from sleec_verify.traces.trace import TraceInstant
from sleec_verify.wording.phrases import quoted


def trace_of(scenario: Scenario) -> tuple[TraceInstant, ...]:
    """The trace of a scenario if the robot does what it states: each obligation when the scenario completes it,
    otherwise at once."""
    events: dict[int, set[str]] = {step.at: set(step.when) for step in scenario.steps}
    late = {(one.name, one.since): one.at for one in scenario.completions}
    for due in scenario.obligations:
        at = late.get((due.event, due.start), due.start)
        if at is not None:
            events.setdefault(at, set()).add(due.event)
    changes = {step.at: step.given for step in scenario.steps}
    values: dict[str, Value] = {}
    trace = []
    for time in sorted(events):
        values = _changed(values, changes.get(time, {}))
        trace.append(TraceInstant(time, frozenset(events[time]), values))
    return tuple(trace)


def _changed(values: Mapping[str, Value], changes: Mapping[str, Value | None]) -> dict[str, Value]:
    return {name: value for name, value in {**values, **changes}.items() if value is not None}


def unexpected(ruleset: Ruleset, scenario: Scenario) -> Iterator[str]:
    """The differences between what a scenario states and what the rules of its domain require, in words.

    Raises WrongType for a measure without a value that gives the length of a window.
    """
    trace = trace_of(scenario)
    laws = Lawfulness(ruleset)
    due = laws.due(trace)
    yield from _different("obligation", scenario.obligations, [one for one in due if not one.negated])
    if scenario.prohibitions is not None:
        yield from _different("prohibition", scenario.prohibitions, [one for one in due if one.negated])
    for one in laws.broken(trace):
        text = ruleset.source.text[one.statement.span.start : one.statement.span.end].split("\n")[0]
        yield f"violated at {one.time}: {text}"


def required_in(ruleset: Ruleset, trace: Sequence[TraceInstant]) -> tuple[Due, ...]:
    """What the rules of one domain require in a trace. Raises WrongType as `unexpected`."""
    return Lawfulness(ruleset).due(trace)


def _different(what: str, stated: Sequence[Due], required: Sequence[Due]) -> Iterator[str]:
    for due in _missing(stated, required):
        yield f"{what} that the rules do not require: {_in_words(due)}"
    for due in _missing(required, stated):
        yield f"{what} that the case does not state: {_in_words(due)}"


def _missing(ones: Iterable[Due], others: Sequence[Due]) -> Iterator[Due]:
    """Those that are not among others. A case need not name the rule."""
    for one in ones:
        if not any(_is_same(one, other) for other in others):
            yield one


def _is_same(one: Due, other: Due) -> bool:
    same_rule = "" in (one.rule, other.rule) or (one.rule, one.clause) == (other.rule, other.clause)
    return same_rule and (one.event, one.start, one.end) == (other.event, other.start, other.end)


def _in_words(due: Due) -> str:
    end = "on" if due.end is None else f"to {due.end} seconds"
    return f"{quoted(due.event)} from {due.start} {end}" + (f" (rule {quoted(due.rule)})" if due.rule else "")
