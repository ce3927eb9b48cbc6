"""Replay of traces by an evaluator that shares no code with the encoding and the solver: that of the runtime, or the
one that is extracted from the theory in Coq."""

from __future__ import annotations

from collections.abc import Collection, Iterable
from dataclasses import replace
from itertools import chain, combinations

from sleec_runtime.evaluation.trace import Instant, Trace
from sleec_runtime.evaluation.trace_violations import Requirement
from sleec_runtime.model import CLAIM_KINDS, Claim, ClaimKind, Rule, Ruleset, claims
from sleec_verify.encoding.relations import events_of
from sleec_verify.encoding.trace_scope import named_atoms
from sleec_verify.query.ruleset_index import RulesetIndex
from sleec_verify.replay.trace_evaluator import RUNTIME, TraceEvaluator
from sleec_verify.results.conflict_freedom import Example
from sleec_verify.results.finding import Finding
from sleec_verify.results.found_trace import FoundTrace
from sleec_verify.results.timeline import Timeline
from sleec_verify.traces.index import trace_index_of
from sleec_verify.traces.relations import names_of_relation


def replay_trace(index: RulesetIndex, finding: Finding) -> bool:
    """Whether the evaluator of the runtime confirms a finding: a trace in which a concern occurs, or a conflict after a
    lawful history in which the named clauses decide. That no response complies with them is a claim about all
    responses, which a replay cannot confirm."""
    assert finding.witness is not None, "only findings with a witness are replayed"
    if finding.check == "concern":
        assert finding.timeline is not None, "a concern occurs in a trace"
        return _occurs(index, "concern", finding.obligations[0], as_trace(finding.timeline), RUNTIME)
    now = Instant(0, frozenset(finding.witness.triggers), finding.witness.conditions)
    trace = Trace((now,)) if finding.timeline is None else as_trace(finding.timeline)
    return _is_situation(index, finding.rules, finding.clauses, trace, RUNTIME)


def replay_found(index: RulesetIndex, found: FoundTrace, evaluator: TraceEvaluator = RUNTIME) -> bool:
    """Whether an evaluator confirms what a trace shows (`FoundTrace.shows`). `index` is that of its ruleset."""
    trace = Trace(tuple(Instant(*instant) for instant in found.instants))
    if found.now is not None:
        clauses = [(label, clause) for label, clause in found.about if clause is not None and clause >= 0]
        *before, now = trace.instants[: found.now + 1]
        if not found.inputs <= now.events:
            return False
        history = Trace((*before, replace(now, events=found.inputs)))
        if not _is_situation(index, {label for label, _ in found.about}, clauses, history, evaluator):
            return False
        return found.shows == "conflict" or _complies(index, found.rules, trace, evaluator)
    label, number = found.about[0]
    if found.shows in CLAIM_KINDS:
        return _occurs(index, found.shows, label, trace, evaluator)
    rule = index.ruleset.by_label[label]
    part = _about(index, trace)
    if found.shows == "decision":
        assert number is not None, "a clause decides"
        return not _broken(index, _with(part, ()), trace, evaluator) and evaluator.decides(rule, number, part, trace)
    broken = _broken(index, part, trace, evaluator)
    if found.shows == "trigger":
        triggered = Claim("concern", label, "exists", rule.trigger, rule.guard)
        return not broken and evaluator.claim_holds(triggered, part, trace, index.untimed)
    if found.changed is None:
        return broken == {label}
    without = _with(part, (found.changed if one is rule else one for one in part.rules))
    broken_without = _broken(index, without, trace, evaluator)
    found_both = (broken, broken_without) if found.shows == "violation-with-hedge" else (broken_without, broken)
    return found_both == ({label}, set())


def replay_example(index: RulesetIndex, example: Example, evaluator: TraceEvaluator = RUNTIME) -> bool:
    """Whether an evaluator confirms that the continuation of a template complies with the rules of an example: the
    whole trace violates neither these rules nor a relation."""
    return _complies(index, example.rules, Trace(tuple(Instant(*instant) for instant in example.instants)), evaluator)


def _complies(index: RulesetIndex, rules: Iterable[Rule], trace: Trace, evaluator: TraceEvaluator) -> bool:
    """Whether a trace violates neither these rules nor a relation."""
    return not evaluator.violations(_with(_about(index, trace), rules), trace, index.untimed)


def _broken(index: RulesetIndex, ruleset: Ruleset, trace: Trace, evaluator: TraceEvaluator) -> set[str]:
    """The labels of the rules that a trace violates, with an empty one for relations and constraints."""
    found = evaluator.violations(ruleset, trace, index.untimed)
    return {one.statement.label if isinstance(one.statement, Rule) else "" for one in found}


def _is_situation(
    index: RulesetIndex,
    labels: Collection[str],
    clauses: Iterable[tuple[str, int]],
    trace: Trace,
    evaluator: TraceEvaluator,
) -> bool:
    """Whether the last instant of a trace is a situation for some rules after a lawful history: it triggers one of
    them, and the given clauses decide."""
    *history, now = trace.instants
    rules = [rule for rule in index.rules if rule.label in labels]
    if not any(rule.trigger in now.events for rule in rules):
        return False
    occurred = {event for instant in trace.instants for event in instant.events}
    # Rules that only the response triggers have no instant in the situation.
    if any(rule.trigger not in occurred and rule.trigger in trace_index_of(index).mere_inputs for rule in rules):
        return False
    for label, number in clauses:
        rule = index.ruleset.by_label[label]
        if rule.trigger in occurred and not _can_decide(index, rule, number, trace, evaluator):
            return False
    before = Trace((*history, replace(now, events=frozenset())))
    about = _about(index, before)
    violated = evaluator.violations_so_far(about, before, index.untimed)
    if any(one.time != now.time or _is_violated_by(now, one.statement) for one in violated):
        return False
    found = evaluator.violations_so_far(replace(about, statements=tuple(rules)), trace, index.untimed)
    return all(one.time == now.time for one in found)


def _can_decide(index: RulesetIndex, rule: Rule, number: int, trace: Trace, evaluator: TraceEvaluator) -> bool:
    """Whether a clause decides at some instant, with some of the acts of now that trigger its rule or are named by its
    conditions. That it does so in every response that complies with the other rules is a claim about all responses."""
    *history, now = trace.instants
    acts = sorted({rule.trigger, *named_atoms(rule)} - trace_index_of(index).mere_inputs - now.events)
    some = chain.from_iterable(combinations(acts, size) for size in range(len(acts) + 1))
    return any(
        evaluator.decides(rule, number, index.ruleset, Trace((*history, replace(now, events=now.events.union(one)))))
        for one in some
    )


def _is_violated_by(now: Instant, relation: Requirement) -> bool:
    """Whether a relation that appears to be violated now is violated. The events of now are open, and so are
    irrelevant conditions and measures."""
    assert not isinstance(relation, Rule), "no event triggers a rule"
    return not any(events_of(relation)) and any(name in now.conditions for _, name in names_of_relation(relation))


def _occurs(index: RulesetIndex, kind: ClaimKind, label: str, trace: Trace, evaluator: TraceEvaluator) -> bool:
    """Whether a trace violates nothing, and a concern or purpose occurs in it."""
    (claim,) = (c for c in claims(index.ruleset, kind) if c.label == label)
    ruleset = _about(index, trace)
    return not evaluator.violations(ruleset, trace, index.untimed) and evaluator.claim_holds(
        claim, ruleset, trace, index.untimed
    )


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


def _with(ruleset: Ruleset, rules: Iterable[Rule]) -> Ruleset:
    """The ruleset with other rules."""
    relations = (one for one in ruleset.statements if not isinstance(one, Rule))
    return replace(ruleset, statements=(*relations, *rules), inferred=tuple(ruleset.measures.values()))


def as_trace(timeline: Timeline) -> Trace:
    """The instants as values of the runtime."""
    return Trace(tuple(Instant(m.time, frozenset(m.events), m.conditions) for m in timeline.moments))
