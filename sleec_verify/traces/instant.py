"""One instant of a trace as a copy of the propositional encoding: its events, its conditions, its measures."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from sleec_runtime.model import Clause, Measure, Reading, Value
from sleec_verify.encoding.cnf import Encoder, Key


class SharedClauses:
    """The clauses that the instants of one trace share, and the numbers of its variables."""

    def __init__(self) -> None:
        self.clauses: list[list[int]] = []
        self.top = 0
        self.true = self.fresh()
        self.clauses.append([self.true])

    def fresh(self) -> int:
        self.top += 1
        return self.top

    def any_of(self, literals: list[int]) -> int:
        """A literal that implies that one of these is true."""
        literals = [literal for literal in literals if literal != -self.true]
        if self.true in literals:
            return self.true
        if len(literals) <= 1:
            return literals[0] if literals else -self.true
        some = self.fresh()
        self.clauses.append([-some, *literals])
        return some

    def every(self, literals: list[int]) -> int:
        """A literal that implies all of these."""
        literals = [literal for literal in literals if literal != self.true]
        if -self.true in literals:
            return -self.true
        if len(literals) <= 1:
            return literals[0] if literals else self.true
        every = self.fresh()
        self.clauses += ([-every, literal] for literal in literals)
        return every


class Instant(Encoder):
    """An encoder in which triggers and obligations are the same: the events of this instant.

    `used` says whether the trace has this instant.
    """

    def __init__(
        self,
        formula: SharedClauses,
        measures: Mapping[str, Measure],
        used: int,
        missing: frozenset[str] = frozenset(),
    ) -> None:
        self._formula = formula
        super().__init__(measures, missing, formula.clauses)
        self._true = formula.true
        self.used = used
        self.expanded: set[str] = set()
        self._regions = 0
        self._chains: dict[int, tuple[Clause, list[int]]] = {}

    def fresh(self) -> int:
        return self._formula.fresh()

    def event(self, name: str) -> int:
        """The literal "the event occurs at this instant"; the trace then has the instant."""
        return self.variable(("event", name))

    def chain(self, clause: Clause, reading: Reading) -> list[int]:
        known = self._chains.get(id(clause))
        if known is None or known[0] is not clause:
            known = self._chains[id(clause)] = clause, super().chain(clause, reading)
        return known[1]

    def variable(self, key: Key) -> int:
        if key[0] in ("trigger", "obligation"):
            key = ("event", key[1])
        variable = self.variables.get(key)
        if variable is None:
            variable = super().variable(key)
            if key[0] == "event":
                self.clauses.append([-variable, self.used])
        return variable

    def events(self) -> dict[str, int]:
        """The events that the formula mentions, with their literals."""
        return {key[1]: variable for key, variable in self.variables.items() if key[0] == "event"}

    def state(self) -> dict[Key, int]:
        """The variables of conditions and measures, by what they stand for."""
        return {key: variable for key, variable in self.variables.items() if key[0] != "event"}

    def values(self, true: Callable[[int], bool]) -> dict[str, Value]:
        """The conditions and measures that the formula mentions, in a model, in the order of their names."""
        found: dict[str, Value] = {key[1]: true(v) for key, v in self.variables.items() if key[0] == "condition"}
        decoded = self.measures.decode(true)
        assert not isinstance(decoded, list), "a model is accepted only once its order has room"
        found.update(decoded)
        return dict(sorted(found.items()))

    def settle(self) -> None:
        """Order the regions of the measures that the formula has mentioned since the last call."""
        if self._count() != self._regions:
            self.measures.close()
            self._regions = self._count()

    def _count(self) -> int:
        return sum(map(len, self.measures.cuts.values())) + len(self.measures.orders)
