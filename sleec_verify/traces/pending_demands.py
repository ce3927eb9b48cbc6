"""Pending demands: what a history can leave to be met.

For a response with a single window that opens at its trigger, one pending demand is enough. The earliest deadline
implies all later ones, and the latest end of a prohibition implies all earlier ones (dominance, proved in Coq:
proofs/traces).
"""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Iterator
from dataclasses import dataclass, field
from functools import cached_property
from typing import NamedTuple

from sleec_runtime.model import Obligation, Rule
from sleec_verify.traces.demands import Demand, Every, Occurs, occurrences
from sleec_verify.traces.index import TraceIndex
from sleec_verify.traces.trivial_responses import contested_obligations


class Choice(NamedTuple):
    """Which clause of each chain inside a response decides. The demand is then that of a trigger `shift` seconds
    earlier."""

    clauses: tuple[int, ...]
    shift: int


@dataclass(frozen=True, eq=False)
class Pending:
    """What a history can leave pending: the `demand` of a response of clause `number` of a rule, if the chains inside
    the response decide as in one of `choices`.

    Some choices have the same demand, but counted from an earlier time: "X within 2 minutes" is pending in the same way
    as "X within 5 minutes" of a trigger 3 minutes earlier.
    """

    rule: Rule
    number: int
    obligation: Obligation
    demand: Demand
    choices: tuple[Choice, ...]

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
    """Everything that a history can leave pending. Raises `Undecided` if the length of a window has no bounds."""
    return (one for one in _demands(index) if one.can_last)


def _demands(index: TraceIndex) -> Iterator[Pending]:
    for rule in index.ruleset.rules:
        for number, clause in enumerate(rule.clauses()):
            for obligation in contested_obligations(index, clause):
                for demand, choices in _shifted(index.responses.variants(obligation)):
                    yield Pending(rule, number, obligation, demand, tuple(choices))


def _shifted(variants: Iterable[tuple[Demand, list[tuple[int, ...]]]]) -> Iterator[tuple[Demand, list[Choice]]]:
    """The demands that no shift makes equal, each with the choices that lead to it."""
    groups: dict[Hashable, list[tuple[Demand, list[tuple[int, ...]]]]] = {}
    for demand, choices in variants:
        groups.setdefault(from_last_end(demand), []).append((demand, choices))
    for group in groups.values():
        latest, _ = max(group, key=lambda one: last_end(one[0]))
        yield (
            latest,
            [Choice(c, last_end(latest) - last_end(demand)) for demand, choices in group for c in choices],
        )


def is_open(atom: Occurs) -> bool:
    """Whether the window of an atom is open at every instant after its trigger, up to its end."""
    return atom.start is None or atom.start <= 1


def last_end(demand: Demand) -> int:
    """The last second of the bounded windows of a demand; 0 if there are none."""
    return max((atom.end for atom in occurrences(demand) if atom.end is not None), default=0)


def from_last_end(demand: Demand) -> Hashable:
    """The demand with all times counted from its last end, as a value to compare. Windows that are open begin at the
    trigger, so their begin is not counted from the end, and they never equal a window that opens later."""
    return _counted_from(demand, last_end(demand))


def _counted_from(demand: Demand, origin: int) -> Hashable:
    if isinstance(demand, Occurs):
        start = demand.start if demand.start is None or is_open(demand) else demand.start - origin
        counted = demand._replace(start=start, end=None if demand.end is None else demand.end - origin)
        return counted, is_open(demand)
    assert not isinstance(demand, int), "slots have no literals"
    return type(demand), tuple(_counted_from(part, origin) for part in demand.parts)


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
