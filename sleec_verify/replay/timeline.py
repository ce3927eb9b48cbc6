"""Timelines of traces: which events occur when, and the windows of the rules' requirements.

The evaluator of the runtime, which shares no code with the encoding, computes which clause decides.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence

from sleec_runtime.evaluation.hedge_chain import decide
from sleec_runtime.model import Context, Rule, obligation_text
from sleec_verify.encoding.response_windows import ResponseWindows, WindowedResponse
from sleec_verify.results import timeline
from sleec_verify.results.timeline import Due, Timeline
from sleec_verify.traces.index import TraceIndex
from sleec_verify.traces.relations import names_of_rule
from sleec_verify.traces.trace import TraceInstant


def timeline_of(
    index: TraceIndex, moments: Sequence[TraceInstant], now: int | None = None, labels: Collection[str] | None = None
) -> Timeline:
    """The timeline of a trace, or of a history up to the instant `now`. With `labels`, only of these rules."""
    shown = []
    for moment in moments:
        rules = [
            rule
            for event in sorted(moment.events)
            for rule in index.by_trigger.get(event, ())
            if labels is None or rule.label in labels
        ]
        named = {name for rule in rules for _, name in names_of_rule(rule)}
        telling = tuple(name for name in moment.conditions if labels is None or name in named)
        due = tuple(dict.fromkeys(_due(index, rules, moment, moments, over=now is None)))
        shown.append(timeline.Moment(moment.time, tuple(sorted(moment.events)), moment.conditions, telling, due))
    return Timeline(tuple(shown), now)


def _due(
    index: TraceIndex, rules: Sequence[Rule], moment: TraceInstant, course: Sequence[TraceInstant], over: bool
) -> Iterator[Due]:
    """The requirements of the rules that are triggered at an instant. With `over`, nothing happens after the last
    instant."""
    context = Context(moment.events, moment.conditions)
    windows = ResponseWindows(index.ruleset, context, index.untimed)
    for rule in rules:
        decision = decide(rule, context, index.ruleset.reading, index.ruleset.measures)
        if decision is None:
            continue
        clause = list(rule.clauses())[decision.clause]
        for one in windows.of(clause):
            if any(_is_met(other, moment.time, course, over) for other in _replaced(one)):
                continue
            assert one.start is not None, "a trace gives a value to the measures of its windows"
            yield Due(
                rule.label,
                decision.clause,
                obligation_text(one.obligation),
                one.obligation.name,
                one.obligation.negated,
                moment.time + one.start,
                None if one.end is None else moment.time + one.end,
                None if one.instead is None else str(one.instead.obligation),
                one.overdue,
            )


def _replaced(one: WindowedResponse) -> Iterator[WindowedResponse]:
    """The response that a response replaces, and whether it was missed."""
    while one.instead is not None:
        one = one.instead
        yield one


def _is_met(one: WindowedResponse, triggered: int, course: Sequence[TraceInstant], over: bool) -> bool:
    """Whether a response is certainly met, so that its alternative is not due any more."""
    assert one.start is not None, "a trace gives a value to the measures of its windows"
    start, end = triggered + one.start, None if one.end is None else triggered + one.end
    open_still = not over and (end is None or end >= course[-1].time)
    done = any(
        start <= moment.time and (end is None or moment.time <= end)
        for moment in course
        if one.obligation.name in moment.events
    )
    return not done and not open_still if one.obligation.negated else done
