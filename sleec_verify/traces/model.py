"""A bounded model of a trace, which grows as far as its rules require (bounded model checking with lazy unrolling).

The rules of an event are encoded for an instant once the solver lets the event occur there. That a response is met at
an instant that does not exist yet is an assumption (a *need*). So

- if no model exists even with these assumptions, there is no trace, however long;
- a model that uses none of them is a trace, with exactly the instants that it has.

In between, an instant is added for each assumption that a model uses. Where no response leads back to its own trigger
this terminates; elsewhere the search gives up after `MOST` instants.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

from sleec_runtime.model import Clause, Obligation, Rule, Value
from sleec_runtime.model import Formula as Condition
from sleec_verify.solver import MiniSat, Undecided
from sleec_verify.traces.demands import Demand, Every, Occurs
from sleec_verify.traces.difference import Differences
from sleec_verify.traces.index import Index
from sleec_verify.traces.instant import Formula, Instant

MOST = 30
"""Instants that are added before the search gives up. Published rulesets need three."""

MOST_CYCLIC = 8
"""The same where a response can lead back to its trigger."""

MOST_CLAUSES = 20_000
"""Clauses beyond which no instant is added."""

MOST_COMPARED = 300_000
"""Pairs of instants whose times may be compared in all, summed over models: a few seconds."""


class Decided(NamedTuple):
    """Where `guard` is true, clause `number` of a rule decides at an instant and demands `due`."""

    at: int
    rule: Rule
    number: int
    clause: Clause
    guard: int
    due: Demand


@dataclass
class Need:
    """`witness` holds at some instant: one of the model, or (`rest`) one that is not there yet. `later` is the event
    that it then needs at a later time, if that is all that it needs."""

    witness: Callable[[int], int]
    rest: int
    later: str | None = None


class TraceModel:
    """The traces of a ruleset, or what follows or precedes the instant `now`.

    A node is a time; the nodes in `instants` have events and measures too.
    """

    def __init__(
        self,
        index: Index,
        rules: Mapping[str, Sequence[Rule]] | None = None,
        impossible: frozenset[str] = frozenset(),
    ) -> None:
        """`rules` replace those of the ruleset, by their triggers. `impossible` events occur in no trace."""
        self.index = index
        self.formula = Formula()
        self.add = self.formula.clauses.append
        self.times = Differences(self.formula.fresh, self.add, self.formula.true)
        self.nodes = 0
        self.instants: dict[int, Instant] = {}
        self.decided: list[Decided] = []
        self.after: int | None = None
        """The node that all instants added from now on come after."""
        self.before: int | None = None
        """The node that all instants come before: the trace is a history, and what can still be met after it is."""
        self.occurred: Callable[[str], int] = lambda event: -self.formula.true
        """For an event, the literal that it occurred before the first instant."""
        self.began: dict[str, Callable[[int], list[int]]] = {}
        """For the key of a `when … until`, or `when … for`, literals that say together that it binds at an instant
        because it began before the first one."""
        self.reading = index.ruleset.reading
        self._rules = index.by_trigger if rules is None else rules
        self._impossible = impossible
        self._most = MOST_CYCLIC if index.is_cyclic else MOST
        self._grown = 0
        self._refused = 0
        self._compared = 0
        self._conditions: dict[tuple[int, Condition], int] = {}
        self._needs: list[Need] = []
        self._everywhere: list[Callable[[int], None]] = []
        self._in_force: dict[str, int] = {}
        self._solver = MiniSat()
        self._sent = 0
        self._core: set[int] = set()
        from sleec_verify.traces.temporal import relation_at

        for relation in index.relations:
            self._everywhere.append(relation_at(self, relation))

    # Nodes and instants ---------------------------------------------------------------------------------------

    def node(self) -> int:
        """A new time, without an instant."""
        self.nodes += 1
        return self.nodes - 1

    def instant(self, used: int | None = None, at: int | None = None) -> int:
        """A new instant, which the trace has if `used`, at a new node or the node `at`; returns the node."""
        node = self.node() if at is None else at
        used = self.formula.fresh() if used is None else used
        for other, instant in self.instants.items():
            # Two instants have different times.
            at_most, less = self.times.at_most(other, node, 0), self.times.at_most(other, node, -1)
            self.add([-used, -instant.used, -at_most, less])
        self.instants[node] = Instant(self.formula, self.index.ruleset.measures, used, self._impossible)
        if self.after is not None:
            self.add([-used, self.times.before(self.after, node)])
        if self.before is not None:
            self.add([-used, self.times.before(node, self.before)])
        # The relations may add needs, which are offered this instant as they are made.
        needs = list(self._needs)
        for make in list(self._everywhere):
            make(node)
        for need in needs:
            self._offer(need, node)
        return node

    def everywhere(self, make: Callable[[int], None]) -> None:
        """Call `make` for every instant, those to come included."""
        self._everywhere.append(make)
        for node in list(self.instants):
            make(node)

    def exists(self, witness: Callable[[int], int], later: str | None = None) -> int:
        """A literal that implies that `witness` (from an instant to a literal) holds at some instant."""
        literal = self.formula.fresh()
        need = Need(witness, literal, later)
        self._needs.append(need)
        for node in list(self.instants):
            self._offer(need, node)
        return literal

    def _offer(self, need: Need, node: int) -> None:
        here = need.witness(node)
        if here != -self.formula.true:
            rest = self.formula.fresh()
            self.add([-need.rest, here, rest])
            need.rest = rest

    # Demands --------------------------------------------------------------------------------------------------

    def occurs(self, at: int, what: Occurs) -> int:
        """A literal that implies that an atom holds of the node `at`. In a history, that it is not violated yet."""
        if what.negated:
            never = self.formula.fresh()

            def exclude(other: int) -> None:
                bounds = self.times.within(at, other, what.start, what.end)
                if -self.formula.true not in bounds:
                    self.add([-never, -self.instants[other].event(what.event), *(-bound for bound in bounds)])

            self.everywhere(exclude)
            return never
        later = what.event if what.start is not None and what.start >= 0 else None
        met = self.exists(lambda other: self.occurrence(at, other, what), later)
        return met if self.before is None else self.formula.any_of([met, self.open(at, what)])

    def open(self, at: int, what: Occurs) -> int:
        """The literal "the window of an atom of node `at` ends at `before` or later"."""
        assert self.before is not None, "only what follows a history is open"
        return self.formula.true if what.end is None else self.times.at_most(at, self.before, what.end)

    def occurrence(self, at: int, other: int, what: Occurs) -> int:
        """A literal that implies that the event occurs at instant `other`, in a window around node `at`."""
        bounds = self.times.within(at, other, what.start, what.end)
        if -self.formula.true in bounds:
            return -self.formula.true
        return self.formula.every([self.instants[other].event(what.event), *bounds])

    def demand(self, at: int, demand: Demand) -> int:
        """A literal that implies a demand of node `at`."""
        if isinstance(demand, int):
            return demand
        if isinstance(demand, Occurs):
            return self.occurs(at, demand)
        parts = [self.demand(at, part) for part in demand.parts]
        return self.formula.every(parts) if isinstance(demand, Every) else self.formula.any_of(parts)

    # Rules ----------------------------------------------------------------------------------------------------

    def chain(self, at: int) -> Callable[[Clause], list[int]]:
        """The literals of the clauses of a chain that stands by itself, decided by the measures of an instant."""
        return lambda clause: self.instants[at].chain(clause, self.reading)

    def due(self, at: int, obligations: tuple[Obligation, ...], kept: bool = True) -> Demand:
        return self.index.responses.of(obligations, self.chain(at), kept)

    def guards(self, at: int, rule: Rule) -> list[tuple[Clause, int]]:
        """The clauses of a rule with the literals of their guards at an instant."""
        return list(zip(rule.clauses(), self.instants[at].guards(rule, self.reading)))

    def condition(self, at: int, condition: Condition | None) -> int:
        """The literal of a condition at an instant; the same literal whenever it is asked for."""
        if condition is None:
            return self.formula.true
        literal = self._conditions.get((at, condition))
        if literal is None:
            literal = self._conditions[at, condition] = self.instants[at].literal(condition)
        return literal

    def in_force(self, key: str) -> int:
        """The literal "this rule or relation counts"; cores name what matters by it."""
        literal = self._in_force.get(key)
        if literal is None:
            literal = self._in_force[key] = self.formula.fresh()
        return literal

    def obligations(self, clause: Clause) -> tuple[Obligation, ...]:
        """The obligations of a clause that count."""
        return clause.obligations

    def _encode(self, at: int, rule: Rule) -> None:
        for number, (clause, guard) in enumerate(self.guards(at, rule)):
            obligations = self.obligations(clause)
            if obligations:
                due = self.due(at, obligations)
                self.decided.append(Decided(at, rule, number, clause, guard, due))
                self.add([-self.in_force(rule.label), -guard, self.demand(at, due)])

    # Questions ------------------------------------------------------------------------------------------------

    def ask(self, *required: int, counting: Collection[str] | None = None) -> bool:
        """Whether there is a trace in which all these literals are true. `counting` are the labels of the rules and the
        keys of the relations that count: all, unless given.

        Raises Undecided where the solver gives up, or the trace needs more instants than are tried.
        """
        while True:
            if self._solve(required, counting, lambda need: True):
                return True
            if not any(-need.rest in self._core for need in self._needs):
                return False
            if not self._solve(required, counting, lambda need: False):
                return False
            self._grow()

    def is_possible(self, *required: int, last_of: Collection[str] = ()) -> bool:
        """Whether there is a model if every need may be met at an instant to come. The events of `last_of` do not occur
        at any later instant."""
        return self._solve(required, None, lambda need: need.later in last_of)

    def _grow(self) -> None:
        """Add an instant for each event that the model leaves to instants to come: one may serve several needs."""
        trusted = {need.later or number: need for number, need in enumerate(self._needs) if self.true(need.rest)}
        for need in trusted.values():
            if self._grown >= self._most or len(self.formula.clauses) - self._refused > MOST_CLAUSES:
                raise self._given_up()
            self._grown += 1
            self._needs.remove(need)
            rest = need.rest
            # What the new instant is for is met there, or was met at one of the others.
            self.add([-rest, need.witness(self.instant())])

    def _given_up(self) -> Undecided:
        return Undecided(f"no answer with {len(self.instants)} instants")

    def _solve(self, required: Sequence[int], counting: Collection[str] | None, closed: Callable[[Need], bool]) -> bool:
        """Solve with the rules of all events that occur in the model, and with times that can be. Needs that are
        `closed` are not left to an instant to come."""
        recorder = self.index.recorder
        while True:
            self._send()
            keys = self._in_force if counting is None else [key for key in counting if key in self._in_force]
            here = [-need.rest for need in self._needs if closed(need)]
            assumed = [*required, *(self._in_force[key] for key in keys), *here]
            answer = self._solver.solve(assumed)
            if answer is None:
                raise Undecided("the solver gave up after its budget of conflicts")
            if not answer:
                self._core = set(self._solver.core())
                if recorder is not None:
                    recorder.refuted(self.formula.clauses, list(self._core))
                return False
            if not self._expand() and not self._refine():
                if recorder is not None:
                    recorder.satisfied(self.formula.clauses, assumed, self._solver.holds)
                return True

    def _send(self) -> None:
        for instant in self.instants.values():
            instant.settle()
        self._solver.add(self.formula.clauses[self._sent :])
        self._sent = len(self.formula.clauses)

    def _expand(self) -> bool:
        """Encode the rules of the events that occur in the model; whether there are new ones."""
        found = False
        for node, instant in list(self.instants.items()):
            for name, literal in instant.events().items():
                if name not in instant.expanded and self.true(literal):
                    instant.expanded.add(name)
                    for rule in self._rules.get(name, ()):
                        found = True
                        self._encode(node, rule)
        return found

    def _refine(self) -> bool:
        """Exclude what a model says of measures and times and cannot be; False if all of it can."""
        refused = []
        for instant in self.instants.values():
            if self.true(instant.used):
                lemma = instant.measures.refused(self.true, self.index.recorder is not None)
                if lemma is not None:
                    refused.append(lemma)
        refused += self.times.refused(self.true, self.used())
        self._compared += self.times.pairs
        if self._compared > MOST_COMPARED:
            raise self._given_up()
        self.formula.clauses += refused
        self._refused += len(refused)
        return bool(refused)

    # The last answer ------------------------------------------------------------------------------------------

    @property
    def core(self) -> set[int]:
        """The assumptions that the last answer, which was no, rests on."""
        return self._core

    def matter(self) -> list[str]:
        """The rules and relations that the last answer, which was no, rests on."""
        return [key for key, literal in self._in_force.items() if literal in self._core]

    def true(self, literal: int) -> bool:
        """Whether a literal is true in the trace of the last `ask`."""
        return self._solver.holds(literal)

    def used(self) -> list[int]:
        """The nodes of the trace of the last `ask`: its instants, and the times without one."""
        return [n for n in range(self.nodes) if n not in self.instants or self.true(self.instants[n].used)]

    def values(self, at: int) -> dict[str, Value]:
        """The conditions and measures that the formula mentions, at an instant of the trace of the last `ask`."""
        instant = self.instants[at]
        found: dict[str, Value] = {
            key[1]: self.true(variable) for key, variable in instant.variables.items() if key[0] == "condition"
        }
        decoded = instant.measures.decode(self.true)
        assert not isinstance(decoded, list), "ask accepts a model only once its order has room"
        found.update(decoded)
        return found

    def events(self, at: int) -> frozenset[str]:
        """The events of an instant of the trace of the last `ask`."""
        return frozenset(name for name, literal in self.instants[at].events().items() if self.true(literal))

    def schedule(self) -> tuple[dict[int, int], dict[int, tuple[int, int]]]:
        """The earliest times of the trace of the last `ask`, and what each node waits for."""
        return self.times.schedule(self.true, self.used())
