"""The plays of a ruleset, as a circuit.

The environment acts at a bounded number of instants. Each time it chooses the time, the events and the measures. The
robot then chooses what it does at once and a plan for later. If the plan violates a rule, the robot has lost. The next
act of the environment may come at any time. The plan is executed up to this time, and the robot plans the rest again.

In a plan, only the robot acts, and it chooses the measures. An environment that wants other measures acts.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence

from sleec_runtime.model import (
    EventRelation,
    Lasting,
    Rule,
)
from sleec_verify.encoding.relations import Relation, at_one_instant, events_of, formulas_of_relation
from sleec_verify.encoding.trace_scope import named_atoms
from sleec_verify.games.circuit import FALSE, TRUE, Circuit
from sleec_verify.games.decomposition import GamePart
from sleec_verify.games.players import is_environments
from sleec_verify.games.time_grid import TimeGrid
from sleec_verify.games.values import Scales, Values
from sleec_verify.results.strategy import Act
from sleec_verify.traces.demands import Demand, Every, Occurs, seconds
from sleec_verify.traces.index import TraceIndex


class _Instant:
    """One instant: its slot in the time grid, its events, its measures."""

    def __init__(
        self,
        circuit: Circuit,
        grid: TimeGrid,
        scales: Scales,
        events: Iterable[str],
        always: Iterable[str],
        earlier: int,
    ) -> None:
        """`events` may occur, and `always` occur. `earlier` is the maximal number of instants before this one."""
        self.events = {**{name: circuit.variable() for name in events}, **dict.fromkeys(always, TRUE)}
        self._grid = grid
        # The first true variable is the slot; none of them, the last one. So every assignment is a time.
        self._raw = circuit.variables(grid.reach(earlier))
        so_far, self.at_most = FALSE, []
        for variable in self._raw:
            so_far = circuit.either(so_far, variable)
            self.at_most.append(so_far)
        self.at_most += [TRUE] * (len(grid) - len(self._raw))
        self.values = Values(circuit, scales, lambda name: self.events.get(name, FALSE))

    def up_to(self, count: int) -> int:
        """The literal "it is one of the first `count` slots"."""
        return self.at_most[count - 1] if count > 0 else FALSE

    @property
    def variables(self) -> list[int]:
        return [*self._raw, *(event for event in self.events.values() if event != TRUE), *self.values.variables]

    def times(self) -> Iterator[dict[int, int]]:
        """The slots as values of variables, only for sums of lengths."""
        for time in self._grid.wholes:
            slot = self._grid.up_to(time) - 1
            if slot >= len(self._raw):
                return
            yield {variable: 1 if number == slot else -1 for number, variable in enumerate(self._raw)}

    def act(self, move: Mapping[int, int]) -> Act:
        slot = next((i for i, variable in enumerate(self._raw) if move[variable] > 0), len(self._raw))
        events = (name for name, event in self.events.items() if event == TRUE or move[event] > 0)
        values = dict(sorted(self.values.decoded(move).items()))
        return Act(self._grid.times[slot], tuple(sorted(events)), values)


_Course = Sequence[tuple[_Instant, int]]
"""Instants, each with the literal "the trace has this instant"."""


class Play:
    """The plays of a part of a ruleset with `steps` acts of the environment and plans of up to `spare` instants.

    `turns` are the variables of the environment and the robot, alternately. The environment wins a play if `lost` is
    true.
    """

    def __init__(
        self,
        index: TraceIndex,
        part: GamePart,
        steps: int,
        spare: int,
        never: frozenset[str] = frozenset(),
        eager: bool = True,
        pressed: Iterable[str] = (),
    ) -> None:
        """The robot never does events of `never`. In an `eager` play, the environment lets everything occur that only
        adds demands on the robot, which does not change the winner. With its first act, it also chooses which events of
        `pressed` are forbidden then, as if by earlier prohibitions.

        Raises `Undecided` for constructs that games do not support.
        """
        self.circuit = circuit = Circuit()
        self._index = index
        self._laws = part.laws
        self._events = frozenset(part.events)
        self._rules = part.rules
        self._reading = index.ruleset.reading
        formulas = [formula for rule in part.rules for formula in index.formulas(rule)]
        formulas += [formula for law in part.laws for formula in formulas_of_relation(law)]
        scales = Scales(index.ruleset.measures, formulas)
        self.grid = TimeGrid(lengths(part), steps * (1 + spare), (1 + spare) * 2 ** (steps - 1))
        tied = {name for law in part.laws for name in events_of(law)}
        tied |= {name for rule in part.rules for name in named_atoms(rule)}
        answers = {w.event for rule in part.rules for w in part.windows[rule.label]}
        called_for = {w.event for rule in part.rules for w in part.windows[rule.label] if not w.negated}
        # The robot does only what some rule requires.
        robots = [
            name for name in part.events if index.agents.get(name) == "system" and name in (called_for | tied) - never
        ]
        others = [name for name in part.events if index.agents.get(name) != "system"]
        always = [name for name in others if eager and name not in tied | answers]
        self._robots = frozenset(robots)
        mine = sorted({*robots, *others} - {*always})
        self._steps: list[_Instant] = []
        self._plans: list[list[_Instant]] = []
        for step in range(steps):
            earlier = step * (1 + spare)
            self._steps.append(_Instant(circuit, self.grid, scales, mine, always, earlier))
            plan = [_Instant(circuit, self.grid, scales, robots, (), earlier + n + 1) for n in range(spare)]
            self._plans.append(plan)
        self._pressed = {name: circuit.variable() for name in pressed}
        self._planned = [[circuit.variable() for _ in plan] for plan in self._plans]
        self._gaps: dict[tuple[int, int, int], int] = {}
        self._instants = [*self._steps, *(instant for plan in self._plans for instant in plan)]
        self._number = {id(instant): number for number, instant in enumerate(self._instants)}
        self.turns = [turn for step in range(steps) for turn in (self._environments(step), self._robot(step))]
        self.kept = self._kept()
        """For each act of the environment: the robot's answer satisfies everything, or the environment has violated its
        relations."""
        self.lost = -circuit.every(self.kept)

    # Turns ----------------------------------------------------------------------------------------------------

    def _environments(self, step: int) -> list[int]:
        instant = self._steps[step]
        own = set(self.doing(step).values())
        pressed = self._pressed.values() if step == 0 else ()
        return [*pressed, *(variable for variable in instant.variables if variable not in own)]

    def _robot(self, step: int) -> list[int]:
        return [
            *self.doing(step).values(),
            *self._planned[step],
            *(v for instant in self._plans[step] for v in instant.variables),
        ]

    def act(self, step: int, move: Mapping[int, int]) -> Act:
        """An act of the environment, with what the robot does at once if the move contains it."""
        known = {variable: move.get(variable, -1) for variable in self._steps[step].variables}
        return self._steps[step].act(known)

    def plan(self, step: int, move: Mapping[int, int]) -> list[Act]:
        """The later instants of a move of the robot."""
        return [
            instant.act(move) for instant, planned in zip(self._plans[step], self._planned[step]) if move[planned] > 0
        ]

    def wishes(self, step: int) -> Iterator[dict[int, int]]:
        """Preferences for a simple act of the environment, each as values of variables: an early time, events that do
        not occur, conditions that do not hold."""
        instant = self._steps[step]
        yield from instant.times()
        events = ((name, event) for name, event in instant.events.items() if event != TRUE)
        yield from ({event: -1} for name, event in events if name not in self._robots)
        yield from ({variable: -1} for variable in instant.values.conditions.values())

    def doing(self, step: int) -> dict[str, int]:
        """The variables of the robot's immediate actions after an act of the environment."""
        return {name: self._steps[step].events[name] for name in sorted(self._robots)}

    # Winning --------------------------------------------------------------------------------------------------

    def _kept(self) -> list[int]:
        behind: list[tuple[_Instant, int]] = []
        lawful = TRUE
        goals = []
        for number, step in enumerate(self._steps):
            if number > 0:
                later = self._later(self._steps[number - 1], step)
                before = [
                    (instant, self.circuit.both(planned, self._later(instant, step)))
                    for instant, planned in zip(self._plans[number - 1], self._planned[number - 1])
                ]
                behind = [*behind, *before]
                lawful = self.circuit.both(lawful, later)
            behind = [*behind, (step, TRUE)]
            lawful = self.circuit.both(lawful, self._lawful(behind))
            ahead = list(zip(self._plans[number], self._planned[number]))
            order = []
            last, there = step, TRUE
            for instant, planned in ahead:
                order.append(self.circuit.implies(planned, self.circuit.both(there, self._later(last, instant))))
                last, there = instant, planned
            goals.append(self.circuit.implies(lawful, self.circuit.every([*order, self._holds([*behind, *ahead])])))
        return goals

    def _lawful(self, course: _Course) -> int:
        """The environment has satisfied its relations."""
        laws = [law for law in self._laws if is_environments(law, self._index.agents)]
        return self.circuit.every(
            self._lasting(law, *course[number], course, later=law.event in self._robots)
            if isinstance(law, Lasting)
            else self._law(law, number, course)
            for law in laws
            for number in range(len(course))
        )

    def _holds(self, course: _Course) -> int:
        """A complete trace satisfies everything."""
        rules = (self._rule(rule, number, course) for rule in self._rules for number in range(len(course)))
        laws = (self._law(law, number, course) for law in self._laws for number in range(len(course)))
        now = self._steps[0].events
        pressed = (-self.circuit.both(must_not, now.get(name, FALSE)) for name, must_not in self._pressed.items())
        return self.circuit.every([*rules, *laws, *pressed])

    # Times ----------------------------------------------------------------------------------------------------

    def _at_most(self, a: _Instant, b: _Instant, length: int) -> int:
        """The literal "the time of `b` minus that of `a` is at most `length`". O(slots)."""
        key = (self._number[id(a)], self._number[id(b)], length)
        found = self._gaps.get(key)
        if found is None:
            grid = self.grid
            found = self._gaps[key] = self.circuit.every(
                self.circuit.either(-a.up_to(slot + 1), b.up_to(grid.up_to(time + length)))
                for slot, time in enumerate(grid.times)
            )
        return found

    def _later(self, a: _Instant, b: _Instant) -> int:
        return -self._at_most(a, b, 0)

    def _between(self, a: _Instant, b: _Instant, start: int | None, end: int | None) -> int:
        """The time of `b` is from `start` to `end` seconds after that of `a`, both included."""
        if a is b:
            inside = (start is None or start <= 0) and (end is None or end >= 0)
            return TRUE if inside else FALSE
        bounds = [] if end is None else [self._at_most(a, b, end)]
        if start is not None:
            bounds.append(-self._at_most(a, b, start - 1))
        return self.circuit.every(bounds)

    # Satisfaction ----------------------------------------------------------------------------------------------

    def _rule(self, rule: Rule, number: int, course: _Course) -> int:
        instant, there = course[number]
        trigger = self.circuit.both(there, instant.events.get(rule.trigger, FALSE))
        if trigger == FALSE:
            return TRUE
        kept = []
        for clause, decides in zip(rule.clauses(), instant.values.guards(rule, trigger, self._reading)):
            if clause.obligations:
                demand = self._index.responses.of(
                    clause.obligations, lambda chain: instant.values.chain(chain, self._reading)
                )
                kept.append(self.circuit.implies(decides, self._demand(demand, instant, course)))
        return self.circuit.every(kept)

    def _demand(self, demand: Demand, instant: _Instant, course: _Course) -> int:
        if isinstance(demand, int):
            return demand
        if isinstance(demand, Occurs):
            if demand.event not in self._events:
                # The robot can always do it.
                return TRUE
            found = self._occurs(demand, instant, course)
            return -found if demand.negated else found
        parts = (self._demand(part, instant, course) for part in demand.parts)
        return self.circuit.every(parts) if isinstance(demand, Every) else self.circuit.some(parts)

    def _occurs(self, what: Occurs, instant: _Instant, course: _Course) -> int:
        """An event occurs in a window around an instant."""
        return self.circuit.some(
            self.circuit.every(
                [there, other.events.get(what.event, FALSE), self._between(instant, other, what.start, what.end)]
            )
            for other, there in course
            if what.event in other.events
        )

    def _law(self, law: Relation, number: int, course: _Course) -> int:
        """A relation holds as far as it concerns one instant."""
        circuit = self.circuit
        instant, there = course[number]
        if isinstance(law, Lasting):
            return self._lasting(law, instant, there, course)
        if isinstance(law, EventRelation) and law.relation == "happenBefore":
            occurred = self._occurs(Occurs(law.left, None, -1), instant, course)
            kept = circuit.implies(instant.events.get(law.right, FALSE), occurred)
        else:
            kept = circuit.every(circuit.some(map(instant.values.literal, part)) for part in at_one_instant(law))
        return circuit.implies(there, kept)

    def _lasting(self, law: Lasting, instant: _Instant, there: int, course: _Course, later: bool = False) -> int:
        """`later`: only after that instant. If the robot starts it although the condition does not hold, the robot
        violates it."""
        circuit = self.circuit
        begins = circuit.every([there, instant.events.get(law.event, FALSE), instant.values.literal(law.condition)])
        if begins == FALSE:
            return TRUE
        last = None if law.duration is None else int(-(-seconds(law.duration) // 1)) - 1

        def over(other: _Instant) -> int:
            if law.end is None:
                return FALSE
            end = law.end
            return circuit.some(
                circuit.every(
                    [
                        there,
                        middle.events.get(end, FALSE),
                        middle.values.literal(law.end_condition),
                        self._between(instant, middle, 0, None),
                        self._between(middle, other, 0, None),
                    ]
                )
                for middle, there in course
            )

        kept = [
            circuit.implies(
                circuit.both(there, self._between(instant, other, 0, last)),
                circuit.either(other.values.literal(law.formula), over(other)),
            )
            for other, there in course
            if not (later and other is instant)
        ]
        return circuit.implies(begins, circuit.every(kept))


def lengths(part: GamePart) -> set[int]:
    """The lengths, in seconds, with which differences of times are compared. Raises `Undecided` if the length of a
    window has no bounds."""
    found = {
        bound
        for rule in part.rules
        for occurrence in part.windows[rule.label]
        for bound in (occurrence.start, occurrence.end)
        if bound is not None
    }
    found.update(int(seconds(law.duration)) for law in part.laws if isinstance(law, Lasting) and law.duration)
    return found
