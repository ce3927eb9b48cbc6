"""One instant of a trace as a copy of the propositional encoding: its events, its conditions, its measures."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from sleec_runtime.model import Measure, Value
from sleec_verify.cnf import Encoder, Key


class Formula:
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
        if len(literals) == 1:
            return literals[0]
        some = self.fresh()
        self.clauses.append([-some, *literals])
        return some

    def every(self, literals: list[int]) -> int:
        """A literal that implies all of these."""
        if len(literals) == 1:
            return literals[0]
        every = self.fresh()
        self.clauses += ([-every, literal] for literal in literals)
        return every


@dataclass(frozen=True)
class Fixed:
    """What is already settled of an instant: its time, its events (None: more may occur than `events`), and values of
    conditions and measures; those that are not named are open."""

    time: int
    events: frozenset[str]
    conditions: Mapping[str, Value]
    complete: bool = True


class Instant(Encoder):
    """An encoder whose triggers and obligations are one kind of thing: the events of this instant."""

    def __init__(
        self,
        formula: Formula,
        measures: Mapping[str, Measure],
        used: int,
        fixed: Fixed | None = None,
        impossible: frozenset[str] = frozenset(),
    ) -> None:
        self._formula = formula
        self._true = formula.true
        super().__init__(measures, clauses=formula.clauses)
        self._true = formula.true
        self.used = used
        self.fixed = fixed
        self._impossible = impossible
        self.expanded: set[str] = set()
        self._closed = 0
        for name in sorted(fixed.events) if fixed is not None else ():
            self.event(name)

    def fresh(self) -> int:
        return self._formula.fresh()

    def event(self, name: str) -> int:
        """The literal "the event occurs at this instant", which makes it an instant of the trace."""
        return self.variable(("event", name))

    def variable(self, key: Key) -> int:
        if key[0] in ("trigger", "obligation"):
            key = ("event", key[1])
        variable = self.variables.get(key)
        if variable is not None:
            return variable
        variable = super().variable(key)
        if key[0] == "event":
            self.clauses.append([-variable, self.used])
            if key[1] in self._impossible:
                self.clauses.append([-variable])
            if self.fixed is not None:
                if key[1] in self.fixed.events:
                    self.clauses.append([variable])
                elif self.fixed.complete:
                    self.clauses.append([-variable])
        elif key[0] == "condition" and self.fixed is not None and key[1] in self.fixed.conditions:
            self.clauses.append([variable if self.fixed.conditions[key[1]] is True else -variable])
        return variable

    def events(self) -> dict[str, int]:
        """The events that anything speaks of, with their literals."""
        return {key[1]: variable for key, variable in self.variables.items() if key[0] == "event"}

    def settle(self) -> None:
        """Order the regions of measures that have come up since this was last called."""
        regions = sum(map(len, self.measures.cuts.values())) + len(self.measures.orders)
        if regions == self._closed:
            return
        self._closed = regions
        self.measures.close()
        # Closing may have made cuts of its own.
        self._closed = sum(map(len, self.measures.cuts.values())) + len(self.measures.orders)
        if self.fixed is not None:
            values = {n: v for n, v in self.fixed.conditions.items() if not isinstance(v, bool)}
            self.clauses += ([literal] for literal in self.measures.assumptions(values))
