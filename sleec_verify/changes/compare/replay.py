"""Replay of comparisons: the evaluator must confirm each shown situation on both sides."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import product

from sleec_runtime.evaluation.conflicts import has_conflict, mentioned
from sleec_runtime.evaluation.formula_truth import Situation, holds
from sleec_runtime.evaluation.hedge_chain import decide
from sleec_runtime.model import Context, Exclusive, Formula, Never, Obligation
from sleec_verify.changes.compare.alternatives import responses_in_situation
from sleec_verify.changes.compare.comparison import SIDES, Comparison, SideName, other, triggered_rules
from sleec_verify.changes.compare.measured_windows import in_context
from sleec_verify.changes.compare.result import DecidingClause
from sleec_verify.changes.compare.sides import Assumption
from sleec_verify.changes.compare.timing_order import implies


def deciding(comparison: Comparison, which: SideName, context: Context) -> tuple[DecidingClause, ...]:
    """The clauses that decide on one side according to the evaluator, in the order of its text."""
    stated = comparison.sides[which].stated

    def true(formula: Formula) -> bool:
        return holds(formula, context, stated.measures)

    found = []
    for rule in triggered_rules(comparison, which, context):
        decision = decide(rule, context, stated.reading, stated.measures)
        if decision is not None:
            span = list(rule.clauses())[decision.clause].span
            due = responses_in_situation(
                decision.obligations, stated.reading, comparison.untimed, lambda f: holds(f, context, stated.measures)
            )
            found.append(DecidingClause(rule.label, decision.clause, due, span))
    return tuple(sorted(found, key=lambda one: one.span))


def possible(comparison: Comparison, which: SideName, context: Context) -> bool:
    """Whether the situation satisfies the assumptions of the side."""
    stated = comparison.sides[which].stated
    fits = all(
        context.conditions[name] in values
        for name, values in comparison.sides[which].scales.items()
        if name in context.conditions
    )
    return fits and all(
        one.stated is None or holds(one.stated, context, stated.measures) for one in comparison.sides[which].given
    )


def conflicts(comparison: Comparison, which: SideName, context: Context, said: Iterable[DecidingClause]) -> bool:
    """Whether the immediate obligations of these clauses conflict."""
    literals = tuple(dict.fromkeys(o for one in said for o in one.obligations if o.timing is None))
    stated = comparison.sides[which].stated
    forbidding = [c for c in stated.constraints if isinstance(c, (Exclusive, Never))]
    return has_conflict(literals, forbidding, Situation(context, stated.measures))


def is_due(comparison: Comparison, context: Context, said: Iterable[DecidingClause], literal: Obligation) -> bool:
    """Whether one of these clauses obliges the literal in a situation, or one that requires at least as much."""
    wanted = in_context(literal, context.conditions)
    obligations = (in_context(o, context.conditions) for one in said for o in one.obligations)
    return any(implies(one, wanted, comparison.untimed) is True for one in obligations)


def shows_change(
    comparison: Comparison,
    context: Context,
    said: dict[SideName, tuple[DecidingClause, ...]],
    added: Sequence[Obligation],
    removed: Sequence[Obligation],
    in_conflicts: bool,
) -> bool:
    """Whether both sides allow the situation, and the due literals differ as claimed; and unless `in_conflicts`,
    whether neither side conflicts in it."""
    if not all(possible(comparison, which, context) for which in SIDES):
        return False
    if not in_conflicts and any(conflicts(comparison, which, context, said[which]) for which in SIDES):
        return False

    def due(which: SideName, literal: Obligation) -> bool:
        return is_due(comparison, context, said[which], literal)

    return all(due("new", o) and not due("old", o) for o in added) and all(
        due("old", o) and not due("new", o) for o in removed
    )


def excluded_on_one_side(
    comparison: Comparison, which: SideName, constraint: Exclusive | Never, names: Sequence[str], context: Context
) -> bool:
    """Whether both sides allow the situation, and some choice of the obligations `names` breaks the constraint of one
    side there, and none of the constraints of the other side about them."""
    if not all(possible(comparison, side, context) for side in SIDES):
        return False
    situation = Situation(context, comparison.sides[which].stated.measures)
    theirs = Situation(context, comparison.sides[other(which)].stated.measures)
    against = [
        one
        for one in comparison.sides[other(which)].stated.constraints
        if isinstance(one, (Exclusive, Never)) and mentioned(one) & set(names)
    ]
    choices = ([Obligation(name, not yes) for name, yes in zip(names, values)] for values in _choices(len(names)))
    return any(
        has_conflict(choice, [constraint], situation) and not has_conflict(choice, against, theirs)
        for choice in choices
    )


def _choices(number: int) -> Iterable[tuple[bool, ...]]:
    return product((False, True), repeat=number)


def satisfies(comparison: Comparison, which: SideName, given: Assumption, context: Context) -> bool:
    """Whether a situation satisfies an assumption of one side."""
    side = comparison.sides[which]
    formula = given.formula if given.stated is None else given.stated
    measures = comparison.measures if given.stated is None else side.stated.measures
    if any(context.conditions.get(name, of[0]) not in of for name, of in side.scales.items()):
        return False
    return holds(formula, context, measures)
