"""Conflicts of rules with windows of a few seconds, by explicit states: an oracle for the check `conflict`.

It follows the definition (docs/times.md) literally. A state is what is pending of each rule, and what the relations
remember. All states that lawful histories reach are listed, and in each every situation is looked at.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property
from itertools import chain, combinations
from typing import NamedTuple

from sleec_runtime.model import (
    Assume,
    Atom,
    Effect,
    Lasting,
    Length,
    MeasureRelation,
    Never,
    Ruleset,
    formulas_of,
    leaves,
    literals,
)
from tests.support.explicit.demands import Demand, every, forbids, met_by_silence, progress, strongest
from tests.support.explicit.rules import Events, Lastings, Meaning, Values, silence, valuations

NOTHING: Events = frozenset()


class TooLarge(Exception):
    """There are more states than the oracle looks at."""


class State(NamedTuple):
    """What is pending at the beginning of a second: the demands of each rule, one for each triggering; the relations
    that bind; the events that have occurred and that others have to follow."""

    pending: tuple[frozenset[Demand], ...]
    lastings: Lastings
    occurred: Events

    def only(self, rules: frozenset[int]) -> State:
        """What counts where only these rules do."""
        return self._replace(pending=tuple(d if r in rules else frozenset() for r, d in enumerate(self.pending)))


class Explicit:
    """A ruleset with windows of a few seconds.

    `most` is the number of states after which TooLarge is raised.
    """

    def __init__(self, ruleset: Ruleset, most: int = 30_000) -> None:
        self.ruleset = ruleset
        self.rules = ruleset.rules
        self._meaning = Meaning(ruleset)
        self._most = most
        self._alive: dict[tuple[State, frozenset[int]], bool] = {}
        self._outcomes: dict[tuple[int, Events, int], tuple[int, Demand] | None] = {}

    # The alphabet -------------------------------------------------------------------------------------------

    @cached_property
    def declared(self) -> Events:
        """The events that are declared as the environment's."""
        return frozenset(
            name
            for d in self.ruleset.statements
            if getattr(d, "agent", None) == "environment"
            for name in d.names  # type: ignore[union-attr]
        )

    @cached_property
    def required(self) -> Events:
        """The events that some rule requires and no condition names."""
        obligations = (o for rule in self.rules for c in rule.clauses() for o in literals(c))
        return frozenset(o.name for o in obligations if not o.negated).difference(*self.named)

    @cached_property
    def inputs(self) -> Events:
        return self.declared | {rule.trigger for rule in self.rules} | (frozenset[str]().union(*self.named) - self.acts)

    @cached_property
    def named(self) -> list[Events]:
        """For each rule, the events that its conditions name."""
        return [
            frozenset(a.name for f in formulas_of(r) for a in leaves(f) if isinstance(a, Atom) and a.kind == "trigger")
            for r in self.rules
        ]

    @cached_property
    def acts(self) -> Events:
        return frozenset(o.name for rule in self.rules for c in rule.clauses() for o in literals(c)) - self.declared

    @cached_property
    def assumed(self) -> Events:
        """The events that assumptions name."""
        formulas = [c.formula for c in self.ruleset.constraints if isinstance(c, Assume)]
        return frozenset(a.name for f in formulas for a in leaves(f) if isinstance(a, Atom) and a.kind == "trigger")

    @cached_property
    def events(self) -> Events:
        named: set[str] = set(self.inputs | self.acts | self.assumed)
        for constraint in self.ruleset.constraints:
            if isinstance(constraint, Never):
                named.update(
                    a.name for a in leaves(constraint.formula) if isinstance(a, Atom) and a.kind != "condition"
                )
        for statement in self.ruleset.statements:
            for field in ("left", "right", "event", "end"):
                value = getattr(statement, field, None)
                if isinstance(value, str) and value in self.ruleset.triggers | self.ruleset.obligations:
                    named.add(value)
        return frozenset(named)

    @cached_property
    def subsets(self) -> list[Events]:
        names = sorted(self.events)
        return [frozenset(c) for size in range(len(names) + 1) for c in combinations(names, size)]

    @cached_property
    def values(self) -> list[Values]:
        formulas = [formula for rule in self.rules for formula in formulas_of(rule)]
        for statement in self.ruleset.statements:
            if isinstance(statement, MeasureRelation):
                formulas += [f for f in (statement.left, statement.right) if f is not None]
            elif isinstance(statement, Effect):
                formulas.append(statement.formula)
            elif isinstance(statement, Lasting):
                formulas += [f for f in (statement.condition, statement.formula, statement.end_condition) if f]
        formulas += [c.formula for c in self.ruleset.constraints if hasattr(c, "formula")]
        return valuations(self.ruleset, formulas, list(self._lengths()))

    def _lengths(self) -> Iterator[Length]:
        """The lengths of windows and relations."""
        for rule in self.rules:
            for clause in rule.clauses():
                for obligation in literals(clause):
                    window = None if obligation.timing is None else obligation.timing.window
                    if window is not None:
                        yield from (length for length in (window.start, window.end) if length is not None)
        for statement in self.ruleset.statements:
            if isinstance(statement, Lasting) and statement.duration is not None:
                yield statement.duration

    def _outcome(self, rule: int, events: Events, values: int) -> tuple[int, Demand] | None:
        """The clause of a rule that decides where its trigger occurs with these events and values, and what it
        demands."""
        key = (rule, events & self.named[rule], values)
        if key not in self._outcomes:
            found = self._meaning.deciding(self.rules[rule], key[1], self.values[values])
            self._outcomes[key] = (
                None if found is None else (found[0], self._meaning.demand(found[1], key[1], self.values[values]))
            )
        return self._outcomes[key]

    # One second -----------------------------------------------------------------------------------------------

    @property
    def first(self) -> State:
        return State(tuple(frozenset[Demand]() for _ in self.rules), frozenset(), frozenset())

    def before(self, events: Events) -> State:
        """The first state, where what has to precede `events` has occurred."""
        preceding = frozenset(p.left for p in self._meaning.precedences if p.right in events)
        return self.first._replace(occurred=preceding)

    def after_silence(self, state: State) -> State:
        pending = tuple(strongest({progress(d, NOTHING) for d in demands} - {True}) for demands in state.pending)
        return State(pending, silence(state.lastings), state.occurred)

    def after(self, state: State, events: Events, values: int, rules: frozenset[int]) -> State | None:
        """The state after a second with an instant, where the rules of `rules` count. None if relations are broken."""
        if not self._meaning.invariant(events, self.values[values]):
            return None
        if any(p.right in events and p.left not in state.occurred for p in self._meaning.precedences):
            return None
        lastings = self._meaning.lasting(state.lastings, events, self.values[values])
        if lastings is None:
            return None
        pending = []
        for number, demands in enumerate(state.pending):
            new = set(demands)
            if number in rules and self.rules[number].trigger in events:
                outcome = self._outcome(number, events, values)
                if outcome is not None:
                    new.add(outcome[1])
            pending.append(strongest({progress(d, events) for d in new} - {True}))
        remembered = {p.left for p in self._meaning.precedences}
        return State(tuple(pending), lastings, state.occurred | (events & remembered))

    # Continuations --------------------------------------------------------------------------------------------

    def alive(self, state: State, rules: frozenset[int]) -> bool:
        """Whether some continuation meets all that is pending of `rules`, and keeps the relations."""
        state = self._joined(state.only(rules))
        key = (state, rules)
        if key not in self._alive:
            self._explore(state, rules)
        return self._alive[key]

    @staticmethod
    def _joined(state: State) -> State:
        """All that is pending as one demand of the first rule: whose it is does not matter to continuations."""
        demand = every(chain.from_iterable(state.pending))
        return State((frozenset((demand,)),), state.lastings, state.occurred)

    def _explore(self, first: State, rules: frozenset[int]) -> None:
        seen: dict[State, list[State]] = {first: []}
        open_states = [first]
        goal = None
        while open_states and goal is None:
            state = open_states.pop()
            (demand,) = state.pending[0]
            if demand is False or self._alive.get((state, rules)) is False:
                continue
            if met_by_silence(demand) or self._alive.get((state, rules)):
                goal = state
                break
            for after in self._successors(state, demand, rules):
                if after in seen:
                    seen[after].append(state)
                else:
                    seen[after] = [state]
                    open_states.append(after)
                    if len(seen) > self._most:
                        raise TooLarge
        if goal is None:
            self._alive.update(((state, rules), False) for state in seen)
            return
        stack, alive = [goal], set()
        while stack:
            state = stack.pop()
            if state not in alive:
                alive.add(state)
                stack += seen[state]
        self._alive.update(((state, rules), True) for state in alive)

    def _successors(self, state: State, demand: Demand, rules: frozenset[int]) -> Iterator[State]:
        whole = State(
            tuple(frozenset((demand,)) if n == 0 else frozenset[Demand]() for n in range(len(self.rules))),
            state.lastings,
            state.occurred,
        )
        for events in reversed(self.subsets):
            if not events:
                continue
            for values in range(len(self.values)):
                after = self.after(whole, events, values, rules)
                if after is not None:
                    yield self._joined(after)
        yield self._joined(self.after_silence(whole))

    # Histories ------------------------------------------------------------------------------------------------

    @cached_property
    def reachable(self) -> list[State]:
        """The states that lawful histories end in: no rule is violated so far, each triggering by itself."""
        all_rules = frozenset(range(len(self.rules)))
        seen = {self.first}
        open_states = [self.first]
        while open_states:
            state = open_states.pop()
            following = [self.after_silence(state)]
            following += [
                after
                for events in self.subsets
                if events
                for values in range(len(self.values))
                if (after := self.after(state, events, values, all_rules)) is not None
            ]
            for after in following:
                if after not in seen and not any(False in demands for demands in after.pending):
                    seen.add(after)
                    open_states.append(after)
                    if len(seen) > self._most:
                        raise TooLarge
        return list(seen)

    # Conflicts ------------------------------------------------------------------------------------------------

    def conflicts(self) -> set[frozenset[str]]:
        """The sets of rules that are in conflict in some situation."""
        found: set[frozenset[int]] = set()
        for state in self.reachable:
            for events in self.subsets:
                if events and events <= self.inputs:
                    for values in range(len(self.values)):
                        found |= self.minimal(state, events, values)
        return {frozenset(self.rules[number].label for number in rules) for rules in found}

    def minimal(self, state: State, events: Events, values: int) -> set[frozenset[int]]:
        """The minimal sets of rules without a complying response in one situation, of those that it is one for."""
        speaking = [
            n
            for n, rule in enumerate(self.rules)
            if rule.trigger in events and self._outcome(n, events, values) is not None
        ]
        if not speaking or not self.complies(state, events, values, frozenset()):
            return set()
        numbers = range(len(self.rules))
        stuck: list[frozenset[int]] = []
        for size in range(1, len(self.rules) + 1):
            for chosen in map(frozenset, combinations(numbers, size)):
                if not any(smaller <= chosen for smaller in stuck) and not self.complies(state, events, values, chosen):
                    stuck.append(chosen)
        return {rules for rules in stuck if self._is_situation(rules, state, events, speaking)}

    def _is_situation(self, rules: frozenset[int], state: State, events: Events, speaking: list[int]) -> bool:
        triggers = {self.rules[number].trigger for number in rules}
        concerned = triggers.union(self.assumed, *(self.named[number] for number in rules))
        if not events <= concerned or rules.isdisjoint(speaking):
            return False
        return not any(forbids(demand, events) for number in rules for demand in state.pending[number])

    def complies(self, state: State, events: Events, values: int, rules: frozenset[int]) -> bool:
        """Whether the robot has a response to `events` that complies with `rules`."""
        for response in self.subsets:
            if response >= events and not (response - events) & (self.inputs - self.acts - self.required):
                after = self.after(state.only(rules), response, values, rules)
                if after is not None and self.alive(after, rules):
                    return True
        return False
