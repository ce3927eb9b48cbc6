"""Relations in traces: their keys, the names that they mention, and the events that they can require."""

from __future__ import annotations

from collections.abc import Iterator

from sleec_runtime.model import (
    Assume,
    Atom,
    Comparison,
    Effect,
    EventRelation,
    Formula,
    Lasting,
    MeasureRelation,
    Never,
    Rule,
    formulas_of,
    leaves,
    measures_of,
)
from sleec_verify.encoding.relations import Relation, at_one_instant, events_of, formulas_of_relation
from sleec_verify.encoding.three_valued import is_true_in_empty_context, value_of
from sleec_verify.encoding.window_lengths import measures_of_lengths


def relation_key(relation: Relation) -> str:
    """A key for a relation that is not the label of a rule: the place of its text, and its duration."""
    duration = relation.duration if isinstance(relation, Lasting) else None
    return f"relation at {relation.span.start}" + (f" for {duration}" if duration is not None else "")


Name = tuple[str, str]
"""``("event", name)``, or ``("measure", name)`` for a condition or measure."""


def names_in(formula: Formula) -> Iterator[Name]:
    """The events, conditions and measures of a formula."""
    for leaf in leaves(formula):
        if isinstance(leaf, Atom):
            yield "measure" if leaf.kind == "condition" else "event", leaf.name
        else:
            yield from (("measure", measure) for measure in measures_of(leaf))


def names_of_rule(rule: Rule) -> Iterator[Name]:
    """The events, conditions and measures that decide what a rule requires."""
    for formula in formulas_of(rule):
        yield from names_in(formula)
    for clause in rule.clauses():
        yield from (("measure", measure) for measure in measures_of_lengths(clause))


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
    value = value_of(relation.formula, _without_events)
    return value is not isinstance(relation, Assume) and any(events_of(relation))


def holds_in_empty_context(relation: Relation) -> bool:
    """Whether a relation holds at an instant without events, at which all conditions are false and no measure has a
    value."""
    if not isinstance(relation, (MeasureRelation, Assume, Never)):
        return True
    return all(any(map(is_true_in_empty_context, part)) for part in at_one_instant(relation))


def _without_events(leaf: Atom | Comparison) -> bool | None:
    """No event occurs; conditions and comparisons are unknown."""
    return False if isinstance(leaf, Atom) and leaf.kind != "condition" else None


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
