"""Lazy unrolling: a formula over the instants of a trace, which grows as far as its rules require (bounded model
checking; A. Biere and others, "Symbolic model checking without BDDs", TACAS 1999).

A statement about an instant that does not exist yet is an assumption (a *need*). So

- if no model exists even with these assumptions, there is no trace of any length;
- a model that uses none of them is a trace, with exactly its instants.

Otherwise, an instant is added for each assumption that a model uses. This terminates if no response leads back to its
own trigger. If one does, the search gives up after `MOST_CYCLIC` instants.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Collection, Iterable, Sequence
from dataclasses import dataclass

from sleec_runtime.model import Formula as Condition
from sleec_runtime.model import Value
from sleec_verify.encoding.solver import MiniSat, Refutation, Undecided
from sleec_verify.traces.difference import Differences
from sleec_verify.traces.index import TraceIndex
from sleec_verify.traces.instant import Instant, SharedClauses
from sleec_verify.traces.trace import TraceInstant
from sleec_verify.wording.sentence import plural, sentence

MOST = 30
"""The maximal number of instants that are added. Published rulesets need three."""

MOST_CYCLIC = 12
"""The same, if a response can lead back to its trigger."""

MOST_CONFLICTS_CYCLIC = 20_000
"""The maximal number of conflicts of the solver, if a response can lead back to its trigger."""

MOST_CLAUSES = 20_000
"""The number of clauses above which no instant is added."""

MOST_COMPARED = 300_000
"""The maximal number of pairs of instants whose times are compared, summed over models: a few seconds."""


@dataclass
class Need:
    """`witness` holds at some instant: one of the model, or (`rest`) one that does not exist yet. `event` is the
    event there, if only this event and the time matter."""

    witness: Callable[[int], int]
    rest: int
    event: str | None = None


class Unrolling(ABC):
    """Instants and times, with what holds there.

    A node is a time. The nodes in `instants` also have events and measures.
    """

    def __init__(self, index: TraceIndex) -> None:
        self.index = index
        self.formula = SharedClauses()
        self.add = self.formula.clauses.append
        self.times = Differences(self.formula.fresh, self.add, self.formula.true)
        self.nodes = 0
        self.instants: dict[int, Instant] = {}
        self.after: int | None = None
        """The node that all instants added from now on come after."""
        self.before: int | None = None
        """The node that all instants come before. Then the trace is a history, and demands that can still be met
        after it hold."""
        self._most = MOST_CYCLIC if index.is_cyclic else MOST
        self._grown = 0
        self._refused = 0
        self._compared = 0
        self._conditions: dict[tuple[int, Condition], int] = {}
        self._needs: list[Need] = []
        self._everywhere: list[Callable[[int], None]] = []
        self._in_force: dict[str, int] = {}
        self._solver = MiniSat(budget=MOST_CONFLICTS_CYCLIC if index.is_cyclic else None)
        self._sent = 0
        self._core: set[int] = set()
        self.refutation: Refutation | None = None
        """Of the last question that was answered with no."""
        self._asked: tuple[Sequence[int], Collection[str] | None] = (), None

    def node(self) -> int:
        """A new time, without an instant."""
        self.nodes += 1
        return self.nodes - 1

    def instant(self, used: int | None = None, at: int | None = None, missing: frozenset[str] = frozenset()) -> int:
        """A new instant, which the trace has if `used`, at a new node or the node `at`; returns the node. Comparisons
        with the measures `missing` are false there."""
        node = self.node() if at is None else at
        used = self.formula.fresh() if used is None else used
        for other, instant in self.instants.items():
            # Two instants have different times.
            at_most, less = self.times.at_most(other, node, 0), self.times.at_most(other, node, -1)
            self.add([-used, -instant.used, -at_most, less])
        self.instants[node] = Instant(self.formula, self.index.ruleset.measures, used, missing)
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
        """Call `make` for every instant, including later ones."""
        self._everywhere.append(make)
        for node in list(self.instants):
            make(node)

    def exclude(self, literal: int, event: str, after: int | None = None) -> None:
        """If `literal`, the event occurs at no instant (after the node `after`)."""

        def exclude(at: int) -> None:
            later = [] if after is None else [-self.times.before(after, at)]
            self.add([-literal, *later, -self.instants[at].event(event)])

        self.everywhere(exclude)

    def exists(self, witness: Callable[[int], int], event: str | None = None) -> int:
        """A literal that implies that `witness` (from an instant to a literal) holds at some instant."""
        literal = self.formula.fresh()
        need = Need(witness, literal, event)
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

    def condition(self, at: int, condition: Condition | None) -> int:
        """The literal of a condition at an instant; always the same literal."""
        if condition is None:
            return self.formula.true
        literal = self._conditions.get((at, condition))
        if literal is None:
            literal = self._conditions[at, condition] = self.instants[at].literal(condition)
        return literal

    def in_force(self, key: str) -> int:
        """The literal "this rule or relation counts". Cores name the relevant ones by it."""
        literal = self._in_force.get(key)
        if literal is None:
            literal = self._in_force[key] = self.formula.fresh()
        return literal

    # Questions ------------------------------------------------------------------------------------------------

    def ask(self, *required: int, counting: Collection[str] | None = None) -> bool:
        """Whether there is a trace in which all these literals are true. `counting` are the labels of the rules and the
        keys of the relations that count, by default all.

        Raises `Undecided` if the solver gives up, or the trace needs too many instants.
        """
        self._asked = required, counting
        while True:
            if self._solve(required, counting, closed=True):
                return True
            if not any(-need.rest in self._core for need in self._needs) or not self._solve(
                required, counting, closed=False
            ):
                self.refutation = Refutation(self.formula.clauses, list(self._core))
                return False
            self._grow()

    def ask_here(self, *required: int) -> bool:
        """Whether there is a trace in which all these literals are true, without further instants."""
        return self._solve(required, None, closed=True)

    def reduce(self, spared: Iterable[int]) -> None:
        """Remove unnecessary instants and events from the trace of the last `ask`, and make the literals `spared`
        false, as far as possible."""
        required, counting = self._asked
        spare: list[int] = []
        instants = [instant.used for instant in self.instants.values()]
        events = [literal for instant in self.instants.values() for literal in instant.events().values()]
        for literal in [*instants, *spared, *events]:
            if self.true(literal) and self._solve([*required, *spare, -literal], counting, closed=True):
                spare.append(-literal)
        found = self._solve([*required, *spare], counting, closed=True)
        assert found, "the trace is left"

    def _grow(self) -> None:
        """Add an instant for each event that the model assumes at new instants; one instant may serve several needs."""
        trusted = {need.event or number: need for number, need in enumerate(self._needs) if self.true(need.rest)}
        for need in trusted.values():
            if self._grown >= self._most or len(self.formula.clauses) - self._refused > MOST_CLAUSES:
                raise self._given_up()
            self._grown += 1
            self._needs.remove(need)
            rest = need.rest
            # The needs of the new instant are met there, or at one of the others.
            node = self.instant()
            self.add([-rest, need.witness(node)])
            # Each instant of a minimal trace is there for a need, and is that of the first such need. Otherwise
            # an event could always move to the newest instant, whose own needs are not met yet.
            self.add([-self.instants[node].used, rest])

    def _given_up(self) -> Undecided:
        return Undecided(
            plural(len(self.instants), "no answer with {number} instant", "no answer with {number} instants")
        )

    def _solve(self, required: Sequence[int], counting: Collection[str] | None, closed: bool) -> bool:
        """Solve with the rules of all events that occur in the model, and with consistent times. `closed`: without
        new instants."""
        recorder = self.index.recorder
        while True:
            self._send()
            keys = self._in_force if counting is None else [key for key in counting if key in self._in_force]
            here = [-need.rest for need in self._needs] if closed else []
            assumed = [*required, *(self._in_force[key] for key in keys), *here]
            answer = self._solver.solve(assumed)
            if answer is None:
                raise Undecided(sentence("the solver reached its limit of conflicts"))
            if not answer:
                self._core = set(self._solver.core())
                return False
            if not self._expand() and not self._refine():
                if recorder is not None:
                    recorder.examine(self.formula.clauses, assumed, self._solver.holds)
                return True

    def conclude(self, what: str) -> None:
        """Record the last question that was answered with no, as one that decides. `what` is what it shows."""
        assert self.refutation is not None, "some question was answered with no"
        if self.index.recorder is not None:
            self.index.recorder.refuted(*self.refutation, what)

    def _send(self) -> None:
        for instant in self.instants.values():
            instant.settle()
        self._solver.add(self.formula.clauses[self._sent :])
        self._sent = len(self.formula.clauses)

    @abstractmethod
    def _expand(self) -> bool:
        """Encode the consequences of the events of the model. Returns whether there is anything new."""

    def _refine(self) -> bool:
        """Exclude inconsistent measures and times of a model. False if all are consistent."""
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
        """The assumptions in the core of the last answer, which was no."""
        return self._core

    def matter(self) -> list[str]:
        """The rules and relations in the core of the last answer, which was no."""
        return [key for key, literal in self._in_force.items() if literal in self._core]

    def true(self, literal: int) -> bool:
        """Whether a literal is true in the trace of the last `ask`."""
        return self._solver.holds(literal)

    def used(self) -> list[int]:
        """The nodes of the trace of the last `ask`: its instants, and the times without one."""
        return [n for n in range(self.nodes) if n not in self.instants or self.true(self.instants[n].used)]

    def values(self, at: int) -> dict[str, Value]:
        """The conditions and measures that the formula mentions, at an instant of the trace of the last `ask`."""
        return self.instants[at].values(self.true)

    def events(self, at: int) -> frozenset[str]:
        """The events of an instant of the trace of the last `ask`."""
        return frozenset(name for name, literal in self.instants[at].events().items() if self.true(literal))

    def at(self, node: int, time: int) -> TraceInstant:
        """An instant of the trace of the last `ask`, at a time in seconds."""
        return TraceInstant(time, self.events(node), self.values(node))

    def schedule(self, fixed: int | None = None) -> tuple[dict[int, int], dict[int, tuple[int, int]]]:
        """The earliest times of the trace of the last `ask`, and what each node waits for. With a node `fixed`, the
        latest ones."""
        return self.times.schedule(self.true, self.used(), fixed)
