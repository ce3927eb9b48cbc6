"""Events that occur in no trace, because each occurrence requires a later one.

A trace has finitely many instants. Where every instant at which an event of some set occurs requires an event of the
set at a later one, or is impossible, the last such instant has none after it: no event of the set ever occurs. That is
induction over the instants from the last one back, with one question for each event.
"""

from __future__ import annotations

from collections.abc import Collection

from sleec_verify.traces.index import Index
from sleec_verify.traces.model import TraceModel


def impossible_events(index: Index, counting: Collection[str]) -> frozenset[str]:
    """The largest set of events of which each occurrence requires a later one, by the rules `counting` and all
    relations. At most quadratic in the number of events, each step a question about one instant."""
    rules = {trigger: [rule for rule in rules if rule.label in counting] for trigger, rules in index.by_trigger.items()}
    left = {*index.by_trigger, *index.obliging, *index.relations_of_event}
    while True:
        possible = set()
        for event in sorted(left):
            model = TraceModel(index, rules)
            only = model.instant(model.formula.true)
            if model.is_possible(model.instants[only].event(event), last_of=left):
                possible.add(event)
        if not possible:
            return frozenset(left)
        left -= possible
        if not left:
            return frozenset()
