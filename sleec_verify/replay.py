"""Every witness is replayed before anyone sees it: the runtime's evaluator, which shares nothing with the compiler
and the solver, must find in the situation what the finding says of it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace

from sleec_runtime.conflicts import conflict
from sleec_runtime.evaluation import broken_assumptions, decide
from sleec_runtime.model import READINGS, Context, Rule, Ruleset
from sleec_verify.cone import Cones
from sleec_verify.finding import Finding


def replays(cones: Cones, finding: Finding) -> bool:
    """Whether the evaluator agrees. A finding without a witness has nothing to replay."""
    if finding.witness is None:
        return True
    context = finding.witness.context()
    possible = not broken_assumptions(cones.ruleset, context)
    return possible and _CLAIMS[finding.check](_triggered(cones, context), finding, context)


def _triggered(cones: Cones, context: Context) -> Ruleset:
    """The ruleset with only the rules that the context triggers; the others oblige nothing there."""
    rules = {position for trigger in context.triggers for position in cones.by_trigger.get(trigger, ())}
    kept = (*cones.ruleset.constraints, *cones.ruleset.measures.values(), *(cones.rules[p] for p in sorted(rules)))
    return replace(cones.ruleset, statements=kept, inferred=())


def _conflicts(ruleset: Ruleset, finding: Finding, context: Context) -> bool:
    for label, number in finding.clauses:
        decision = decide(ruleset.by_label[label], context, ruleset.reading, ruleset.measures)
        if decision is None or decision.clause != number:
            return False
    return conflict(ruleset, context) is not None


def _vacuous(ruleset: Ruleset, finding: Finding, context: Context) -> bool:
    rule = ruleset.by_label[finding.rules[0]]
    return (
        decide(rule, context, ruleset.reading, ruleset.measures) is not None and conflict(ruleset, context) is not None
    )


def _readings_part(ruleset: Ruleset, finding: Finding, context: Context) -> bool:
    rule: Rule = ruleset.by_label[finding.rules[0]]
    decisions = [decide(rule, context, reading, ruleset.measures) for reading in READINGS]
    due = [set(decision.obligations) for decision in decisions if decision is not None]
    return len(due) == len(READINGS) and due[0] != due[1]


_CLAIMS: Mapping[str, Callable[[Ruleset, Finding, Context], bool]] = {
    "conflict": _conflicts,
    "vacuous-conflict": _vacuous,
    "reading": _readings_part,
}
