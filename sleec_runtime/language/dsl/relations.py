"""Relations between events and measures: ``mutualExclusive A B``, ``measure imply {m} {n}``."""

from __future__ import annotations

from typing import cast

from sleec_runtime.language.common.problems import quoted
from sleec_runtime.language.dsl.claims import DslClaimParser
from sleec_runtime.model import (
    Effect,
    EffectKind,
    EventRelation,
    EventRelationKind,
    Lasting,
    MeasureRelation,
    MeasureRelationKind,
)
from sleec_runtime.support.suggestions import did_you_mean, nearest

_EVENT_RELATIONS = ("witness", "equal", "mutualExclusive", "happenBefore")
OF_MEASURES = ("imply", "iff", "mutualExclusive", "opposite", "invariant")
"""The relations of measures, as they follow the keyword `measure`."""


class DslRelationParser(DslClaimParser):
    """Reads relations."""

    def relation(self) -> EventRelation | MeasureRelation | Effect | Lasting:
        first = self.at
        word = self.token_text(first)
        self.at += 1
        self.allows_events = False
        if word == "when":
            return self.lasting(first)
        comments = self.comments_of(first)
        if word == "measure":
            return self._of_measures(first)
        event = self._event_in(word)
        if word in _EVENT_RELATIONS:
            other = self._event_in(word)
            return EventRelation(cast("EventRelationKind", word), event, other, self.span(first), comments)
        return Effect(cast("EffectKind", word), event, self.formula(), self.span(first), comments)

    def _event_in(self, relation: str) -> str:
        hint = (
            f"for example: {relation} A B"
            if relation in _EVENT_RELATIONS
            else f"for example: {relation} A {{condition}}"
        )
        name = self.name("the name of an event", hint)
        if not self.has_failed:
            self.names.event(name, self.token_span(self.at - 1), f"what {relation} relates")
        return name

    def _of_measures(self, first: int) -> MeasureRelation:
        word = self.token_text(self.at)
        if word not in OF_MEASURES:
            near = nearest(word, OF_MEASURES)
            self.fail(
                f"no relation of measures is called {quoted(word)}",
                self.token_span(self.at),
                did_you_mean(near) or f"write one of {', '.join(OF_MEASURES)} after measure",
            )
        self.at += 1
        left = self.formula()
        right = self.formula() if word != "invariant" else None
        relation = cast("MeasureRelationKind", word)
        return MeasureRelation(relation, left, right, self.span(first), self.comments_of(first))
