"""The situations that a template does not fit, as a formula. The refinement loop asks for a situation that no template
fits.

(Counterexample-guided inductive synthesis; A. Solar-Lezama, "Program synthesis by sketching", 2008; for exists-forall
SMT: B. Dutertre, "Solving exists/forall problems with Yices", 2015.)

A template does not fit because a demand fails or because instants collide. Instants of policies count only as far as
they violate something. They meet only demands of their own slot, so each failure depends on few slots.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from itertools import combinations
from typing import NamedTuple

from sleec_verify.encoding.relations import events_of
from sleec_verify.traces.demands import Demand, Every, Occurs, conjuncts
from sleec_verify.traces.pending_demands import Slot
from sleec_verify.traces.relation_violations import Point, RelationViolations, within
from sleec_verify.traces.situations import Situations
from sleec_verify.traces.templates import Later, Template
from sleec_verify.traces.trivial_responses import contested_obligations


class _Plan(NamedTuple):
    """The instants of a policy for one slot. Their `exists` implies that they exist; that of `own` is implied by it, if
    the demand of the slot is not met otherwise."""

    points: list[Point]
    own: list[Point]


class _Timeline(NamedTuple):
    """The points that can meet a demand, and the others, which can only violate one."""

    fixed: Sequence[Point]
    others: Sequence[Point]


class Defeat:
    """The literals that imply that a template does not fit a situation."""

    def __init__(self, situations: Situations) -> None:
        self._s = situations
        self._formula = situations.formula
        self._true = situations.true
        self._relations = RelationViolations(situations)

    def add(self, template: Template, slots: Collection[Slot]) -> int:
        """A literal that leaves only the situations that the template does not fit, because of these slots."""
        now = Point(self._s.now, 0, self._true, self._events_now(template.acts))
        fixed = [now, *(self._point(node, self._s.active[node], later) for node, later in template.later)]
        plans: dict[Slot, _Plan] = {}
        for slot in slots:
            plan = template.policy(slot.pending)
            if plan:
                plans[slot] = self._plan(slot, plan, fixed)
        failures = [*self._in_the_way(fixed, list(plans.values())), *self._broken(fixed, plans, slots)]
        counts = self._formula.fresh()
        self._s.add([-counts, *(failure for failure in dict.fromkeys(failures) if failure != -self._true)])
        return counts

    def _point(self, node: int, exists: int, later: Later) -> Point:
        return Point(node, later.seconds, exists, dict.fromkeys(later.events, exists), later)

    def _plan(self, slot: Slot, plan: Sequence[Later], fixed: Sequence[Point]) -> _Plan:
        """The instants of a policy for a slot. They exist if its demand is not met otherwise and all of them are
        after now."""
        trigger = Point(slot.node, 0, slot.active, {})
        first = trigger._replace(seconds=min(later.seconds for later in plan))
        (to_come,) = within(self._s, fixed[0], first, 1, None)
        unmet = self._fails(_Timeline(fixed, ()), trigger, slot.demand, slot)
        exists = self._formula.every([slot.active, self._s.selected[slot.rule.label], unmet, to_come])
        return _Plan(
            [self._point(slot.node, exists, later) for later in plan],
            [self._point(slot.node, to_come, later) for later in plan],
        )

    def _events_now(self, acts: frozenset[str]) -> dict[str, int]:
        """The smallest set of events with the inputs, `acts`, and what the selected rules require at once."""
        index = self._s.index
        found = dict(self._s.inputs)
        found.update(dict.fromkeys(sorted(acts), self._true))
        required = [
            (rule.trigger, what.event, self._s.instant.both(self._s.selected[rule.label], guard))
            for rule in index.ruleset.rules
            for clause, guard in zip(rule.clauses(), self._s.guards[rule.label])
            for what in conjuncts(index.responses.of(contested_obligations(index, clause), self._chain))
            if what.is_immediate and not what.negated and what.event not in index.never_in_response
        ]
        # A chain of requirements is at most as long as there are requirements; most end after one or two rounds.
        for _ in required:
            grown = dict(found)
            for event in dict.fromkeys(event for _, event, _ in required):
                reasons = [self._s.instant.both(found[t], why) for t, e, why in required if e == event and t in found]
                grown[event] = self._formula_or([found.get(event, -self._true), *reasons])
            if grown == found:
                break
            found = grown
        return found

    def _formula_or(self, literals: Sequence[int]) -> int:
        literals = [literal for literal in dict.fromkeys(literals) if literal != -self._true]
        if self._true in literals:
            return self._true
        return self._s.instant.any_of(literals) if literals else -self._true

    def _chain(self, clause: object) -> list[int]:
        return self._s.instant.chain(clause, self._s.reading)  # type: ignore[arg-type]

    # Times ----------------------------------------------------------------------------------------------------

    def _in_the_way(self, fixed: Sequence[Point], plans: Sequence[_Plan]) -> Iterator[int]:
        """Literals that imply that fixed points are out of order, or that points coincide that cannot be the same
        instant."""
        every = self._formula.every
        for earlier, later in combinations(fixed, 2):
            yield every([earlier.exists, later.exists, *within(self._s, later, earlier, 0, None)])
        pairs = [(point, other) for plan in plans for point in plan.points for other in fixed[1:]]
        pairs += [(a, b) for one, other in combinations(plans, 2) for a in one.points for b in other.points]
        for point, other in pairs:
            if not self._can_be_one(point.later, other.later):
                yield every([point.exists, other.exists, *within(self._s, point, other, 0, 0)])

    def _can_be_one(self, one: Later | None, other: Later | None) -> bool:
        """Whether two instants can coincide, with the events of both."""
        assert one is not None
        assert other is not None
        if one.events == other.events and one.state == other.state:
            return True
        values = dict(one.state)
        if any(values.get(name, value) != value for name, value in other.state):
            return False
        union = one.events | other.events
        return all(
            union & named in (one.events & named, other.events & named)
            for named in map(frozenset, map(events_of, self._s.index.relations))
        )

    # Rules ----------------------------------------------------------------------------------------------------

    def _broken(self, fixed: Sequence[Point], plans: dict[Slot, _Plan], slots: Collection[Slot]) -> Iterator[int]:
        s, every = self._s, self._formula.every
        others = [point for plan in plans.values() for point in plan.points]
        timeline = _Timeline(fixed, others)
        for rule in s.index.ruleset.rules:
            trigger = fixed[0].events.get(rule.trigger, -self._true)
            if trigger == -self._true:
                continue
            for clause, guard in zip(rule.clauses(), s.guards[rule.label]):
                obligations = contested_obligations(s.index, clause)
                if obligations:
                    broken = s.index.responses.of(obligations, self._chain, kept=False)
                    fails = self._holds(timeline, fixed[0], broken)
                    yield every([trigger, s.selected[rule.label], guard, fails])
        for slot in slots:
            points, own = plans.get(slot, _Plan([], []))
            with_own = _Timeline([*fixed, *own], [point for point in others if point not in points])
            fails = self._fails(with_own, Point(slot.node, 0, slot.active, {}), slot.demand, slot)
            yield every([slot.active, s.selected[slot.rule.label], fails])
            yield from self._demands(points, with_own)
        yield from self._demands(fixed[1:], timeline)
        yield from self._relations.failures(fixed, others)

    def _demands(self, points: Sequence[Point], timeline: _Timeline) -> Iterator[int]:
        """Literals that imply that a demand fails of the rules that are triggered at some points."""
        for point in points:
            assert point.later is not None
            for label, demand in point.later.demands:
                fails = self._fails(timeline, point, demand)
                yield self._formula.every([point.exists, self._s.selected[label], fails])

    def _holds(self, timeline: _Timeline, at: Point, demand: Demand) -> int:
        """A literal that implies a demand of one of the points."""
        if isinstance(demand, int):
            return demand
        if isinstance(demand, Occurs):
            return self._occurs(timeline, at, demand)
        parts = [self._holds(timeline, at, part) for part in demand.parts]
        return self._formula.every(parts) if isinstance(demand, Every) else self._formula.any_of(parts)

    def _fails(self, timeline: _Timeline, at: Point, demand: Demand, slot: Slot | None = None) -> int:
        """A literal that implies that a demand without literals is not met."""
        assert not isinstance(demand, int), "only demands of now have literals"
        if isinstance(demand, Occurs):
            fails = self._occurs(timeline, at, demand._replace(negated=not demand.negated))
            if slot is None:
                return fails
            came = slot.came[demand]
            return self._formula.any_of([came, fails]) if demand.negated else self._formula.every([-came, fails])
        parts = [self._fails(timeline, at, part, slot) for part in demand.parts]
        return self._formula.any_of(parts) if isinstance(demand, Every) else self._formula.every(parts)

    def _occurs(self, timeline: _Timeline, at: Point, what: Occurs) -> int:
        """A literal that implies an atom, which violates a demand. An occurrence violates a prohibition at any
        point, but meets an obligation only at a fixed one."""
        there = []
        for point in [*timeline.fixed, *(() if what.negated else timeline.others)]:
            event = point.events.get(what.event, -self._true)
            literals = [event, *within(self._s, at, point, what.start, what.end)]
            if -self._true not in literals:
                there.append([literal for literal in literals if literal != self._true])
        if not what.negated:
            return self._formula.any_of([self._formula.every(literals) for literals in there])
        return self._formula.every([self._formula.any_of([-one for one in literals]) for literals in there])
