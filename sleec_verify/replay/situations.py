"""Replay of situations: the runtime's evaluator, which shares no code with the encoding and the solver, must
confirm each witness before it is shown."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from sleec_runtime.evaluation.conflicts import has_conflict
from sleec_runtime.evaluation.formula_truth import Situation, holds
from sleec_runtime.evaluation.hedge_chain import Decision, decide
from sleec_runtime.model import READINGS, Context
from sleec_verify.query.ruleset_index import RulesetIndex
from sleec_verify.results.finding import Finding
from sleec_verify.traces.index import trace_index_of
from sleec_verify.traces.partition import partition_of


def replay_finding(index: RulesetIndex, finding: Finding) -> bool:
    """Whether the evaluator agrees. A finding without a witness has nothing to replay."""
    if finding.witness is None:
        return True
    if finding.check == "concern" or (
        finding.check == "conflict" and any(map(partition_of(index).needs_traces, finding.rules))
    ):
        from sleec_verify.replay.traces import replay_trace

        return replay_trace(index, finding)
    if finding.strategy is not None:
        from sleec_verify.replay.strategies import replay_strategy

        return replay_strategy(trace_index_of(index), finding)
    context = finding.witness.context()
    assumed = index.assumptions_that_may_break(context)
    possible = all(holds(assumption.formula, context, index.ruleset.measures) for assumption in assumed)
    return possible and _CLAIMS[finding.check](index, finding, context)


def _decisions(index: RulesetIndex, finding: Finding, context: Context) -> dict[str, Decision]:
    """The clauses that decide the rules of the finding. Obligations of other rules do not remove a conflict."""
    ruleset = index.ruleset
    found = (decide(ruleset.by_label[label], context, ruleset.reading, ruleset.measures) for label in finding.rules)
    return {decision.rule.label: decision for decision in found if decision is not None}


def _conflicts(index: RulesetIndex, finding: Finding, context: Context) -> bool:
    decisions = _decisions(index, finding, context)
    decide_so = all(label in decisions and decisions[label].clause == number for label, number in finding.clauses)
    return decide_so and _has_conflict(index, finding, context, decisions)


def _vacuous(index: RulesetIndex, finding: Finding, context: Context) -> bool:
    decisions = _decisions(index, finding, context)
    return finding.rules[0] in decisions and _has_conflict(index, finding, context, decisions)


def _has_conflict(index: RulesetIndex, finding: Finding, context: Context, decisions: Mapping[str, Decision]) -> bool:
    """Whether the obligations of these decisions conflict, under the constraints that can affect them."""
    literals = tuple(dict.fromkeys(literal for one in decisions.values() for literal in one.obligations))
    # Constraints can be violated without obligations, if a NEVER and another one allow nothing.
    names = {literal.name for literal in literals}.union(finding.obligations)
    constraints = index.constraints_about(names) if finding.clauses else index.constraints
    return has_conflict(literals, constraints, Situation(context, index.ruleset.measures))


def _readings_part(index: RulesetIndex, finding: Finding, context: Context) -> bool:
    rule = index.ruleset.by_label[finding.rules[0]]
    decisions = [decide(rule, context, reading, index.ruleset.measures) for reading in READINGS]
    due = [set(decision.obligations) for decision in decisions if decision is not None]
    return len(due) == len(READINGS) and due[0] != due[1]


_CLAIMS: Mapping[str, Callable[[RulesetIndex, Finding, Context], bool]] = {
    "conflict": _conflicts,
    "vacuous-conflict": _vacuous,
    "reading": _readings_part,
}
