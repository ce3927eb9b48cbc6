"""Responses that can always be met: the one static argument besides refinement.

An event is *free* if no rule forbids it, no relation or condition mentions it, and everything that it triggers can
always be met. A
demand with a free event in a window that closes last can be met whatever else happens: the event occurs in that window.
It can be in no minimal set of rules in conflict.
"""

from __future__ import annotations

from sleec_verify.encoding.solver import Undecided
from sleec_verify.traces.demands import Demand, Every, Occurs, Some, occurrences
from sleec_verify.traces.index import Index


def free_events(index: Index) -> frozenset[str]:
    """The free events: the least fixpoint, so that what leads back to itself is not among them. Quadratic at most."""
    free: set[str] = set()
    candidates = set(index.obliging) - set(index.forbidding) - index.mere_inputs
    candidates -= {*index.relations_of_event, *index.naming}
    grew = True
    while grew:
        fresh = {event for event in candidates - free if _leads_to_free(index, event, frozenset(free))}
        free |= fresh
        grew = bool(fresh)
    return frozenset(free)


def _leads_to_free(index: Index, event: str, free: frozenset[str]) -> bool:
    try:
        return all(
            is_always_met(demand, free)
            for rule in index.by_trigger.get(event, ())
            for clause in rule.clauses()
            for obligation in clause.obligations
            for demand, _ in index.responses.variants(obligation)
        )
    except Undecided:
        return False


def is_always_met(demand: Demand, free: frozenset[str]) -> bool:
    """Whether a demand without literals can be met whatever else happens."""
    if isinstance(demand, Occurs):
        return not demand.negated and demand.event in free
    if isinstance(demand, Every):
        return all(is_always_met(part, free) for part in demand.parts)
    assert isinstance(demand, Some), "demands without literals have atoms only"
    ends = [what.end for what in occurrences(demand)]
    return any(is_always_met(part, free) and _closes_last(part, ends) for part in demand.parts)


def _closes_last(demand: Demand, ends: list[int | None]) -> bool:
    own = [what.end for what in occurrences(demand)]
    if None in own:
        return all(end is None for end in own)
    return None not in ends and min(end for end in own if end is not None) >= max(e for e in ends if e is not None)
