"""Relations and constraints: the events and formulas that they mention, and their meaning at one instant.

Here a relation is any statement of a ruleset that binds every trace in addition to the rules: `Relation`, `Exclusive`,
`Never` and `Assume`.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations
from typing import Union

from sleec_runtime.model import (
    And,
    Assume,
    Atom,
    Effect,
    EventRelation,
    Exclusive,
    Formula,
    Lasting,
    MeasureRelation,
    Never,
    Not,
    Or,
    Ruleset,
    leaves,
)
from sleec_runtime.model import Relation as TimedRelation

Relation = Union[TimedRelation, Exclusive, Never, Assume]


def events_of(relation: Relation) -> Iterator[str]:
    """The events that a relation mentions."""
    if isinstance(relation, EventRelation):
        yield relation.left
        yield relation.right
    elif isinstance(relation, Effect):
        yield relation.event
    elif isinstance(relation, Lasting):
        yield relation.event
        if relation.end is not None:
            yield relation.end
    elif isinstance(relation, Exclusive):
        yield from relation.names
    elif isinstance(relation, (Never, Assume)):
        yield from (a.name for a in leaves(relation.formula) if isinstance(a, Atom) and a.kind != "condition")


def formulas_of_relation(relation: Relation) -> Iterator[Formula]:
    """The formulas of a relation over conditions and measures."""
    if isinstance(relation, MeasureRelation):
        candidates: tuple[Formula | None, ...] = (relation.left, relation.right)
    elif isinstance(relation, Lasting):
        candidates = (relation.condition, relation.formula, relation.end_condition)
    elif isinstance(relation, (Effect, Never, Assume)):
        candidates = (relation.formula,)
    else:
        candidates = ()
    yield from (formula for formula in candidates if formula is not None)


def at_one_instant(relation: Relation) -> Iterator[tuple[Formula, ...]]:
    """The meaning of a relation at each single instant, as disjunctions of which all hold.

    There are none for `happenBefore` and `when ... until`, which relate several instants. An atom of kind ``trigger``
    or ``obligation`` is the occurrence of the event of that name.
    """
    if isinstance(relation, EventRelation):
        left, right = _event(relation.left), _event(relation.right)
        if relation.relation == "mutualExclusive":
            yield Not(left), Not(right)
        elif relation.relation != "happenBefore":
            yield Not(left), right
            if relation.relation == "equal":
                yield Not(right), left
    elif isinstance(relation, MeasureRelation):
        if relation.right is None:
            yield (relation.left,)
        elif relation.relation in ("imply", "iff"):
            yield Not(relation.left), relation.right
            if relation.relation == "iff":
                yield relation.left, Not(relation.right)
        else:
            yield Not(relation.left), Not(relation.right)
    elif isinstance(relation, Effect):
        if relation.relation == "causation":
            yield Not(relation.formula), _event(relation.event)
        else:
            held = relation.formula if relation.relation == "includes" else Not(relation.formula)
            yield Not(_event(relation.event)), held
    elif isinstance(relation, Exclusive):
        for one, other in exclusions(relation):
            yield Not(_event(one)), Not(_event(other))
    elif isinstance(relation, (Assume, Never)):
        yield (relation.formula if isinstance(relation, Assume) else Not(relation.formula),)


def formula_at_one_instant(relation: Relation) -> Formula:
    """The meaning of a relation at one instant as one formula."""
    parts = [part[0] if len(part) == 1 else Or(part) for part in at_one_instant(relation)]
    return parts[0] if len(parts) == 1 else And(tuple(parts))


def relations_on_situations(ruleset: Ruleset) -> Iterator[tuple[TimedRelation, Formula]]:
    """The relations that exclude situations for all events before and after, each with a formula that is false in
    them."""
    for relation in ruleset.statements:
        is_exclusion = isinstance(relation, EventRelation) and relation.relation == "mutualExclusive"
        is_effect = isinstance(relation, Effect) and relation.relation != "causation"
        if isinstance(relation, MeasureRelation) or is_exclusion or is_effect:
            assert isinstance(relation, (EventRelation, Effect, MeasureRelation)), "no other statement is kept"
            yield relation, formula_at_one_instant(relation)


def exclusions(relation: Relation) -> Iterator[tuple[str, str]]:
    """The pairs of events that a relation excludes from one instant, whatever else holds there."""
    if isinstance(relation, EventRelation) and relation.relation == "mutualExclusive":
        yield relation.left, relation.right
    elif isinstance(relation, Exclusive):
        yield from combinations(dict.fromkeys(relation.names), 2)


def _event(name: str) -> Atom:
    return Atom("trigger", name)
