"""What relations and constraints demand of each instant of an unfolding."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from sleec_runtime.model import Assume, Exclusive
from sleec_runtime.model_time import Effect, EventRelation, Lasting, MeasureRelation
from sleec_verify.timed.program import Law, law_name
from sleec_verify.timed.responses import Occurs, seconds

if TYPE_CHECKING:
    from sleec_verify.timed.unfolding import Unfolding


def law_at(unfolding: Unfolding, law: Law) -> Callable[[int], None]:
    """What a relation or constraint demands of an instant."""
    in_force = unfolding.in_force(law_name(law))

    # One instant at which it comes first is enough for all.
    comes_first = (
        unfolding.first(lambda other: unfolding.instants[other].event(law.left))
        if isinstance(law, EventRelation) and law.relation == "happenBefore"
        else None
    )

    def require(*literals: int) -> None:
        unfolding.add([-in_force, *literals])

    def event(at: int, name: str) -> int:
        return unfolding.instants[at].event(name)

    def of_events(at: int, relation: EventRelation) -> None:
        left, right = event(at, relation.left), event(at, relation.right)
        if relation.relation == "mutualExclusive":
            require(-left, -right)
        elif comes_first is not None:
            before = Occurs(relation.left, None, -1)
            came = unfolding.by_first(
                comes_first, lambda other: unfolding.occurrence(at, other, before), at > unfolding.now
            )
            require(-right, came)
        else:
            require(-left, right)
            if relation.relation == "equal":
                require(-right, left)

    def of_measures(at: int, relation: MeasureRelation) -> None:
        unused, left = -unfolding.instants[at].used, unfolding.condition(at, relation.left)
        right = unfolding.condition(at, relation.right)
        if relation.relation == "invariant":
            require(unused, left)
        elif relation.relation in ("imply", "iff"):
            require(unused, -left, right)
            if relation.relation == "iff":
                require(unused, left, -right)
        else:
            require(unused, -left, -right)

    def of_effect(at: int, effect: Effect) -> None:
        occurs, holds = event(at, effect.event), unfolding.condition(at, effect.formula)
        if effect.relation == "causation":
            require(-unfolding.instants[at].used, -holds, occurs)
        else:
            require(-occurs, holds if effect.relation == "includes" else -holds)

    def of_lasting(at: int, lasting: Lasting) -> None:
        begins = unfolding.formula.fresh()
        unfolding.add([-event(at, lasting.event), -unfolding.condition(at, lasting.condition), begins])

        def stops(other: int) -> int:
            assert lasting.end is not None
            return unfolding.formula.every(
                [event(other, lasting.end), unfolding.condition(other, lasting.end_condition)]
            )

        def ends(other: int) -> int:
            return unfolding.formula.every([stops(other), *unfolding.times.bounds(at, other, 0, None)])

        first_end = unfolding.first(ends) if lasting.end is not None else None

        def stopped_by(until: int) -> int:
            assert first_end is not None
            return unfolding.by_first(
                first_end,
                lambda other: unfolding.formula.every([ends(other), *unfolding.times.bounds(other, until, 0, None)]),
                until > unfolding.now,
            )

        def holds_at(other: int) -> None:
            if lasting.duration is not None:
                last = -(-seconds(lasting.duration) // 1) - 1
                bounds = unfolding.times.bounds(at, other, 0, int(last))
            else:
                stopped = unfolding.came_about(at, law_name(lasting))
                bounds = [*unfolding.times.bounds(at, other, 0, None), -stopped_by(other), -stopped]
            away = [-bound for bound in bounds]
            require(-begins, -unfolding.instants[other].used, *away, unfolding.condition(other, lasting.formula))

        unfolding.everywhere(holds_at)

    def make(at: int) -> None:
        if isinstance(law, EventRelation):
            of_events(at, law)
        elif isinstance(law, MeasureRelation):
            of_measures(at, law)
        elif isinstance(law, Effect):
            of_effect(at, law)
        elif isinstance(law, Lasting):
            of_lasting(at, law)
        elif isinstance(law, Exclusive):
            names = list(dict.fromkeys(law.names))
            for place, name in enumerate(names):
                for other in names[place + 1 :]:
                    require(-event(at, name), -event(at, other))
        else:
            holds = unfolding.condition(at, law.formula)
            require(-unfolding.instants[at].used, holds if isinstance(law, Assume) else -holds)

    return make
