"""Events that occur in no trace, because each occurrence requires a later one.

A trace has finitely many instants. Suppose that each occurrence of an event of some set requires a later occurrence of
one of the set, or is impossible. Then the last occurrence contradicts this, so no event of the set ever occurs. This is
induction over the instants from the last one backwards, with one question for each event.
"""

from __future__ import annotations

from collections.abc import Collection

from sleec_verify.encoding.budget import as_far_as_decided
from sleec_verify.traces.index import TraceIndex
from sleec_verify.traces.model import TraceModel
from sleec_verify.wording.phrases import listed, quoted


class InductiveModel(TraceModel):
    """Complete traces without the events that never occur under the counting rules and relations."""

    def __init__(self, index: TraceIndex) -> None:
        super().__init__(index)
        self._induction: dict[frozenset[str], int] = {}
        self._counting: frozenset[str] = frozenset()

    def ask(self, *required: int, counting: Collection[str] | None = None) -> bool:
        if not self.index.is_cyclic:
            return super().ask(*required, counting=counting)
        labels = (rule.label for rule in self.index.ruleset.rules)
        self._counting = frozenset([*labels, *self.index.relation_by_key] if counting is None else counting)
        return super().ask(*required, self._inductive(self._counting), counting=counting)

    def _inductive(self, counting: frozenset[str]) -> int:
        """A literal that implies that no events occur that never occur under the rules and relations `counting`."""
        literal = self._induction.get(counting)
        if literal is None:
            literal = self._induction[counting] = self.formula.fresh()
            for event in sorted(self._impossible(counting)):
                self.exclude(literal, event)
        return literal

    def _impossible(self, counting: frozenset[str]) -> frozenset[str]:
        known = self.index.impossible
        if counting not in known:
            every = frozenset([*(rule.label for rule in self.index.ruleset.rules), *self.index.relation_by_key])
            if counting < every and not self._impossible(every):
                return frozenset()
            # With fewer rules and relations, no further events are impossible.
            more = [events for others, events in known.items() if counting < others]
            among = frozenset.intersection(*more) if more else {*self.index.by_trigger, *self.index.relations_of_event}
            known[counting] = impossible_events(self.index, counting, among)
        return known[counting]

    def matter(self) -> list[str]:
        # The reason for an impossible event may be any of them.
        return super().matter() if self.core.isdisjoint(self._induction.values()) else sorted(self._counting)


def impossible_events(index: TraceIndex, counting: Collection[str], among: Collection[str]) -> frozenset[str]:
    """The largest set of events of which each occurrence requires a later one, by the rules and relations
    `counting`, as far as this is decided. At most quadratic in the number of events."""
    left = set(among)
    while left:
        refuted = {event: _never_last(index, counting, event, left) for event in sorted(left)}
        possible = {event for event, model in refuted.items() if model is None}
        if not possible:
            for event, model in refuted.items():
                assert model is not None, "no event is possible"
                model.conclude(f"each occurrence of {quoted(event)} requires a later one of {listed_events(left)}")
            break
        left -= possible
    return frozenset(left)


def listed_events(events: Collection[str]) -> str:
    """Events, in words."""
    return listed(map(quoted, sorted(events)))


def _never_last(index: TraceIndex, counting: Collection[str], event: str, group: Collection[str]) -> TraceModel | None:
    """The model that refutes that an event occurs at an instant after which none of a group occurs. None if it can."""
    model = TraceModel(index)
    last = model.instant(model.formula.true)
    for other in group:
        model.exclude(model.formula.true, other, after=last)
    with as_far_as_decided():
        return None if model.ask(model.instants[last].event(event), counting=counting) else model
    return None
