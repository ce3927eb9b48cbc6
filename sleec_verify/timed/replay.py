"""Timelines are replayed before anyone sees them, by the runtime's evaluator of traces, which shares nothing with the
encoding and the solver."""

from __future__ import annotations

from dataclasses import replace

from sleec_runtime.evaluation import decide
from sleec_runtime.model import Context, Ruleset
from sleec_runtime.model_time import claims
from sleec_runtime.trace import Instant, Trace, broken, broken_so_far, claim_holds
from sleec_verify.finding import Finding
from sleec_verify.timed.timeline import Timeline
from sleec_verify.timed.traces import Traces


def plays(known: Traces, finding: Finding) -> bool:
    """Whether the evaluator finds of the timeline what the finding says of it: that it is a trace in which the concern
    comes about, or a history that breaks nothing so far and triggers the rule now. That the history cannot be continued
    is a claim about all continuations, which no replay can show."""
    assert finding.timeline is not None, "only timelines are replayed here"
    trace = as_trace(finding.timeline)
    ruleset = _about(known, trace)
    if finding.timeline.now is None:
        (claim,) = (c for c in claims(known.ruleset, "concern") if c.label == finding.obligations[0])
        return not broken(ruleset, trace, known.untimed) and claim_holds(claim, ruleset, trace, known.untimed)
    now = trace.instants[-1]
    rule = known.ruleset.by_label[finding.rules[0]]
    context = Context(now.events, now.conditions)
    triggered = decide(rule, context, known.ruleset.reading, known.ruleset.measures) is not None
    # That the rule contradicts itself is a conflict, as it would be if it were two rules.
    return triggered and not broken_so_far(ruleset, trace, known.untimed, apart=rule)


def _about(known: Traces, trace: Trace) -> Ruleset:
    """The ruleset with only the rules that some event of the trace triggers, as the others are kept anyway."""
    events = {event for instant in trace.instants for event in instant.events}
    rules = (rule for event in sorted(events) for rule in known.program.by_trigger.get(event, ()))
    measures = tuple(known.ruleset.measures.values())
    return replace(known.ruleset, statements=(*known.program.laws, *rules), inferred=measures)


def as_trace(timeline: Timeline) -> Trace:
    """The moments as the runtime takes them."""
    return Trace(tuple(Instant(m.time, frozenset(m.events), m.conditions) for m in timeline.moments))
