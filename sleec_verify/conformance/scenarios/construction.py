"""From a trace to a scenario: the steps of the test, the completions of the robot, and what the rules require."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence

from sleec_runtime.model import Value
from sleec_verify.conformance.scenarios.lawfulness import Lawfulness
from sleec_verify.conformance.scenarios.scenario import Completion, Scenario, Step
from sleec_verify.results.timeline import Due
from sleec_verify.traces.index import TraceIndex
from sleec_verify.traces.relations import names_of_relation, names_of_rule
from sleec_verify.traces.trace import TraceInstant


def scenario_of(index: TraceIndex, name: str, trace: Sequence[TraceInstant]) -> Scenario | None:
    """The scenario in which this trace happens, or None if the trace breaks a statement.

    An event occurs because a rule requires it, or else the test causes it. Obligations that trigger nothing occur only
    as rules require. Values change only where rules read them, or else where relations do.
    """
    laws = Lawfulness(index.ruleset, index.untimed)
    related = {name for relation in index.relations for kind, name in names_of_relation(relation) if kind == "measure"}
    candidates = (list(_with_lasting_values(index, trace, read)) for read in (frozenset[str](), related))
    moments = next((found for found in candidates if not laws.broken(found)), None)
    if moments is None:
        return None
    due = laws.due(moments)
    needed = _without_unrequired(index, [one for one in due if not one.negated], moments)
    if not laws.broken(needed):
        moments, due = needed, laws.due(needed)
    required = [one for one in due if not one.negated]
    steps = tuple(_steps(moments, required))
    ends = [one.start if one.end is None else one.end for one in due]
    return Scenario(
        name,
        steps,
        max([moments[-1].time, *ends]),
        tuple(_completions(required, moments)),
        tuple(required),
        tuple(one for one in due if one.negated),
    )


def _without_unrequired(
    index: TraceIndex, required: Sequence[Due], moments: Sequence[TraceInstant]
) -> list[TraceInstant]:
    """The instants without the obligations that trigger nothing and that no requirement needs. The solver meets each
    requirement at an instant of its own, where one instant may serve several."""
    acts = index.ruleset.obligations - index.by_trigger.keys()
    return [
        TraceInstant(one.time, one.events - (acts - _met_at(required, one.time, moments)), one.conditions)
        for one in moments
    ]


def _with_lasting_values(
    index: TraceIndex, trace: Sequence[TraceInstant], related: Collection[str]
) -> Iterator[TraceInstant]:
    """The instants with the values of the names in `related`, and of those that rules read there. Other values are
    those from before."""
    values: dict[str, Value] = {}
    for instant in trace:
        read = _read_at(index, instant).union(related)
        values = {**values, **{name: value for name, value in instant.conditions.items() if name in read}}
        yield TraceInstant(instant.time, instant.events, values)


def _read_at(index: TraceIndex, instant: TraceInstant) -> set[str]:
    """The conditions and measures that the rules which are triggered at an instant read."""
    rules = [rule for event in instant.events for rule in index.by_trigger.get(event, ())]
    return {name for rule in rules for _, name in names_of_rule(rule)}


def _completions(required: Sequence[Due], moments: Sequence[TraceInstant]) -> Iterator[Completion]:
    """When requirements that start at one time are met, unless this is at once."""
    starts: dict[tuple[str, int], list[Due]] = {}
    for due in required:
        starts.setdefault((due.event, due.start), []).append(due)
    for (event, since), together in starts.items():
        times = (one.time for one in moments if event in one.events and any(_covers(due, one.time) for due in together))
        at = next(times, None)
        if at != since:
            yield Completion(event, since, at)


def _covers(due: Due, time: int) -> bool:
    return due.start <= time and (due.end is None or time <= due.end)


def _steps(moments: Sequence[TraceInstant], required: Sequence[Due]) -> Iterator[Step]:
    """The times at which the test changes values or causes events."""
    before: Mapping[str, Value] = {}
    for moment in moments:
        done = _met_at(required, moment.time, moments)
        given = {name: value for name, value in moment.conditions.items() if before.get(name) != value}
        when = tuple(sorted(moment.events - done))
        if when or any(name in before or value is not False for name, value in given.items()):
            yield Step(moment.time, when, given)
            before = moment.conditions


def _met_at(required: Sequence[Due], time: int, moments: Sequence[TraceInstant]) -> set[str]:
    """The events that are the first to meet a requirement, if they occur at this time."""
    return {
        due.event
        for due in required
        if _covers(due, time) and not any(due.start <= one.time < time and due.event in one.events for one in moments)
    }
