"""Events that occur in no trace, because what they call for never comes to an end, or to something that cannot be.

A trace has finitely many instants. Where every instant at which an event of some set occurs calls for an event of the
set at a strictly later one, or cannot be, the last such instant has none after it: no event of the set ever occurs.
That is an induction over instants from the last one back, with one question for each event of the set.
"""

from __future__ import annotations

from sleec_verify.timed.program import Program
from sleec_verify.timed.unfolding import Unfolding


def endless(program: Program, without: frozenset[str] = frozenset()) -> frozenset[str]:
    """The largest set of events of which each, wherever it occurs, calls for another one of the set later on, by the
    rules that are not `without`. Quadratic in the number of events, each step a question about one instant."""
    left = {*program.by_trigger, *program.obliging, *program.laws_of_event}
    while True:
        may_be_last = set()
        for event in sorted(left):
            unfolding = Unfolding(program, without=without)
            only = unfolding.instant(unfolding.formula.true)
            if unfolding.trusting(unfolding.instants[only].event(event), but=left):
                may_be_last.add(event)
        if not may_be_last:
            return frozenset(left)
        left -= may_be_last
