"""Every witness is replayed before anyone sees it: the runtime's evaluator, which shares nothing with the compiler
and the solver, must find in the situation what the finding says of it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace

from sleec_runtime.conflicts import forbidding, has_conflict
from sleec_runtime.evaluation import Situation, decide, due, holds
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
    return possible and _CLAIMS[finding.check](_about(cones, finding), finding, context)


def _about(cones: Cones, finding: Finding) -> Ruleset:
    """The ruleset with only the rules of the finding, the constraints that can concern what they oblige, and the
    measures of both. What other rules oblige as well takes no conflict away."""
    rules = [cones.ruleset.by_label[label] for label in finding.rules]
    obliged = {o.name for rule in rules for clause in rule.clauses() for o in clause.obligations}
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
    return _has_conflict(ruleset, context)


def _vacuous(ruleset: Ruleset, finding: Finding, context: Context) -> bool:
    rule = ruleset.by_label[finding.rules[0]]
    return decide(rule, context, ruleset.reading, ruleset.measures) is not None and _has_conflict(ruleset, context)


def _has_conflict(ruleset: Ruleset, context: Context) -> bool:
    literals = due(ruleset, context).literals
    return has_conflict(literals, forbidding(ruleset), Situation(context, ruleset.measures))


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
