"""Pending demands: what a history can leave to be met.

For a response with a single window that opens at its trigger, one pending demand is enough. The earliest deadline
implies all later ones, and the latest end of a prohibition implies all earlier ones (dominance, proved in Coq:
proofs/traces).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cached_property

from sleec_runtime.model import Obligation, Rule
from sleec_verify.traces.demands import Demand, Every, Occurs, occurrences
from sleec_verify.traces.index import TraceIndex
from sleec_verify.traces.trivial_responses import contested_obligations


@dataclass(frozen=True, eq=False)
class Pending:
    """What a history can leave pending: the `demand` of a response of clause `number` of a rule, if the chains of
    hedges inside the response decide as in one of `choices`."""

    rule: Rule
    number: int
    obligation: Obligation
    demand: Demand
    choices: tuple[tuple[int, ...], ...]

    @cached_property
    def atoms(self) -> list[Occurs]:
        return list(dict.fromkeys(occurrences(self.demand)))

    @property
    def can_last(self) -> bool:
        """Whether it can be pending at the next instant."""
        return any(atom.end is None or atom.end > 0 for atom in self.atoms)

    @property
    def last(self) -> int | None:
        """The last second of its windows; None if one is unbounded."""
        ends = [atom.end for atom in self.atoms]
        return None if None in ends else max(end for end in ends if end is not None)

    @property
    def is_dominant(self) -> bool:
        """Whether one triggering implies all others."""
        return isinstance(self.demand, Occurs) and (self.demand.start is None or self.demand.start <= 1)

    @property
    def is_single(self) -> bool:
        """Whether one triggering implies all others, or there is no time for another one."""
        return self.is_dominant or self.last == 1


@dataclass(frozen=True, eq=False)
class Slot:
    """A pending demand of a situation, triggered at the time `node`.

    `came` says for atoms of the demand whether the event occurred in their windows before now.
    """

    pending: Pending
    node: int
    active: int
    came: dict[Occurs, int] = field(default_factory=dict)

    @property
    def rule(self) -> Rule:
        return self.pending.rule

    @property
    def demand(self) -> Demand:
        return self.pending.demand


def pending_of(index: TraceIndex) -> Iterator[Pending]:
    """Everything that a history can leave pending. Raises `Undecided` if the length of a window is a measure."""
    return (one for one in _demands(index) if one.can_last)


def _demands(index: TraceIndex) -> Iterator[Pending]:
    for rule in index.ruleset.rules:
        for number, clause in enumerate(rule.clauses()):
            for obligation in contested_obligations(index, clause):
                for demand, choices in index.responses.variants(obligation):
                    yield Pending(rule, number, obligation, demand, tuple(choices))


def alternatives(demand: Demand) -> Iterator[Occurs]:
    """The atoms each of which meets a demand by itself."""
    if isinstance(demand, Occurs):
        yield demand
    elif not isinstance(demand, (int, Every)):
        for part in demand.parts:
            yield from alternatives(part)


def most_prohibitions(index: TraceIndex) -> int:
    """The maximal number of prohibitions of one response."""
    return max((sum(atom.negated for atom in occurrences(one.demand)) for one in _demands(index)), default=0)
