"""Findings about traces are replayed before anyone sees them, by the runtime's evaluator of traces.

It shares nothing with the encoding and the solver."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from sleec_runtime.evaluation.evaluation import decide
from sleec_runtime.evaluation.traces import Instant, Lawlike, Trace, broken, broken_so_far, claim_holds
from sleec_runtime.model import Context, Rule, Ruleset, claims
from sleec_verify.query.cone import Cones
from sleec_verify.results.finding import Finding
from sleec_verify.results.timeline import Timeline
from sleec_verify.traces.relations import events_of, names_of_relation


def replays(cones: Cones, finding: Finding) -> bool:
    """Whether the evaluator finds what a finding claims: a trace in which a concern comes about, or a conflict after a
    lawful history in which the named clauses decide. That no response complies with them is a claim about all
    responses, which no replay can show."""
    if finding.check == "concern":
        return _comes_about(cones, finding)
    assert finding.witness is not None, "only findings with a witness are replayed"
    moments = () if finding.timeline is None else as_trace(finding.timeline).instants
    now = moments[-1] if moments else Instant(0, frozenset(finding.witness.triggers), finding.witness.conditions)
    history = moments[:-1]
    for label, number in finding.clauses:
        rule = cones.ruleset.by_label[label]
        # What the response itself triggers has no instant in the situation.
        speaking = [instant for instant in moments or (now,) if rule.trigger in instant.events]
        if speaking and not _decides(cones, rule, number, speaking):
            return False
    before = Trace((*history, replace(now, events=frozenset())))
    violated = broken_so_far(_about(cones, before), before, cones.untimed)
    if any(one.time != now.time or _is_violated_by(now, one.statement) for one in violated):
        return False
    rules = [cones.ruleset.by_label[label] for label in finding.rules]
    inputs = replace(_about(cones, before), statements=tuple(rules))
    found = broken_so_far(inputs, Trace((*history, now)), cones.untimed)
    return all(one.time == now.time for one in found)


def _is_violated_by(now: Instant, relation: Lawlike) -> bool:
    """Whether a relation that seems to be violated now is. Which events occur now is open, and so are conditions and
    measures that do not matter."""
    assert not isinstance(relation, Rule), "no event triggers a rule"
    return not any(events_of(relation)) and any(name in now.conditions for _, name in names_of_relation(relation))


def _comes_about(cones: Cones, finding: Finding) -> bool:
    assert finding.timeline is not None, "a concern comes about in a trace"
    trace = as_trace(finding.timeline)
    (claim,) = (c for c in claims(cones.ruleset, "concern") if c.label == finding.obligations[0])
    ruleset = _about(cones, trace)
    return not broken(ruleset, trace, cones.untimed) and claim_holds(claim, ruleset, trace, cones.untimed)


def _decides(cones: Cones, rule: Rule, number: int, instants: Iterable[Instant]) -> bool:
    """Whether a clause of a rule decides at one of these instants."""
    contexts = (Context(instant.events, instant.conditions) for instant in instants)
    decisions = (decide(rule, context, cones.ruleset.reading, cones.ruleset.measures) for context in contexts)
    return any(decision is not None and decision.clause == number for decision in decisions)


def _about(cones: Cones, trace: Trace) -> Ruleset:
    """The ruleset with only the rules and relations that what a trace shows can violate.

    The others hold anyway, or by conditions and measures that do not matter and are not shown."""
    events = {event for instant in trace.instants for event in instant.events}
    shown = {("event", event) for event in events}
    shown |= {("measure", name) for instant in trace.instants for name in instant.conditions}
    relations = [one for one in cones.index.relations if not shown.isdisjoint(names_of_relation(one))]
    rules = (rule for event in sorted(events) for rule in cones.index.by_trigger.get(event, ()))
    measures = tuple(cones.ruleset.measures.values())
    return replace(cones.ruleset, statements=(*relations, *rules), inferred=measures)


def as_trace(timeline: Timeline) -> Trace:
    """The moments as the runtime takes them."""
    return Trace(tuple(Instant(m.time, frozenset(m.events), m.conditions) for m in timeline.moments))
