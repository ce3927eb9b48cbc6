"""Relations and constraints: the events and measures that they mention, and what they demand of one instant.

Here a relation is any statement of a ruleset that binds every trace besides the rules: `Relation`, `Exclusive`,
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
    Truth,
    leaves,
    measures_of,
)
from sleec_runtime.model import Relation as TimedRelation
from sleec_verify.encoding.one_instant import at_every_instant
from sleec_verify.traces.instant import Instant

Relation = Union[TimedRelation, Exclusive, Never, Assume]


def relation_key(relation: Relation) -> str:
    """A key for a relation that is not the label of a rule: the place of its text."""
    return f"relation at {relation.span.start}"


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


Name = tuple[str, str]
"""``("event", name)``, or ``("measure", name)`` for a condition or measure."""


def names_in(formula: Formula) -> Iterator[Name]:
    """The events, conditions and measures of a formula."""
    for leaf in leaves(formula):
        if isinstance(leaf, Atom):
            yield "measure" if leaf.kind == "condition" else "event", leaf.name
        else:
            yield from (("measure", measure) for measure in measures_of(leaf))


def names_of_relation(relation: Relation) -> Iterator[Name]:
    """The events, conditions and measures that a relation mentions."""
    yield from (("event", event) for event in events_of(relation))
    for formula in formulas_of_relation(relation):
        yield from names_in(formula)


def may_require(relation: Relation) -> bool:
    """Whether a relation can require an event at an instant at which none of its events occurs."""
    if isinstance(relation, Effect):
        return relation.relation == "causation"
    if not isinstance(relation, (Assume, Never)):
        return False
    return _value(relation.formula, None) is not isinstance(relation, Assume) and any(events_of(relation))


def holds_of_nothing(relation: Relation) -> bool:
    """Whether a relation holds at an instant without events, at which all conditions are false and no measure has a
    value."""
    if isinstance(relation, MeasureRelation):
        return _value(at_every_instant(relation), False) is True
    if isinstance(relation, (Assume, Never)):
        return _value(relation.formula, False) is isinstance(relation, Assume)
    return True


def _value(formula: Formula, state: bool | None) -> bool | None:
    """The value of a formula in Kleene's logic where no event occurs and conditions and comparisons have the value
    `state`; None is unknown."""
    if isinstance(formula, Truth):
        return formula.value
    if isinstance(formula, Not):
        value = _value(formula.operand, state)
        return None if value is None else not value
    if isinstance(formula, (And, Or)):
        values = [_value(operand, state) for operand in formula.operands]
        absorbing = isinstance(formula, Or)
        return absorbing if absorbing in values else None if None in values else not absorbing
    return False if isinstance(formula, Atom) and formula.kind != "condition" else state


def exclusions(relation: Relation) -> Iterator[tuple[str, str]]:
    """The pairs of events that a relation excludes from one instant, whatever else holds there."""
    if isinstance(relation, EventRelation) and relation.relation == "mutualExclusive":
        yield relation.left, relation.right
    elif isinstance(relation, Exclusive):
        yield from combinations(dict.fromkeys(relation.names), 2)


def required_events(relation: Relation) -> Iterator[str]:
    """The events that a relation can require to occur."""
    if isinstance(relation, EventRelation):
        if relation.relation in ("equal", "happenBefore"):
            yield relation.left
        if relation.relation in ("equal", "witness"):
            yield relation.right
    elif isinstance(relation, Lasting):
        if relation.end is not None:
            yield relation.end
    elif isinstance(relation, (Assume, Never)) or (isinstance(relation, Effect) and relation.relation == "causation"):
        yield from events_of(relation)


def invariant(instant: Instant, relation: Relation) -> Iterator[list[int]]:
    """The clauses of a relation about one instant by itself; none for `happenBefore` and `when … until`."""
    unused = -instant.used
    if isinstance(relation, EventRelation):
        left, right = instant.event(relation.left), instant.event(relation.right)
        if relation.relation == "mutualExclusive":
            yield [-left, -right]
        elif relation.relation != "happenBefore":
            yield [-left, right]
            if relation.relation == "equal":
                yield [-right, left]
    elif isinstance(relation, MeasureRelation):
        left = instant.literal(relation.left)
        if relation.right is None:
            yield [unused, left]
            return
        right = instant.literal(relation.right)
        if relation.relation in ("imply", "iff"):
            yield [unused, -left, right]
            if relation.relation == "iff":
                yield [unused, left, -right]
        else:
            yield [unused, -left, -right]
    elif isinstance(relation, Effect):
        occurs, holds = instant.event(relation.event), instant.literal(relation.formula)
        if relation.relation == "causation":
            yield [unused, -holds, occurs]
        else:
            yield [-occurs, holds if relation.relation == "includes" else -holds]
    elif isinstance(relation, Exclusive):
        for one, other in exclusions(relation):
            yield [-instant.event(one), -instant.event(other)]
    elif isinstance(relation, (Assume, Never)):
        holds = instant.literal(relation.formula)
        yield [unused, holds if isinstance(relation, Assume) else -holds]
