"""Events that occur in no trace, because each occurrence requires a later one.

A trace has finitely many instants. Where each occurrence of an event of some set requires a later occurrence of one of
the set, or is impossible, the last one has none after it: no event of the set ever occurs. That is induction over the
instants from the last one back, with one question for each event.
"""

from __future__ import annotations

from collections.abc import Collection

from sleec_verify.budget import OutOfBudget, Undecided
from sleec_verify.traces.index import Index
from sleec_verify.traces.model import TraceModel


def impossible_events(index: Index, counting: Collection[str]) -> frozenset[str]:
    """The largest set of events of which each occurrence requires a later one, by the rules and relations `counting`,
    as far as that is decided. At most quadratic in the number of events."""
    left = {*index.by_trigger, *index.relations_of_event}
    while left:
        possible = {event for event in left if _can_be_last(index, counting, event, left)}
        if not possible:
            break
        left -= possible
    return frozenset(left)


def _can_be_last(index: Index, counting: Collection[str], event: str, group: Collection[str]) -> bool:
    """Whether an event can occur at an instant after which none of a group occurs."""
    model = TraceModel(index)
    last = model.instant(model.formula.true)
    for other in group:
        model.exclude(model.formula.true, other, after=last)
    try:
        return model.ask(model.instants[last].event(event), counting=counting)
    except OutOfBudget:
        raise
    except Undecided:
        return True
