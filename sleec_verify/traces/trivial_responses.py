"""Responses that can always be met: the only static argument in addition to refinement. Responses that never can.

An event is *free* if no rule forbids it, no relation or condition mentions it, and everything that it triggers can
always be met. A demand with a free event in a window that closes last can always be met: the event occurs in that
window. Such a demand is in no minimal set of rules in conflict.
"""

from __future__ import annotations

from sleec_runtime.model import Clause, Obligation, Rule
from sleec_verify.encoding.solver import Undecided
from sleec_verify.traces.demands import Demand, Every, Occurs, Some, occurrences
from sleec_verify.traces.index import TraceIndex


def free_events(index: TraceIndex) -> frozenset[str]:
    """The free events of the whole ruleset: the least fixpoint, so that no event that leads back to itself is free.

    Quadratic at most.
    """
    return free_events(index.whole) if index.whole is not None else index.once(_free_events)


def contested_obligations(index: TraceIndex, clause: Clause) -> tuple[Obligation, ...]:
    """The obligations of a clause that cannot always be met, for all decisions of the hedges inside them.

    Raises `Undecided` if the length of a window has no bounds.
    """
    known = index.once(_contested)
    entry = known.get(id(clause))
    if entry is None or entry[0] is not clause:
        free = free_events(index)
        found = tuple(
            obligation
            for obligation in clause.obligations
            if not all(is_always_met(demand, free) for demand, _ in index.responses.variants(obligation))
        )
        entry = known[id(clause)] = (clause, found)
    return entry[1]


def _contested(_: TraceIndex) -> dict[int, tuple[Clause, tuple[Obligation, ...]]]:
    return {}


def _free_events(index: TraceIndex) -> frozenset[str]:
    free: set[str] = set()
    candidates = set(index.obliging) - set(index.forbidding) - index.never_in_response
    candidates -= {*index.relations_of_event, *index.naming}
    grew = True
    while grew:
        fresh = {event for event in candidates - free if _leads_to_free(index, event, frozenset(free))}
        free |= fresh
        grew = bool(fresh)
    return frozenset(free)


def _leads_to_free(index: TraceIndex, event: str, free: frozenset[str]) -> bool:
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


def cannot_be_met(index: TraceIndex, rule: Rule) -> bool:
    """Whether some value of a measure gives an obligation of a rule a window without a second."""
    try:
        return any(
            demand == Some(())
            for clause in rule.clauses()
            for obligation in clause.obligations
            if index.lengths.cases(obligation) is not None
            for demand, _ in index.responses.variants(obligation)
        )
    except Undecided:
        return False


def is_always_met(demand: Demand, free: frozenset[str]) -> bool:
    """Whether a demand without literals can be met in every situation."""
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
