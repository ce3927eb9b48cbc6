"""Demands over the seconds to come, and their progression from one second to the next.

F. Bacchus and F. Kabanza: "Planning for temporally extended goals", Annals of Mathematics and Artificial Intelligence
22 (1998), section 3.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple, Union


class Literal(NamedTuple):
    """`event` occurs (or, `negated`, does not occur) in the seconds `first` to `last` from now; no `last`: from `first`
    on."""

    event: str
    negated: bool
    first: int
    last: int | None


class All(NamedTuple):
    parts: frozenset[Demand]


class Any(NamedTuple):
    options: frozenset[Demand]


Demand = Union[bool, Literal, All, Any]


def every(parts: Iterable[Demand]) -> Demand:
    found: set[Demand] = set()
    for part in parts:
        if part is False:
            return False
        if isinstance(part, All):
            found |= part.parts
        elif part is not True:
            found.add(part)
    strongest_parts = strongest(found)
    if not strongest_parts:
        return True
    return next(iter(strongest_parts)) if len(strongest_parts) == 1 else All(strongest_parts)


def strongest(demands: set[Demand]) -> frozenset[Demand]:
    """The demands without those that another one implies."""
    return frozenset(d for d in demands if not any(other != d and _implies(other, d) for other in demands))


def some(options: Iterable[Demand]) -> Demand:
    found: set[Demand] = set()
    for option in options:
        if option is True:
            return True
        if isinstance(option, Any):
            found |= option.options
        elif option is not False:
            found.add(option)
    found = {option for option in found if not any(other != option and _implies(option, other) for other in found)}
    if not found:
        return False
    return next(iter(found)) if len(found) == 1 else Any(frozenset(found))


def _implies(one: Demand, other: Demand) -> bool:
    """Whether a literal implies another: an occurrence in a window implies one in each wider window."""
    if not isinstance(one, Literal) or not isinstance(other, Literal) or one[:2] != other[:2]:
        return False
    narrow, wide = (other, one) if one.negated else (one, other)
    return wide.first <= narrow.first and (wide.last is None or (narrow.last is not None and narrow.last <= wide.last))


def progress(demand: Demand, events: frozenset[str]) -> Demand:
    """What is left of a demand in the next second if exactly `events` occur in this one."""
    if isinstance(demand, bool):
        return demand
    if isinstance(demand, Literal):
        if demand.first <= 0 and demand.event in events:
            return not demand.negated
        if demand.last is not None and demand.last <= 0:
            return demand.negated
        return demand._replace(first=max(demand.first - 1, 0), last=None if demand.last is None else demand.last - 1)
    if isinstance(demand, All):
        return every(progress(part, events) for part in demand.parts)
    return some(progress(option, events) for option in demand.options)


def forbids(demand: Demand, events: frozenset[str]) -> bool:
    """Whether no continuation in which at least `events` occur now meets the demand, for what they forbid alone."""
    if isinstance(demand, bool):
        return not demand
    if isinstance(demand, Literal):
        return demand.negated and demand.first <= 0 and demand.event in events
    if isinstance(demand, All):
        return any(forbids(part, events) for part in demand.parts)
    return all(forbids(option, events) for option in demand.options)


def met_by_silence(demand: Demand) -> bool:
    """Whether the demand is met if nothing occurs from now on."""
    if isinstance(demand, bool):
        return demand
    if isinstance(demand, Literal):
        return demand.negated
    if isinstance(demand, All):
        return all(map(met_by_silence, demand.parts))
    return any(map(met_by_silence, demand.options))
