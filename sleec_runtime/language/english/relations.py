"""Relations between events and conditions: ``RELATION event EXCLUDES event``, ``RELATION ALWAYS condition``."""

from __future__ import annotations

from typing import NoReturn

from sleec_runtime.language.english.claims import EnglishClaimParser
from sleec_runtime.language.english.keywords import OCCASION, RELATION_WORDS, STATEMENTS
from sleec_runtime.model import (
    Effect,
    EffectKind,
    EventRelation,
    EventRelationKind,
    Formula,
    MeasureRelation,
    MeasureRelationKind,
    Relation,
)
from sleec_runtime.support.suggestions import did_you_mean, nearest

OF_EVENTS: dict[str, EventRelationKind] = {
    "WITNESSES": "witness",
    "EQUALS": "equal",
    "EXCLUDES": "mutualExclusive",
    "PRECEDES": "happenBefore",
}
OF_CONDITIONS: dict[str, MeasureRelationKind] = {
    "IMPLIES": "imply",
    "EQUALS": "iff",
    "EXCLUDES": "mutualExclusive",
    "OPPOSES": "opposite",
}
EFFECTS: dict[str, EffectKind] = {"CAUSES": "causation", "INCLUDES": "includes", "FORBIDS": "forbid"}
_EXAMPLE = "for example: RELATION OpenDoor EXCLUDES LockDoor"


class EnglishRelationParser(EnglishClaimParser):
    """Reads relations. They apply to the whole text."""

    def relation(self) -> Relation:
        """The relation at hand."""
        first = self.at
        self.resolve = self.names.state
        self._mark_words(first + 1)
        self.at += 1
        kind = self.kinds[self.at]
        if kind == OCCASION:
            self.at += 1
            return self.lasting(first)
        if kind == "ALWAYS":
            return self._of_conditions(first)
        event, _ = self.event("an event, ALWAYS or WHEN")
        word = self.kinds[self.at]
        if word in EFFECTS:
            return self._effect(first, event, EFFECTS[word])
        if word not in OF_EVENTS:
            self._refuse_relation(event)
        return self._of_events(first, event, OF_EVENTS[word])

    def _refuse_relation(self, event: str) -> NoReturn:
        word = self.kinds[self.at]
        if word in OF_CONDITIONS:
            hint = f"write ALWAYS before conditions: RELATION ALWAYS {event} {word} ..."
            self.expected("a word for events", hint)
        self.expected(f"{_listed([*OF_EVENTS, *EFFECTS])} after the event", self._meant(event.split()) or _EXAMPLE)

    def _mark_words(self, token: int) -> None:
        """Makes keywords of the words that are keywords in a RELATION only."""
        at = token
        while self.kinds[at] not in STATEMENTS and self.kinds[at] != "end":
            if self.kinds[at] == "word" and self.token_text(at) in RELATION_WORDS:
                self.kinds[at] = self.token_text(at)
            at += 1

    def _meant(self, words: list[str]) -> str | None:
        for word in words[1:]:
            near = nearest(word, sorted(RELATION_WORDS))
            if near is not None:
                return did_you_mean(near)
        return None

    def _of_events(self, first: int, event: str, relation: EventRelationKind) -> EventRelation:

        self.at += 1
        other, _ = self.event("another event")
        return EventRelation(relation, event, other, self.span(first), self.comments_of(first))

    def _effect(self, first: int, event: str, relation: EffectKind) -> Effect:

        self.at += 1
        formula = self.formula()
        return Effect(relation, event, formula, self.span(first), self.comments_of(first))

    def _of_conditions(self, first: int) -> MeasureRelation:

        self.at += 1
        left = self.formula()
        word = self.kinds[self.at]
        right: Formula | None = None
        if word in OF_CONDITIONS:
            self.at += 1
            right = self.formula()
        elif word in RELATION_WORDS:
            self.expected(
                f"{_listed(OF_CONDITIONS)} after the condition", "for example: RELATION ALWAYS raining IMPLIES wet"
            )
        relation: MeasureRelationKind = OF_CONDITIONS[word] if right is not None else "invariant"
        return MeasureRelation(relation, left, right, self.span(first), self.comments_of(first))


def _listed(words: list[str] | dict[str, MeasureRelationKind]) -> str:
    *first, last = words
    return f"{', '.join(first)} or {last}"
