"""The situations that violate a relation if the robot follows a template, as a formula."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

from sleec_runtime.model import Atom, EventRelation, Lasting
from sleec_verify.encoding.relations import Relation, at_one_instant
from sleec_verify.traces.demands import last_second
from sleec_verify.traces.relations import relation_key
from sleec_verify.traces.situations import Situations
from sleec_verify.traces.templates import Later


class Point(NamedTuple):
    """An instant of a template in a situation: `seconds` after a node, if the literal `exists` is true. `later` is None
    for now, and for the time of a trigger."""

    node: int
    seconds: int
    exists: int
    events: dict[str, int]
    later: Later | None = None


def within(situations: Situations, a: Point, b: Point, start: int | None, end: int | None) -> list[int]:
    """Literals that together say that `b` is from `start` to `end` seconds after `a`."""
    shift = a.seconds - b.seconds
    return situations.times.within(
        a.node, b.node, None if start is None else start + shift, None if end is None else end + shift
    )


class RelationViolations:
    """The literals that imply that a template violates a relation."""

    def __init__(self, situations: Situations) -> None:
        self._s = situations
        self._formula = situations.formula
        self._true = situations.true

    def failures(self, points: Sequence[Point], others: Sequence[Point]) -> Iterator[int]:
        for relation in self._s.index.relations:
            if isinstance(relation, Lasting):
                yield from self._lasting(relation, points, others)
            elif isinstance(relation, EventRelation) and relation.relation == "happenBefore":
                yield from self._precedence(relation, points, others)
            else:
                yield self._invariant_broken(relation, points[0])

    def _invariant_broken(self, relation: Relation, now: Point) -> int:
        """A literal that implies that a relation about single instants is violated now. The fixed later instants of
        the template satisfy it."""
        instant = self._s.instant

        def atom(one: Atom) -> int:
            return (
                instant.variable((one.kind, one.name))
                if one.kind == "condition"
                else now.events.get(one.name, -self._true)
            )

        parts = ([-instant.literal(formula, atom) for formula in part] for part in at_one_instant(relation))
        return self._formula.any_of([self._formula.every(part) for part in parts])

    def _precedence(self, relation: EventRelation, points: Sequence[Point], others: Sequence[Point]) -> Iterator[int]:
        before = [self._s.occurred[relation.left]]
        for point in points:
            right = point.events.get(relation.right, -self._true)
            yield self._formula.every([right, *(-literal for literal in before)])
            before.append(point.events.get(relation.left, -self._true))
        for point in others:
            right = point.events.get(relation.right, -self._true)
            yield self._formula.every([right, *(-literal for literal in before[:2])])

    def _lasting(self, law: Lasting, points: Sequence[Point], others: Sequence[Point]) -> Iterator[int]:
        key, every = relation_key(law), self._formula.every
        _, active, node = self._s.lasting[key]

        def now(event: str, condition: object) -> int:
            return self._s.instant.both(points[0].events.get(event, -self._true), self._condition(condition))

        begins = [now(law.event, law.condition)]
        holds = [self._condition(law.formula)]
        stops = [-self._true if law.end is None else now(law.end, law.end_condition)]
        for point in points[1:]:
            assert point.later is not None
            begins.append(point.exists if key in point.later.begins else -self._true)
            holds.append(self._true if key in point.later.holds else -self._true)
            stops.append(point.exists if key in point.later.ends else -self._true)
        last = None if law.duration is None else last_second(law.duration)
        for number, point in enumerate(points):
            for since, began in [(Point(node, 0, active, {}), active), *zip(points[: number + 1], begins)]:
                first = points.index(since) if since in points else 0
                bounds = [] if last is None else within(self._s, since, point, None, last)
                running = [-stop for stop in stops[first : number + 1]]
                yield every([began, point.exists, *bounds, *running, -holds[number]])
        # Assume that relations that a policy begins, or that bind its instants, last.
        for point in others:
            assert point.later is not None
            if key not in point.later.holds:
                for began in (active, begins[0]):
                    yield every([point.exists, began, -stops[0]])
                for began in begins[1:]:
                    yield every([point.exists, began])
            if key in point.later.begins:
                for other in [*points[1:], *others]:
                    if other.later is not None and key not in other.later.holds:
                        yield every([point.exists, other.exists])

    def _condition(self, formula: object) -> int:
        return self._true if formula is None else self._s.instant.literal(formula)  # type: ignore[arg-type]
