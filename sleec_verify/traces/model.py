"""A model of a trace: its demands, rules and relations, for each instant of a lazy unrolling.

The rules of an event are encoded for an instant once the solver lets the event occur there.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple

from sleec_runtime.model import Clause, Obligation, Rule
from sleec_verify.traces.demands import Demand, Every, Occurs
from sleec_verify.traces.index import TraceIndex
from sleec_verify.traces.relation_encoding import Past, relation_at
from sleec_verify.traces.unrolling import Unrolling


class DecidedClause(NamedTuple):
    """If `guard` is true, clause `number` of a rule decides at an instant and demands `due`."""

    at: int
    rule: Rule
    number: int
    clause: Clause
    guard: int
    due: Demand


class TraceModel(Unrolling):
    """The traces of a ruleset, or the part after or before the instant `now`."""

    def __init__(self, index: TraceIndex, rules: Mapping[str, Sequence[Rule]] | None = None) -> None:
        """`rules` replace those of the ruleset, by their triggers."""
        super().__init__(index)
        self.decided: list[DecidedClause] = []
        self.past = Past(lambda event: -self.formula.true)
        self.reading = index.ruleset.reading
        self._rules = index.by_trigger if rules is None else rules
        for relation in index.relations:
            self._everywhere.append(relation_at(self, self.past, relation))

    # Demands --------------------------------------------------------------------------------------------------

    def occurs(self, at: int, what: Occurs) -> int:
        """A literal that implies that an atom holds at the node `at`. In a history: that it is not violated yet."""
        if what.negated:
            never = self.formula.fresh()

            def exclude(other: int) -> None:
                bounds = self.times.within(at, other, what.start, what.end)
                if -self.formula.true not in bounds:
                    self.add([-never, -self.instants[other].event(what.event), *(-bound for bound in bounds)])

            self.everywhere(exclude)
            return never
        event = what.event if what.start is not None and what.start >= 0 else None
        met = self.exists(lambda other: self.occurrence(at, other, what), event)
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
        """The literals of the clauses of a separate chain, decided by the measures of an instant."""
        return lambda clause: self.instants[at].chain(clause, self.reading)

    def due(self, at: int, obligations: tuple[Obligation, ...], kept: bool = True) -> Demand:
        return self.index.responses.of(obligations, self.chain(at), kept)

    def guards(self, at: int, rule: Rule) -> list[tuple[Clause, int]]:
        """The clauses of a rule with the literals of their guards at an instant."""
        return list(zip(rule.clauses(), self.instants[at].guards(rule, self.reading)))

    def obligations(self, clause: Clause) -> tuple[Obligation, ...]:
        """The obligations of a clause that count."""
        return clause.obligations

    def _encode(self, at: int, rule: Rule) -> None:
        for number, (clause, guard) in enumerate(self.guards(at, rule)):
            obligations = self.obligations(clause)
            if obligations:
                due = self.due(at, obligations)
                self.decided.append(DecidedClause(at, rule, number, clause, guard, due))
                self.add([-self.in_force(rule.label), -guard, self.demand(at, due)])

    def _expand(self) -> bool:
        """Encode the rules of the events that occur in the model. Returns whether there are new ones."""
        found = False
        for node, instant in list(self.instants.items()):
            for name, literal in instant.events().items():
                if name not in instant.expanded and self.true(literal):
                    instant.expanded.add(name)
                    for rule in self._rules.get(name, ()):
                        found = True
                        self._encode(node, rule)
        return found
