"""What relations and constraints demand of each instant of an unfolding."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING

from sleec_runtime.model import Assume, Exclusive, Never
from sleec_runtime.model_time import Effect, EventRelation, Lasting, MeasureRelation
from sleec_verify.timed.program import Law, excluding, law_name
from sleec_verify.timed.responses import Occurs, last_second

if TYPE_CHECKING:
    from sleec_verify.timed.instant import Instant
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

    def of_before(at: int, relation: EventRelation) -> None:
        assert comes_first is not None
        event(at, relation.left)
        right = event(at, relation.right)
        before = Occurs(relation.left, None, -1)
        came = unfolding.by_first(
            comes_first, lambda other: unfolding.occurrence(at, other, before), at > unfolding.now
        )
        require(-right, came, unfolding.left_out.came_before(at, relation.left))

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
                bounds = unfolding.times.bounds(at, other, 0, last_second(lasting.duration))
            else:
                bounds = [*unfolding.times.bounds(at, other, 0, None), -stopped_by(other)]
                if other != at:
                    # What is left out happened at other instants.
                    bounds.append(-unfolding.left_out.came_about(at, law_name(lasting)))
            away = [-bound for bound in bounds]
            require(-begins, -unfolding.instants[other].used, *away, unfolding.condition(other, lasting.formula))

        unfolding.everywhere(holds_at)

    def make(at: int) -> None:
        if isinstance(law, Lasting):
            of_lasting(at, law)
        elif isinstance(law, EventRelation) and law.relation == "happenBefore":
            of_before(at, law)
        else:
            for clause in clauses_at(unfolding.instants[at], law):
                require(*clause)

    return make


def clauses_at(instant: Instant, law: Law) -> Iterator[list[int]]:
    """What a law demands of an instant by itself; nothing of what it says of other instants."""
    unused = -instant.used
    if isinstance(law, EventRelation):
        left, right = instant.event(law.left), instant.event(law.right)
        if law.relation == "mutualExclusive":
            yield [-left, -right]
        elif law.relation != "happenBefore":
            yield [-left, right]
            if law.relation == "equal":
                yield [-right, left]
    elif isinstance(law, MeasureRelation):
        left = instant.literal(law.left)
        if law.right is None:
            yield [unused, left]
            return
        right = instant.literal(law.right)
        if law.relation in ("imply", "iff"):
            yield [unused, -left, right]
            if law.relation == "iff":
                yield [unused, left, -right]
        else:
            yield [unused, -left, -right]
    elif isinstance(law, Effect):
        occurs, holds = instant.event(law.event), instant.literal(law.formula)
        if law.relation == "causation":
            yield [unused, -holds, occurs]
        else:
            yield [-occurs, holds if law.relation == "includes" else -holds]
    elif isinstance(law, Exclusive):
        for one, other in excluding(law):
            yield [-instant.event(one), -instant.event(other)]
    elif isinstance(law, (Assume, Never)):
        holds = instant.literal(law.formula)
        yield [unused, holds if isinstance(law, Assume) else -holds]
