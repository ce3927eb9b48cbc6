"""Templates: continuations that depend on the situation as little as possible, and which situations they do not fit.

A template adds acts now, which bring about what the rules require at once. Later instants have fixed events and
measures, and lie some seconds after now or after the trigger of a slot. Whether it complies with the selected rules is
then a formula over the situation: the refinement loop adds "it does not" (counterexample-guided inductive synthesis;
A. Solar-Lezama, "Program synthesis by sketching", 2008; for exists-forall SMT: B. Dutertre, "Solving exists/forall
problems with Yices", 2015).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise

from sleec_runtime.model_time import EventRelation, Lasting
from sleec_verify.traces.continuations import Continuations
from sleec_verify.traces.demands import Demand, Every, Occurs, conjuncts, last_second, simplified
from sleec_verify.traces.relations import invariant, relation_key
from sleec_verify.traces.situations import Situations, Slot


@dataclass(frozen=True)
class Later:
    """An instant of a template: `seconds` after the node `anchor`, with its events, what the rules triggered there
    demand, and the `when … until` and `when … for` that begin, hold or end there, by their keys."""

    anchor: int
    seconds: int
    events: frozenset[str]
    demands: tuple[tuple[str, Demand], ...]
    begins: frozenset[str]
    holds: frozenset[str]
    ends: frozenset[str]


@dataclass(frozen=True)
class Template:
    """`acts` are done now, besides what the rules require at once; then come the instants of `later`, in this order."""

    acts: frozenset[str] = frozenset()
    later: tuple[Later, ...] = ()


def template_of(found: Continuations, from_now: bool) -> Template:
    """The template of the continuation that `found.complies` has just found. `from_now`: its later instants are
    reckoned from now only."""
    model = found.model
    times, waits = model.schedule()
    node_of = {node: number for number, node in found.nodes.items()}
    later = []
    nodes = [node for node in model.used() if node in model.instants and node != found.now]
    for node in sorted(nodes, key=lambda n: times[n]):
        anchor, wait = (found.now, times[node] - times[found.now]) if from_now else (node, 0)
        while anchor not in node_of:
            anchor, more = waits.get(anchor, (found.now, times[anchor] - times[found.now]))
            wait += more
        demands = tuple(
            (one.rule.label, simplified(one.due, _truths(found, one.due)))
            for one in model.decided
            if one.at == node and model.true(one.guard)
        )
        begins, holds, ends = set(), set(), set()
        for key, (law, _, _) in found.situations.lasting.items():
            events = model.events(node)
            if law.event in events and model.true(model.condition(node, law.condition)):
                begins.add(key)
            if model.true(model.condition(node, law.formula)):
                holds.add(key)
            if law.end in events and model.true(model.condition(node, law.end_condition)):
                ends.add(key)
        later.append(
            Later(
                node_of[anchor],
                wait,
                model.events(node),
                demands,
                frozenset(begins),
                frozenset(holds),
                frozenset(ends),
            )
        )
    return Template(_acts(found), tuple(later))


def _truths(found: Continuations, demand: Demand) -> dict[int, bool]:
    if isinstance(demand, int):
        return {demand: found.model.true(demand)}
    if isinstance(demand, Occurs):
        return {}
    return {literal: value for part in demand.parts for literal, value in _truths(found, part).items()}


def _acts(found: Continuations) -> frozenset[str]:
    """The events of now that are neither inputs nor required at once by these or one another."""
    model, now = found.model, found.now
    brought = {str(fact[1]) for fact in found.facts if fact[0] == "input" and fact[-1]}
    required = [
        (one.rule.trigger, what.event)
        for one in model.decided
        if one.at == now and model.true(one.guard) and model.true(model.in_force(one.rule.label))
        for what in conjuncts(one.due)
        if what.is_immediate and not what.negated
    ]
    grew = True
    while grew:
        fresh = {event for trigger, event in required if trigger in brought} - brought
        brought |= fresh
        grew = bool(fresh)
    return model.events(now) - brought


@dataclass(frozen=True)
class _Point:
    """An instant of a template in a situation: now, or a later one."""

    node: int
    seconds: int
    events: dict[str, int]


class Defeat:
    """The literals that imply that a template does not fit a situation."""

    def __init__(self, situations: Situations) -> None:
        self._s = situations
        self._formula = situations.formula
        self._true = situations.true

    def add(self, template: Template) -> int:
        """A literal that leaves only the situations that the template does not fit."""
        now = _Point(self._s.now, 0, self._events_now(template.acts))
        later = [_Point(one.anchor, one.seconds, dict.fromkeys(one.events, self._true)) for one in template.later]
        failures = [*self._out_of_order([now, *later]), *self._broken(template, [now, *later])]
        counts = self._formula.fresh()
        self._s.add([-counts, *(failure for failure in dict.fromkeys(failures) if failure != -self._true)])
        return counts

    def _events_now(self, acts: frozenset[str]) -> dict[str, int]:
        """The least set of events with the inputs, `acts`, and what the selected rules require at once."""
        index = self._s.index
        found = dict(self._s.inputs)
        found.update(dict.fromkeys(acts, self._true))
        required = [
            (rule.trigger, what.event, self._formula_and(self._s.selected[rule.label], guard))
            for rule in index.ruleset.rules
            for clause, guard in zip(rule.clauses(), self._s.guards[rule.label])
            for what in conjuncts(index.responses.of(index.contested(clause), self._chain))
            if what.is_immediate and not what.negated and what.event not in index.mere_inputs
        ]
        # A chain of requirements is at most as long as there are requirements; most end after one or two rounds.
        for _ in required:
            grown = dict(found)
            for event in dict.fromkeys(event for _, event, _ in required):
                reasons = [self._formula_and(found[t], why) for t, e, why in required if e == event and t in found]
                grown[event] = self._formula_or([found.get(event, -self._true), *reasons])
            if grown == found:
                break
            found = grown
        return found

    def _formula_and(self, one: int, other: int) -> int:
        return self._s.instant.both(one, other)

    def _formula_or(self, literals: Sequence[int]) -> int:
        literals = [literal for literal in dict.fromkeys(literals) if literal != -self._true]
        if self._true in literals:
            return self._true
        return self._s.instant.any_of(literals) if literals else -self._true

    def _chain(self, clause: object) -> list[int]:
        return self._s.instant.chain(clause, self._s.reading)  # type: ignore[arg-type]

    # Times ----------------------------------------------------------------------------------------------------

    def _within(self, a: _Point, b: _Point, start: int | None, end: int | None) -> list[int]:
        """Literals that together say that `b` is from `start` to `end` seconds after `a`."""
        shift = a.seconds - b.seconds
        return self._s.times.within(
            a.node, b.node, None if start is None else start + shift, None if end is None else end + shift
        )

    def _out_of_order(self, points: Sequence[_Point]) -> Iterator[int]:
        for earlier, later in pairwise(points):
            yield from self._within(later, earlier, 0, None)

    # Rules ----------------------------------------------------------------------------------------------------

    def _broken(self, template: Template, points: list[_Point]) -> Iterator[int]:
        s, every = self._s, self._formula.every
        for rule in s.index.ruleset.rules:
            trigger = points[0].events.get(rule.trigger, -self._true)
            if trigger == -self._true:
                continue
            for clause, guard in zip(rule.clauses(), s.guards[rule.label]):
                contested = s.index.contested(clause)
                if contested:
                    broken = s.index.responses.of(contested, self._chain, kept=False)
                    fails = self._holds(points, points[0], broken)
                    yield every([trigger, s.selected[rule.label], guard, fails])
        for one, point in zip(template.later, points[1:]):
            for label, demand in one.demands:
                yield every([s.selected[label], self._fails(points, point, demand)])
        for slot in s.slots:
            point = _Point(slot.node, 0, {})
            fails = self._fails(points, point, slot.demand, slot)
            yield every([slot.active, s.selected[slot.rule.label], fails])
        yield from self._relations(template, points)

    def _holds(self, points: Sequence[_Point], at: _Point, demand: Demand) -> int:
        """A literal that implies a demand of one of the points."""
        if isinstance(demand, int):
            return demand
        if isinstance(demand, Occurs):
            return self._occurs(points, at, demand)
        parts = [self._holds(points, at, part) for part in demand.parts]
        return self._formula.every(parts) if isinstance(demand, Every) else self._formula.any_of(parts)

    def _fails(self, points: Sequence[_Point], at: _Point, demand: Demand, slot: Slot | None = None) -> int:
        """A literal that implies that a demand without literals is not met."""
        assert not isinstance(demand, int), "only demands of now have literals"
        if isinstance(demand, Occurs):
            fails = self._occurs(points, at, demand._replace(negated=not demand.negated))
            if slot is None:
                return fails
            came = slot.came[demand]
            return self._formula.any_of([came, fails]) if demand.negated else self._formula.every([-came, fails])
        parts = [self._fails(points, at, part, slot) for part in demand.parts]
        return self._formula.any_of(parts) if isinstance(demand, Every) else self._formula.every(parts)

    def _occurs(self, points: Sequence[_Point], at: _Point, what: Occurs) -> int:
        there = []
        for point in points:
            event = point.events.get(what.event, -self._true)
            literals = [event, *self._within(at, point, what.start, what.end)]
            if -self._true not in literals:
                there.append([literal for literal in literals if literal != self._true])
        if not what.negated:
            return self._formula.any_of([self._formula.every(literals) for literals in there])
        return self._formula.every([self._formula.any_of([-one for one in literals]) for literals in there])

    # Relations ------------------------------------------------------------------------------------------------

    def _relations(self, template: Template, points: list[_Point]) -> Iterator[int]:
        for relation in self._s.index.relations:
            if isinstance(relation, Lasting):
                yield from self._lasting(relation, template, points)
            elif isinstance(relation, EventRelation) and relation.relation == "happenBefore":
                yield from self._precedence(relation, points)
            else:
                yield self._invariant_broken(relation, points[0])

    def _invariant_broken(self, relation: object, now: _Point) -> int:
        """A literal that implies that a relation about single instants is broken now; later it is kept by what the
        template fixes."""
        shadow = _Shadow(self._s, now.events)
        clauses = list(invariant(shadow, relation))  # type: ignore[arg-type]
        return self._formula.any_of([self._formula.every([-literal for literal in clause]) for clause in clauses])

    def _precedence(self, relation: EventRelation, points: list[_Point]) -> Iterator[int]:
        before = [self._s.occurred[relation.left]]
        for point in points:
            right = point.events.get(relation.right, -self._true)
            yield self._formula.every([right, *(-literal for literal in before)])
            before.append(point.events.get(relation.left, -self._true))

    def _lasting(self, law: Lasting, template: Template, points: list[_Point]) -> Iterator[int]:
        key = relation_key(law)
        _, active, node = self._s.lasting[key]
        now = points[0]
        instant = self._s.instant

        def condition(formula: object) -> int:
            return self._true if formula is None else instant.literal(formula)  # type: ignore[arg-type]

        begins = [self._formula_and(now.events.get(law.event, -self._true), condition(law.condition))]
        begins += [self._true if key in one.begins else -self._true for one in template.later]
        holds = [condition(law.formula), *(self._true if key in one.holds else -self._true for one in template.later)]
        stops = [-self._true] * len(points)
        if law.end is not None:
            stops = [self._formula_and(now.events.get(law.end, -self._true), condition(law.end_condition))]
            stops += [self._true if key in one.ends else -self._true for one in template.later]
        last = None if law.duration is None else last_second(law.duration)
        for number, point in enumerate(points):
            for since, began in [(_Point(node, 0, {}), active), *zip(points[: number + 1], begins)]:
                first = points.index(since) if since in points else 0
                bounds = [] if last is None else self._within(since, point, None, last)
                running = [-stop for stop in stops[first : number + 1]]
                yield self._formula.every([began, *bounds, *running, -holds[number]])


class _Shadow:
    """The instant of now as relations see it, with the events of a template."""

    def __init__(self, situations: Situations, events: dict[str, int]) -> None:
        self._situations = situations
        self._events = events
        self.used = situations.true

    def event(self, name: str) -> int:
        return self._events.get(name, -self._situations.true)

    def literal(self, formula: object) -> int:
        from sleec_runtime.model import And, Atom, Not, Or

        instant = self._situations.instant
        if isinstance(formula, Atom) and formula.kind != "condition":
            return self.event(formula.name)
        if isinstance(formula, Not):
            return -self.literal(formula.operand)
        if isinstance(formula, And):
            return instant.all_of([self.literal(operand) for operand in formula.operands])
        if isinstance(formula, Or):
            return instant.any_of([self.literal(operand) for operand in formula.operands])
        return instant.literal(formula)  # type: ignore[arg-type]
