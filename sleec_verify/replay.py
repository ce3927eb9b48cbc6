"""Every witness is replayed before anyone sees it: the runtime's evaluator, which shares nothing with the compiler
and the solver, must find in the situation what the finding says of it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace

from sleec_runtime.conflicts import conflict
from sleec_runtime.evaluation import decide, holds
from sleec_runtime.model import READINGS, Context, Never, Rule, Ruleset
from sleec_verify.cone import Cones, names_in, names_of_rule
from sleec_verify.finding import Finding


def replays(cones: Cones, finding: Finding) -> bool:
    """Whether the evaluator agrees. A finding without a witness has nothing to replay."""
    if finding.witness is None:
        return True
    if finding.timeline is not None:
        from sleec_verify.timed.replay import plays
        from sleec_verify.timed.traces import Traces

        assert isinstance(cones, Traces), "only the checks of traces make timelines"
        return plays(cones, finding)
    if finding.strategy is not None:
        from sleec_verify.games.replay import plays as is_lawful

        return is_lawful(cones.program, finding)
    context = finding.witness.context()
    assumed = cones.assumptions_that_may_break(context)
    possible = all(holds(assumption.formula, context, cones.ruleset.measures) for assumption in assumed)
    return possible and _CLAIMS[finding.check](_about(cones, finding, context), finding, context)


def _about(cones: Cones, finding: Finding, context: Context) -> Ruleset:
    """The ruleset with only the rules that the context triggers, as the others oblige nothing there, the constraints
    that can concern what they oblige, and the measures of both."""
    positions = {position for trigger in context.triggers for position in cones.by_trigger.get(trigger, ())}
    rules = [cones.rules[position] for position in sorted(positions)]
    obliged = {o.name for p in positions for clause in cones.clauses[p] for o in clause.obligations}
    # Constraints can break by themselves where a NEVER and another leave nothing to do.
    alone = not finding.clauses
    constraints = cones.constraints if alone else cones.constraints_about({*obliged, *finding.obligations})
    named = {name for rule in rules for _, name in names_of_rule(rule)}
    named.update(n for c in constraints if isinstance(c, Never) for _, n in names_in(c.formula))
    measures = cones.ruleset.measures
    kept = tuple(measures[name] for name in sorted(named) if name in measures)
    return replace(cones.ruleset, statements=(*constraints, *rules), inferred=kept)


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
