"""A ruleset as far as it does not speak of time."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from sleec_runtime.model import (
    RELATIONS,
    And,
    Atom,
    Claim,
    Clause,
    Effect,
    EventRelation,
    Formula,
    MeasureRelation,
    Not,
    Or,
    Relation,
    Rule,
    Ruleset,
)


def untimed(ruleset: Ruleset) -> Ruleset:
    """`ruleset` without what speaks of time: responses with times, concerns, purposes, relations."""
    return replace(
        ruleset,
        statements=tuple(
            replace(s, default=_untimed(s.default), hedges=tuple(map(_untimed, s.hedges))) if isinstance(s, Rule) else s
            for s in ruleset.statements
            if not isinstance(s, (Claim, *RELATIONS))
        ),
    )


def of_one_instant(ruleset: Ruleset) -> Iterator[tuple[Relation, Formula]]:
    """The relations that rule out situations, each with what is false in those: whatever else occurs there, and before
    and after."""
    for law in ruleset.statements:
        if isinstance(law, EventRelation) and law.relation == "mutualExclusive":
            yield law, Not(And((Atom("trigger", law.left), Atom("trigger", law.right))))
        elif isinstance(law, Effect) and law.relation != "causation":
            must = law.formula if law.relation == "includes" else Not(law.formula)
            yield law, Or((Not(Atom("trigger", law.event)), must))
        elif isinstance(law, MeasureRelation):
            yield law, at_every_instant(law)


def at_every_instant(law: MeasureRelation) -> Formula:
    if law.right is None:
        return law.left
    if law.relation == "imply":
        return Or((Not(law.left), law.right))
    both = And((law.left, law.right))
    if law.relation == "iff":
        return Or((both, And((Not(law.left), Not(law.right)))))
    return Not(both)


def _untimed(clause: Clause) -> Clause:
    return replace(
        clause,
        obligations=tuple(o for o in clause.obligations if o.timing is None),
        hedges=tuple(map(_untimed, clause.hedges)),
    )
