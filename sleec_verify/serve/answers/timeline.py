"""The timeline of the page: events that a user places, and the windows of obligations and prohibitions."""

from __future__ import annotations

from collections.abc import Collection, Sequence

from sleec_runtime.errors import WrongType
from sleec_runtime.model import Rule, Ruleset
from sleec_verify.checks.relevant_rules import relation_in_words
from sleec_verify.encoding.solver import Undecided
from sleec_verify.entailment.continuation import blocked_rules
from sleec_verify.query.ruleset_index import RulesetIndex
from sleec_verify.replay.timeline import timeline_of
from sleec_verify.replay.trace_evaluator import RUNTIME, Instant, Requirement, Trace
from sleec_verify.results.json_values import Json
from sleec_verify.results.timeline import Due, Timeline
from sleec_verify.serve.answers.situation import context_of, scoped
from sleec_verify.serve.body import BadRequest, Body
from sleec_verify.serve.session import Session
from sleec_verify.traces.index import trace_index_of
from sleec_verify.traces.relations import names_of_relation
from sleec_verify.traces.trace import TraceInstant
from sleec_verify.wording.phrases import listed, quoted, shortened
from sleec_verify.wording.sentence import sentence
from sleec_verify.wording.times import duration

_MOST = 500
"""The events on a timeline, at most."""


def timeline(session: Session, body: Body) -> dict[str, Json]:
    """The windows of all responses, the requirements that can no longer be met, and from when on it is impossible to
    follow every rule. The last event is now. Values of conditions last until they change."""
    whole = session.ruleset(body.text("text"))
    # The events are those of all domains.
    moments = _moments(whole, body.parts("events"))
    ruleset = scoped(whole, body)
    if not moments:
        return {"windows": [], "problems": [], "impossible": None}
    trace = Trace(tuple(Instant(*moment) for moment in moments))
    try:
        broken = RUNTIME.violations_so_far(ruleset, trace, "at")
    except WrongType as error:
        problem = sentence("{measure} gives the length of a window, but has no value", measure=quoted(error.name))
        return {"windows": [], "problems": [problem], "impossible": None}
    found = timeline_of(trace_index_of(RulesetIndex(ruleset)), moments, len(moments) - 1)
    # A relation says nothing about a condition or measure whose value is not given.
    known = set(moments[-1].conditions).intersection(*(moment.conditions for moment in moments))
    told = [one for one in broken if isinstance(one.statement, Rule) or _is_about(one.statement, known)]
    problems: list[Json] = [_broken(ruleset, one.statement, one.time) for one in told]
    blocked: tuple[str, ...] = ()
    try:
        missed = {one.statement.label for one in broken if isinstance(one.statement, Rule)}
        blocked = blocked_rules(ruleset, moments, missed)
    except Undecided as error:
        problems.append(
            sentence("it is not known whether every rule can be followed from now on: {reason}", reason=error.message)
        )
    return {
        "windows": [_window(due, found, blocked) for due in _owed(found)],
        "problems": [*([_impossible(moments, blocked)] if blocked else []), *problems],
        "impossible": moments[-1].time if blocked else None,
    }


def _is_about(relation: Requirement, known: Collection[str]) -> bool:
    """Whether all conditions and measures of a relation are known."""
    assert not isinstance(relation, Rule), "asked of relations"
    return all(kind == "event" or name in known for kind, name in names_of_relation(relation))


def _impossible(moments: Sequence[TraceInstant], blocked: Sequence[str]) -> str:
    """From when on no rule can be followed, as the report says it, and which rules these are."""
    now = moments[-1].time
    when = (
        sentence("from the first moment on, it is impossible to follow every rule")
        if now == 0
        else sentence("after {time}, it is impossible to follow every rule", time=duration(now))
    )
    return sentence("{impossible}: {rules}", impossible=when, rules=listed(map(quoted, blocked)))


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


def _window(due: Due, found: Timeline, blocked: Collection[str]) -> Json:
    return {
        "obligation": due.event,
        "negated": due.negated,
        "from": due.start,
        "to": due.end,
        "rule": due.rule,
        "clause": due.clause,
        "state": _state(due, found, blocked),
        "instead_of": due.instead_of,
    }


def _state(due: Due, found: Timeline, blocked: Collection[str]) -> str:
    """`impossible`: it is open, and cannot be followed together with the other windows of this state."""
    happens = any(
        due.event in moment.events and due.start <= moment.time and (due.end is None or moment.time <= due.end)
        for moment in found.moments
    )
    is_over = due.end is not None and due.end < found.moments[-1].time
    open_state = "impossible" if due.rule in blocked else "open"
    if due.negated:
        return "broken" if happens else "fulfilled" if is_over else open_state
    return "fulfilled" if happens else "missed" if is_over else open_state


def _broken(ruleset: Ruleset, statement: Requirement, time: int) -> str:
    when = duration(time)
    if isinstance(statement, Rule):
        rule = quoted(statement.label)
        return sentence("rule {rule}, triggered after {time}, can no longer be followed", rule=rule, time=when)
    relation = relation_in_words(ruleset, statement)
    return sentence("after {time}, {relation} can no longer be followed", time=when, relation=relation)
