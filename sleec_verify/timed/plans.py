"""Plans: ways to go on after a history, and which histories they do not work with.

A plan depends on the history as little as possible. It adds events now, which bring with them all that is due at once;
from then on it follows a policy, or adds instants at distances from those of the history. Whether it keeps everything
is a formula over the history.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

from sleec_runtime.model import And, Assume, Atom, Clause, Exclusive, Never, Not, Or, Reading, Rule, Value
from sleec_runtime.model_time import Effect, EventRelation, Lasting
from sleec_verify.timed.conflict_cone import Cone
from sleec_verify.timed.instant import Fixed, Instant
from sleec_verify.timed.policy import Policy, ruled_out
from sleec_verify.timed.program import Program, excluding, law_name, together
from sleec_verify.timed.responses import Demand, Every, Occurs, certain, last_second, occurrences
from sleec_verify.timed.unfolding import Unfolding


@dataclass(frozen=True)
class Later:
    """An instant of a plan: `wait` seconds after instant `after` of the history."""

    after: int
    wait: int
    events: frozenset[str]
    conditions: tuple[tuple[str, Value], ...]


@dataclass(frozen=True)
class Plan:
    """A way to go on: events added now, and what happens later: at instants of its own, or by a policy
    (`sleec_verify.timed.policy`)."""

    added: frozenset[str]
    later: tuple[Later, ...] = ()
    policy: Policy | None = None


class _Point:
    """An instant of the history continued by a plan."""

    def __init__(self, instant: Instant, after: int, wait: int, event: Callable[[str], int], used: int) -> None:
        self.instant = instant
        self.after = after
        self.wait = wait
        self.event = event
        self.used = used
        self._deciding: dict[str, list[tuple[Clause, int]]] = {}

    def deciding(self, rule: Rule, reading: Reading, true: int) -> list[tuple[Clause, int]]:
        """The clauses of a rule with the literals that they decide here; none where nothing can trigger it."""
        found = self._deciding.get(rule.label)
        if found is None:
            triggered = self.event(rule.trigger)
            guards = [] if triggered == -true else self.instant.guards(rule, reading, triggered)
            found = self._deciding[rule.label] = list(zip(rule.clauses(), guards))
        return found


class Plans:
    """The plans that a history must defeat: the last of the instants `past` and `now` of an unfolding, in the order of
    time, where the events `given` are those of now before anything is done."""

    def __init__(self, outer: Unfolding, cone: Cone, past: Sequence[int], now: int, given: dict[str, int]) -> None:
        self.program: Program = outer.program
        self.cone = cone
        self.outer = outer
        self.past = past
        self.now = now
        self.given = given
        self.add = outer.add
        self.true = outer.formula.true
        self._loops: list[Callable[[], list[list[int]]]] = []
        self._laws = self.program.laws_among(cone.events)

    def loops(self) -> list[list[int]]:
        """Clauses against what happens under some plan, in the model, only because of itself."""
        return [clause for loop in self._loops for clause in loop()]

    def deciding(self, rule: Rule) -> list[tuple[Clause, int]]:
        """The clauses of a rule with the literals that they decide now, if the rule is triggered."""
        guards = self.outer.instants[self.now].guards(rule, self.program.ruleset.reading, self.true)
        return list(zip(rule.clauses(), guards))

    def defeat(self, plan: Plan) -> None:
        """Only histories with which `plan` does not work."""
        policy = plan.policy or Policy()
        points = [
            _Point(
                self.outer.instants[number],
                number,
                0,
                self.outer.instants[number].event,
                self.outer.instants[number].used,
            )
            for number in self.past
        ]
        happens = self._closed(plan, self._last_chances(points, policy))
        now = _Point(self.outer.instants[self.now], self.now, 0, lambda name: happens.get(name, -self.true), self.true)
        points.append(now)
        for later in plan.later:
            fixed = Fixed(0, later.events, dict(later.conditions))
            instant = Instant(self.outer.formula, self.program.ruleset.measures, self.true, fixed)
            points.append(_Point(instant, later.after, later.wait, instant.event, self.true))
        failures = [*self._out_of_order(points), *self._broken(points, policy), *self._laws_broken(points, policy)]
        failures += self._too_late(points, policy)
        for point in points:
            point.instant.settle()
        self.add(failures)

    def _closed(self, plan: Plan, last_chances: Iterator[tuple[str, int]]) -> dict[str, int]:
        """What happens now under a plan: what is given or added, or has to be done now at the latest, and all that is
        due at once by it."""
        formula = self.outer.formula
        happens = {event: formula.fresh() for event in self.given}
        supports: dict[str, list[tuple[str | None, int]]] = {event: [] for event in happens}
        for event, is_last in last_chances:
            supports[event].append((None, is_last))
        for rule in self.cone.rules.values():
            for clause, decides in self.deciding(rule):
                for event in at_once(self.outer.due(self.now, clause.obligations)):
                    both = formula.fresh()
                    trigger = happens[rule.trigger]
                    formula.clauses += ([-both, trigger], [-both, decides], [both, -trigger, -decides])
                    supports[event].append((rule.trigger, both))
        for law in self.program.laws:
            for cause, effect in together(law):
                if cause in happens and effect in happens:
                    supports[effect].append((cause, happens[cause]))
            if isinstance(law, Effect) and law.relation == "causation" and law.event in happens:
                supports[law.event].append((None, self.outer.condition(self.now, law.formula)))
        for event in happens:
            literal, reasons = happens[event], [support for _, support in supports[event]]
            for reason in (self.given[event], *reasons):
                self.add([-reason, literal])
            if event in plan.added:
                self.add([literal])
            else:
                self.add([-literal, self.given[event], *reasons])
        self._loops.append(lambda: self._unfounded(plan, happens, supports))
        return happens

    def _last_chances(self, past: Sequence[_Point], policy: Policy) -> Iterator[tuple[str, int]]:
        """The events to which a policy gives times of their own, and the literals "now is the last time at which it can
        be done as an instant before now calls for"."""
        times = self.outer.times
        for event in sorted(policy.awaited & self.given.keys()):
            for number, guard, call in self._of_history(past, event, negated=False, leaves=certain):
                if call.end is not None:
                    at = self.past[number]
                    all_of = past[number].instant.all_of
                    done = [
                        all_of([point.event(event), *times.bounds(at, point.after, call.start, call.end)])
                        for point in past
                    ]
                    done.append(self.outer.left_out.came_about(at, event, call.start, call.end))
                    is_last = times.bounds(at, self.now, call.end, call.end)
                    yield event, all_of([guard, *is_last, *(-literal for literal in done)])

    def _unfounded(
        self, plan: Plan, happens: dict[str, int], supports: dict[str, list[tuple[str | None, int]]]
    ) -> list[list[int]]:
        """Clauses against events that happen in the model only because they bring about each other."""
        true = self.outer.true
        claimed = {event for event, literal in happens.items() if true(literal)}
        founded = {event for event in claimed if event in plan.added or true(self.given[event])}
        grew = True
        while grew:
            fresh = {
                event
                for event in claimed - founded
                if any(true(support) and (cause is None or cause in founded) for cause, support in supports[event])
            }
            founded |= fresh
            grew = bool(fresh)
        loop = claimed - founded
        outside = [self.given[event] for event in loop]
        outside += [support for event in loop for cause, support in supports[event] if cause not in loop]
        return [[-happens[event], *outside] for event in loop]

    def _gap(self, a: _Point, b: _Point, start: int | None, end: int | None) -> list[int]:
        """Literals that say together that `b` is from `start` to `end` seconds after `a`."""
        shift = a.wait - b.wait
        return self.outer.times.bounds(
            a.after, b.after, None if start is None else start + shift, None if end is None else end + shift
        )

    def _out_of_order(self, points: Sequence[_Point]) -> Iterator[int]:
        """The plan does not fit the history where two of its instants fall together, or one is not after now."""
        now = points[len(self.past)]
        ahead = points[len(self.past) + 1 :]
        for place, point in enumerate(ahead):
            yield self.outer.formula.every(self._gap(now, point, None, 0))
            for other in ahead[place + 1 :]:
                yield self.outer.formula.every(self._gap(point, other, 0, 0))

    def _broken(self, points: Sequence[_Point], policy: Policy) -> Iterator[int]:
        """For each rule and instant, a literal that implies that the rule is broken there."""
        reading = self.program.ruleset.reading
        for number, point in enumerate(points):
            for rule in self.cone.rules.values():
                for clause, guard in point.deciding(rule, reading, self.true):
                    if clause.obligations:
                        chain = lambda c, i=point.instant: i.chain(c, reading)  # noqa: E731
                        broken = self.program.responses.of(clause.obligations, chain, kept=False)
                        literal = self._fails(points, number, broken, policy)
                        if literal != -self.true:
                            yield self.outer.formula.every([guard, literal])

    def _fails(self, points: Sequence[_Point], at: int, demand: Demand, policy: Policy) -> int:
        """A literal that implies a demand of one of the points."""
        formula = self.outer.formula
        if isinstance(demand, int):
            return demand
        if isinstance(demand, Occurs):
            return self._occurs(points, at, demand, policy)
        parts = [self._fails(points, at, part, policy) for part in demand.parts]
        if isinstance(demand, Every):
            return -self.true if -self.true in parts else formula.every(parts) if parts else self.true
        parts = [part for part in parts if part != -self.true]
        return formula.any_of(parts) if parts else -self.true

    def _occurs(self, points: Sequence[_Point], at: int, what: Occurs, policy: Policy) -> int:
        formula = self.outer.formula
        there: list[list[int]] = []
        done = what.event in policy.soon or (what.event in policy.late and what.end is None)
        if done and not what.is_empty:
            there += (ways for ways in self._by_policy(points, at, what, policy) if -self.true not in ways)
        for point in points:
            event = point.event(what.event)
            bounds = self._gap(points[at], point, what.start, what.end)
            if event != -self.true and -self.true not in bounds:
                there.append([event, *(bound for bound in bounds if bound != self.true)])
        number = self.past[at] if at < len(self.past) else self.now
        unseen = self.outer.left_out.came_about(number, what.event, what.start, what.end)
        if unseen != -self.true:
            there.append([unseen])
        if not what.negated:
            return formula.any_of([formula.every(literals) for literals in there]) if there else -self.true
        never = formula.fresh()
        for literals in there:
            self.add([-never, *(-literal for literal in literals)])
        return never

    def _by_policy(self, points: Sequence[_Point], at: int, what: Occurs, policy: Policy) -> Iterator[list[int]]:
        """Literals that say together that an event is done in a window, for each way in which a policy may do it."""
        here, now = points[at], points[len(self.past)]
        end = None if what.end is None else what.end - 1
        if what.negated:
            # It is called for, and done as long as there is time left after now, and after what it waits for.
            waits = what.event in policy.waiting and what.end is not None
            yield [*self._gap(here, now, None, end), *([-self._awaits(points, at, what, policy)] if waits else [])]
        elif what.event in policy.first:
            for number, guard, call in self._of_history(points, what.event, negated=False):
                caller, opens = points[number], call.start or 0
                start = None if what.start is None else what.start - opens
                in_time = [] if call.end is None else self._gap(caller, now, None, call.end - 1)
                pending = self._pending(points, number, call)
                yield [
                    guard,
                    pending,
                    *self._gap(here, caller, start, None if what.end is None else what.end - opens),
                    *self._gap(now, caller, 1 - opens, None),
                ]
                begins = None if what.start is None else what.start - 1
                yield [
                    guard,
                    pending,
                    *in_time,
                    *self._gap(here, now, begins, end),
                    *self._gap(caller, now, opens, None),
                ]
        elif what.event in policy.last:
            for number, guard, call in self._of_history(points, what.event, negated=False):
                caller, last = points[number], call.end
                assert last is not None, "what has no end is not done at the last second"
                start, stop = (None if bound is None else bound - last for bound in (what.start, what.end))
                pending = self._pending(points, number, call)
                yield [guard, pending, *self._gap(here, caller, start, stop), *self._gap(now, caller, 1 - last, None)]
        elif what.event not in policy.waiting or what.end is None:
            begins = what.start - 1 if what.event in policy.next and what.start is not None else None
            yield self._gap(here, now, begins, end)

    @cached_property
    def _rules_out(self) -> dict[str, set[str]]:
        """The events that an event may rule out, when it occurs or later on."""
        return ruled_out(self.program, self.cone.rules.values(), self._laws)

    def _pending(self, points: Sequence[_Point], number: int, call: Occurs) -> int:
        """A literal that implies that no instant up to now has done what one of them calls for."""
        return self._occurs(points, number, call._replace(negated=True), Policy())

    def _awaits(self, points: Sequence[_Point], at: int, what: Occurs, policy: Policy) -> int:
        """A literal that implies that the history may forbid an event up to the end of a window, or longer, or call for
        what the event rules out."""
        assert what.end is not None
        over = [(number, other, [guard]) for number, guard, other in self._of_history(points, what.event, negated=True)]
        for event in sorted(self._rules_out[what.event] & policy.soon):
            for number, guard, call in self._of_history(points, event, negated=False):
                over.append((number, call, [guard, self._pending(points, number, call)]))
        ways = [
            [*literals, *self._gap(points[at], points[number], what.end - other.end, None)]
            for number, other, literals in over
            if other.end is not None
        ]
        ways = [way for way in ways if -self.true not in way]
        return self.outer.formula.any_of([self.outer.formula.every(way) for way in ways]) if ways else -self.true

    def _of_history(
        self,
        points: Sequence[_Point],
        event: str,
        negated: bool,
        leaves: Callable[[Demand], Iterator[Occurs]] = occurrences,
    ) -> Iterator[tuple[int, int, Occurs]]:
        """What may be demanded of an event by instants up to now: their numbers, and the literals of the guards."""
        reading = self.program.ruleset.reading
        for rule in self.cone.rules.values():
            if all((what.event, what.negated) != (event, negated) for what in self.program.windows(rule)):
                continue
            for number, point in enumerate(points[: len(self.past) + 1]):
                deciding = point.deciding(rule, reading, self.true)
                for (_, guard), demands in zip(deciding, self.program.demands_of_clauses(rule)):
                    for what in (what for demand in demands for what in leaves(demand)):
                        if (what.event, what.negated) == (event, negated):
                            yield number, guard, what

    def _too_late(self, points: Sequence[_Point], policy: Policy) -> Iterator[int]:
        """Literals that imply that what is called for in the next second has to wait too long."""
        now = len(self.past)
        for rule in self.cone.rules.values():
            if rule.trigger in policy.events:
                for what in self.program.windows(rule):
                    if what.event in policy.waiting and not what.negated and what.end is not None:
                        yield self._awaits(points, now, what._replace(end=what.end + 1), policy)

    def _laws_broken(self, points: Sequence[_Point], policy: Policy) -> Iterator[int]:
        """For each law and instant of now or later, a literal that implies that it is broken there; those of the past
        hold, as the history breaks nothing."""
        every, true = self.outer.formula.every, self.true

        def condition(point: _Point, formula: object) -> int:
            return true if formula is None else point.instant.literal(formula)  # type: ignore[arg-type]

        since = len(self.past)
        # What a law brings about of events outside the cone is part of what is given.
        for law in self._laws:
            for number, point in enumerate(points):
                if isinstance(law, EventRelation):
                    left, right = point.event(law.left), point.event(law.right)
                    if number < since:
                        continue
                    if law.relation == "happenBefore" and law.right in policy.events:
                        yield self._occurs(points, since, Occurs(law.left, None, 0, negated=True), Policy())
                    if law.relation == "mutualExclusive":
                        yield every([left, right])
                    elif law.relation == "happenBefore":
                        before = Occurs(law.left, None, -1, negated=True)
                        yield every([right, self._occurs(points, number, before, policy)])
                    else:
                        yield every([left, -right])
                        if law.relation == "equal":
                            yield every([right, -left])
                elif isinstance(law, Effect):
                    if number >= since:
                        occurs, holds = point.event(law.event), condition(point, law.formula)
                        broken = {
                            "causation": [holds, -occurs],
                            "includes": [occurs, -holds],
                            "forbid": [occurs, holds],
                        }
                        yield every(broken[law.relation])
                elif isinstance(law, Lasting):
                    yield from self._lasting_broken(law, points, number, condition)
                    if number <= since and law_name(law) in policy.over:
                        yield self._lasts(law, points, number, condition)
                elif isinstance(law, Exclusive):
                    if number >= since:
                        yield from (every([point.event(one), point.event(other)]) for one, other in excluding(law))
                elif isinstance(law, (Never, Assume)) and number >= since:
                    shadow = _Shadow(point)
                    holds = shadow.literal(law.formula)
                    yield -holds if isinstance(law, Assume) else holds

    def _lasting_broken(
        self, law: Lasting, points: Sequence[_Point], number: int, condition: Callable[[_Point, object], int]
    ) -> Iterator[int]:
        begins = self._begins(law, points[number], condition)
        for other in range(number, len(points)):
            point = points[other]
            broken = [*begins, point.used, -condition(point, law.formula)]
            if law.duration is not None:
                in_time = self._gap(points[number], point, 0, last_second(law.duration))
                yield self.outer.formula.every([*broken, *in_time])
                continue
            going = [*broken, *self._gap(points[number], point, 0, None)]
            ends = self._ends(law, points, number, condition)
            going += (self._not_all([*end, *self._gap(points[end_at], point, 0, None)]) for end_at, end in ends)
            yield self.outer.formula.every([*going, *self._not_unseen(law, number)])

    def _lasts(
        self, law: Lasting, points: Sequence[_Point], number: int, condition: Callable[[_Point, object], int]
    ) -> int:
        """A literal that implies that a law is in force after now, because of an instant up to now."""
        now = len(self.past)
        begins = self._begins(law, points[number], condition)
        if law.duration is not None:
            last = last_second(law.duration)
            return self.outer.formula.every([*begins, *self._gap(points[number], points[now], None, last - 1)])
        ends = self._ends(law, points[: now + 1], number, condition)
        going = [*begins, *(self._not_all(end) for _, end in ends), *self._not_unseen(law, number)]
        return self.outer.formula.every(going)

    def _begins(self, law: Lasting, point: _Point, condition: Callable[[_Point, object], int]) -> list[int]:
        return [point.event(law.event), condition(point, law.condition), point.used]

    def _ends(
        self, law: Lasting, points: Sequence[_Point], number: int, condition: Callable[[_Point, object], int]
    ) -> Iterator[tuple[int, list[int]]]:
        """Literals that say together that another of the points ends what a law demands from one of them on."""
        assert law.end is not None
        for place, point in enumerate(points):
            stops = [point.event(law.end), condition(point, law.end_condition)]
            yield place, [*stops, *self._gap(points[number], point, 0, None)]

    def _not_all(self, literals: list[int]) -> int:
        return self.outer.formula.any_of([-literal for literal in literals])

    def _not_unseen(self, law: Lasting, number: int) -> list[int]:
        """That nothing ended a law that is not one of the points."""
        return [-self.outer.left_out.came_about(self.past[number], law_name(law))] if number < len(self.past) else []


class _Shadow:
    """A formula over the events of a point of a plan."""

    def __init__(self, point: _Point) -> None:
        self._point = point

    def literal(self, formula: object) -> int:

        instant = self._point.instant
        if isinstance(formula, Atom) and formula.kind != "condition":
            return self._point.event(formula.name)
        if isinstance(formula, Not):
            return -self.literal(formula.operand)
        if isinstance(formula, And):
            return instant.all_of([self.literal(operand) for operand in formula.operands])
        if isinstance(formula, Or):
            return instant.any_of([self.literal(operand) for operand in formula.operands])
        return instant.literal(formula)  # type: ignore[arg-type]


def at_once(demand: Demand) -> Iterator[str]:
    """The events that a demand calls for at its own instant, come what may."""
    return (what.event for what in certain(demand) if not what.negated and what.start == what.end == 0)
