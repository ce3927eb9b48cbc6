"""Replay of findings about traces by the runtime's evaluator of traces, which shares no code with the encoding and
the solver."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from sleec_runtime.evaluation.hedge_chain import decide
from sleec_runtime.evaluation.trace import Instant, Trace
from sleec_runtime.evaluation.trace_violations import Requirement, claim_holds, violations, violations_so_far
from sleec_runtime.model import Context, Rule, Ruleset, claims
from sleec_verify.encoding.relations import events_of
from sleec_verify.query.ruleset_index import RulesetIndex
from sleec_verify.results.finding import Finding
from sleec_verify.results.timeline import Timeline
from sleec_verify.traces.index import trace_index_of
from sleec_verify.traces.relations import names_of_relation


def replay_trace(index: RulesetIndex, finding: Finding) -> bool:
    """Whether the evaluator confirms a finding: a trace in which a concern occurs, or a conflict after a lawful
    history in which the named clauses decide. That no response complies with them is a claim about all responses,
    which a replay cannot confirm."""
    if finding.check == "concern":
        return _claim_occurs(index, finding)
    assert finding.witness is not None, "only findings with a witness are replayed"
    moments = () if finding.timeline is None else as_trace(finding.timeline).instants
    now = moments[-1] if moments else Instant(0, frozenset(finding.witness.triggers), finding.witness.conditions)
    history = moments[:-1]
    for label, number in finding.clauses:
        rule = index.ruleset.by_label[label]
        # Rules that only the response triggers have no instant in the situation.
        speaking = [instant for instant in moments or (now,) if rule.trigger in instant.events]
        if speaking and not _decides(index, rule, number, speaking):
            return False
    before = Trace((*history, replace(now, events=frozenset())))
    violated = violations_so_far(_about(index, before), before, index.untimed)
    if any(one.time != now.time or _is_violated_by(now, one.statement) for one in violated):
        return False
    rules = [index.ruleset.by_label[label] for label in finding.rules]
    inputs = replace(_about(index, before), statements=tuple(rules))
    found = violations_so_far(inputs, Trace((*history, now)), index.untimed)
    return all(one.time == now.time for one in found)


def _is_violated_by(now: Instant, relation: Requirement) -> bool:
    """Whether a relation that appears to be violated now is violated. The events of now are open, and so are
    irrelevant conditions and measures."""
    assert not isinstance(relation, Rule), "no event triggers a rule"
    return not any(events_of(relation)) and any(name in now.conditions for _, name in names_of_relation(relation))


def _claim_occurs(index: RulesetIndex, finding: Finding) -> bool:
    assert finding.timeline is not None, "a concern occurs in a trace"
    trace = as_trace(finding.timeline)
    (claim,) = (c for c in claims(index.ruleset, "concern") if c.label == finding.obligations[0])
    ruleset = _about(index, trace)
    return not violations(ruleset, trace, index.untimed) and claim_holds(claim, ruleset, trace, index.untimed)


def _decides(index: RulesetIndex, rule: Rule, number: int, instants: Iterable[Instant]) -> bool:
    """Whether a clause of a rule decides at one of these instants."""
    contexts = (Context(instant.events, instant.conditions) for instant in instants)
    decisions = (decide(rule, context, index.ruleset.reading, index.ruleset.measures) for context in contexts)
    return any(decision is not None and decision.clause == number for decision in decisions)


def _about(index: RulesetIndex, trace: Trace) -> Ruleset:
    """The ruleset with only the rules and relations that the shown part of a trace can violate.

    The others hold in any case, or depend on conditions and measures that are irrelevant and not shown.
    """
    events = {event for instant in trace.instants for event in instant.events}
    shown = {("event", event) for event in events}
    shown |= {("measure", name) for instant in trace.instants for name in instant.conditions}
    relations = [one for one in trace_index_of(index).relations if not shown.isdisjoint(names_of_relation(one))]
    rules = (rule for event in sorted(events) for rule in trace_index_of(index).by_trigger.get(event, ()))
    measures = tuple(index.ruleset.measures.values())
    return replace(index.ruleset, statements=(*relations, *rules), inferred=measures)


def as_trace(timeline: Timeline) -> Trace:
    """The instants as values of the runtime."""
    return Trace(tuple(Instant(m.time, frozenset(m.events), m.conditions) for m in timeline.moments))
