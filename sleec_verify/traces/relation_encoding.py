"""The relations of a trace model: their requirements for every instant and the instants around it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

from sleec_runtime.model import EventRelation, Lasting
from sleec_verify.encoding.relations import Relation, at_one_instant
from sleec_verify.traces.demands import last_second
from sleec_verify.traces.relations import relation_key
from sleec_verify.traces.unrolling import Unrolling


@dataclass
class Past:
    """What occurred before the first instant of a trace model."""

    occurred: Callable[[str], int]
    """For an event, the literal that it occurred."""
    began: dict[str, Callable[[int], list[int]]] = field(default_factory=dict)
    """For the key of a `when ... until` or `when ... for`, literals that together say that it binds at an instant
    because it began."""


def relation_at(model: Unrolling, past: Past, relation: Relation) -> Callable[[int], None]:
    """A function that encodes the relation for an instant, if it is in force."""
    in_force = model.in_force(relation_key(relation))

    if isinstance(relation, EventRelation) and relation.relation == "happenBefore":
        # The first occurrence precedes all events that must follow it.
        first, occurs = model.node(), model.formula.fresh()
        left = relation.left
        model.add(
            [
                -occurs,
                model.exists(
                    lambda at: model.formula.every(
                        [model.instants[at].event(left), *model.times.within(first, at, 0, 0)]
                    )
                ),
            ]
        )

    def precedence(at: int, precedes: EventRelation) -> None:
        right = model.instants[at].event(precedes.right)
        came = model.formula.every([occurs, model.times.before(first, at)])
        model.add([-in_force, -right, came, past.occurred(precedes.left)])

    def lasting(at: int, law: Lasting) -> None:
        model.everywhere(lambda other: _binds(model, law, at, other, in_force))
        if law_key in past.began:
            require = model.condition(at, law.formula)
            away = [-literal for literal in past.began[law_key](at)]
            model.add([-in_force, -model.instants[at].used, *away, *stopped(model, law, None, at), require])

    law_key = relation_key(relation)

    def make(at: int) -> None:
        if isinstance(relation, Lasting):
            lasting(at, relation)
        elif isinstance(relation, EventRelation) and relation.relation == "happenBefore":
            precedence(at, relation)
        else:
            instant = model.instants[at]
            for part in at_one_instant(relation):
                model.add([-in_force, -instant.used, *map(instant.literal, part)])

    return make


def _binds(model: Unrolling, law: Lasting, at: int, other: int, in_force: int) -> None:
    """If the relation begins at instant `at`, its formula holds at instant `other`, unless it is over then."""
    begins = [model.instants[at].event(law.event), model.condition(at, law.condition)]
    last = None if law.duration is None else last_second(law.duration)
    bounds = model.times.within(at, other, 0, last)
    away = [-literal for literal in (*begins, model.instants[other].used, *bounds)]
    if model.formula.true not in away:
        holds = model.condition(other, law.formula)
        model.add([-in_force, *away, *stopped(model, law, at, other), holds])


def stopped(model: Unrolling, law: Lasting, since: int | None, until: int) -> list[int]:
    """A literal that implies that an event ended the relation between two instants, if an event can end it."""
    if law.end is None:
        return []
    end = law.end

    def stops(other: int) -> int:
        bounds = model.times.within(other, until, 0, None)
        bounds += [] if since is None else model.times.within(since, other, 0, None)
        if -model.formula.true in bounds:
            return -model.formula.true
        instant = model.instants[other]
        return model.formula.every([instant.event(end), model.condition(other, law.end_condition), *bounds])

    return [model.exists(stops)]
