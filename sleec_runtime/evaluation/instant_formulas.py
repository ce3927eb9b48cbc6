"""Constraints and relations as formulas that hold at every instant (docs/dsl.md)."""

from __future__ import annotations

from itertools import combinations

from sleec_runtime.model import (
    And,
    Assume,
    Atom,
    Constraint,
    Effect,
    EventRelation,
    Exclusive,
    Formula,
    MeasureRelation,
    Never,
    Not,
    Or,
)


def instant_formula(statement: Constraint | EventRelation | MeasureRelation | Effect) -> Formula:
    """The formula that `statement` requires at each instant."""
    if isinstance(statement, Exclusive):
        pairs = [_not_both(occurrence(a), occurrence(b)) for a, b in combinations(statement.names, 2)]
        return And(tuple(pairs))
    if isinstance(statement, Never):
        return Not(statement.formula)
    if isinstance(statement, Assume):
        return statement.formula
    if isinstance(statement, EventRelation):
        left, right = occurrence(statement.left), occurrence(statement.right)
        if statement.relation == "witness":
            return _if(left, right)
        return _iff(left, right) if statement.relation == "equal" else _not_both(left, right)
    if isinstance(statement, Effect):
        event = occurrence(statement.event)
        if statement.relation == "causation":
            return _if(statement.formula, event)
        return (
            _if(event, statement.formula) if statement.relation == "includes" else _not_both(event, statement.formula)
        )
    if statement.right is None:
        return statement.left
    if statement.relation == "imply":
        return _if(statement.left, statement.right)
    # "opposite" is no more than "not both" in the published tools.
    return (
        _iff(statement.left, statement.right)
        if statement.relation == "iff"
        else _not_both(statement.left, statement.right)
    )


def occurrence(event: str) -> Formula:
    """The formula that `event` occurs."""
    return Atom("trigger", event)


def conjunction(left: Formula, right: Formula | None) -> Formula:
    """The conjunction; `left` if there is no `right`."""
    return left if right is None else And((left, right))


def _if(left: Formula, right: Formula) -> Formula:
    return Or((Not(left), right))


def _iff(left: Formula, right: Formula) -> Formula:
    return And((_if(left, right), _if(right, left)))


def _not_both(left: Formula, right: Formula) -> Formula:
    return Not(And((left, right)))
