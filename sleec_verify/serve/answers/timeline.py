"""The timeline of the page: events that a user places, and the windows of obligations and prohibitions."""

from __future__ import annotations

from sleec_runtime.errors import WrongType
from sleec_runtime.model import Rule, Ruleset
from sleec_verify.checks.relevant_rules import relation_in_words
from sleec_verify.query.ruleset_index import RulesetIndex
from sleec_verify.replay.timeline import timeline_of
from sleec_verify.replay.trace_evaluator import RUNTIME, Instant, Requirement, Trace
from sleec_verify.results.json_values import Json
from sleec_verify.results.timeline import Due, Timeline
from sleec_verify.serve.answers.situation import context_of, scoped
from sleec_verify.serve.body import BadRequest, Body
from sleec_verify.serve.session import Session
from sleec_verify.traces.index import trace_index_of
from sleec_verify.traces.trace import TraceInstant
from sleec_verify.wording.phrases import quoted, shortened
from sleec_verify.wording.sentence import sentence
from sleec_verify.wording.times import duration

_MOST = 500
"""The events on a timeline, at most."""


def timeline(session: Session, body: Body) -> dict[str, Json]:
    """The windows of all responses, and the requirements that can no longer be met. The last event is now. Values of
    conditions last until they change."""
    whole = session.ruleset(body.text("text"))
    # The events are those of all domains.
    moments = _moments(whole, body.parts("events"))
    ruleset = scoped(whole, body)
    if not moments:
        return {"windows": [], "problems": []}
    trace = Trace(tuple(Instant(*moment) for moment in moments))
    try:
        broken = RUNTIME.violations_so_far(ruleset, trace, "at")
    except WrongType as error:
        problem = sentence("{measure} gives the length of a window, but has no value", measure=quoted(error.name))
        return {"windows": [], "problems": [problem]}
    found = timeline_of(trace_index_of(RulesetIndex(ruleset)), moments, len(moments) - 1)
    problems: list[Json] = [_broken(ruleset, one.statement, one.time) for one in broken]
    return {"windows": [_window(due, found) for due in _owed(found)], "problems": problems}


def _moments(ruleset: Ruleset, events: list[Body]) -> list[TraceInstant]:
    if len(events) > _MOST:
        raise BadRequest(f"a timeline has at most {_MOST} events")
    known = ruleset.triggers | ruleset.obligations
    moments: dict[int, TraceInstant] = {}
    for event in sorted(events, key=lambda one: one.number("time")):
        time = event.number("time")
        if not 0 <= time <= 10**9:
            raise BadRequest("the time of an event is a number of seconds from 0 on")
        names = {*event.texts("triggers"), *event.texts("executed")}
        unknown = sorted(names - known)
        if unknown:
            raise BadRequest(f"no event is called {quoted(shortened(unknown[0]))}")
        last = next(reversed(moments.values()), TraceInstant(0, frozenset(), {}))
        given = context_of(ruleset, (), event.values("conditions")).conditions
        now = moments.get(time)
        events_now = names | now.events if now is not None else names
        moments[time] = TraceInstant(time, frozenset(events_now), {**last.conditions, **given})
    return list(moments.values())


def _owed(found: Timeline) -> list[Due]:
    """What rules require, without alternatives whose time has not come."""
    now = found.moments[-1].time
    return [due for moment in found.moments for due in moment.due if not (due.overdue and due.start > now)]


def _window(due: Due, found: Timeline) -> Json:
    return {
        "obligation": due.event,
        "negated": due.negated,
        "from": due.start,
        "to": due.end,
        "rule": due.rule,
        "clause": due.clause,
        "state": _state(due, found),
        "instead_of": due.instead_of,
    }


def _state(due: Due, found: Timeline) -> str:
    happens = any(
        due.event in moment.events and due.start <= moment.time and (due.end is None or moment.time <= due.end)
        for moment in found.moments
    )
    is_over = due.end is not None and due.end < found.moments[-1].time
    if due.negated:
        return "broken" if happens else "fulfilled" if is_over else "open"
    return "fulfilled" if happens else "missed" if is_over else "open"


def _broken(ruleset: Ruleset, statement: Requirement, time: int) -> str:
    when = duration(time)
    if isinstance(statement, Rule):
        rule = quoted(statement.label)
        return sentence("rule {rule}, triggered after {time}, can no longer be followed", rule=rule, time=when)
    relation = relation_in_words(ruleset, statement)
    return sentence("after {time}, {relation} can no longer be followed", time=when, relation=relation)
