"""Concerns, purposes, and relations between events and conditions."""

from __future__ import annotations

from collections.abc import Callable
from typing import NoReturn

from sleec_runtime.language.english.keywords import OCCASION, RELATION_WORDS, STATEMENTS
from sleec_runtime.language.english.rules import RuleParser
from sleec_runtime.model import (
    NO_COMMENTS,
    NOWHERE,
    Atom,
    Claim,
    ClaimForm,
    ClaimKind,
    Clause,
    Effect,
    EffectKind,
    EventRelation,
    EventRelationKind,
    Formula,
    Lasting,
    MeasureRelation,
    MeasureRelationKind,
    Relation,
    Span,
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
_FORMS = (OCCASION, "WHEN", "IF", "EXISTS")
_AS_IN = "for example: RELATION OpenDoor EXCLUDES LockDoor"


class RelationParser(RuleParser):
    """Reads concerns, purposes and relations. They apply to the whole text."""

    def _occasion(self, what: str, resolve: Callable[[str, Span], Atom]) -> tuple[str, Span, Formula | None]:
        """``Event [AND condition]``."""
        name, span = self._event_named(what)
        if self.kinds[self.at] != "AND":
            return name, span, None
        self.at += 1
        self.resolve = resolve
        return name, span, self.formula()

    def _event_named(self, what: str) -> tuple[str, Span]:
        first = self.at
        if self.kinds[first] != "word":
            self.refuse_name(what, "an event is one name, without NOT or parentheses; write conditions after AND")
        name = self.name(what) or self.expected(what)
        span = self.span(first)
        if not self.hurt:
            self.names.event(name, span)
        return name, span

    def _condition(self) -> Formula:
        self.resolve = self.names.state
        return self.formula()

    # Concerns and purposes ------------------------------------------------------------------------------------

    def claim(self) -> Claim:
        """``CONCERN label WHEN event … THEN response`` or ``… EXISTS event … WHILE response``; PURPOSE likewise."""
        first = self.at
        kind: ClaimKind = "concern" if self.kinds[first] == "CONCERN" else "purpose"
        self.at += 1
        label, label_span = self.label_word(self.kinds[first], f"{kind[0]}1", _FORMS)
        self.names.label(label, label_span, kind)
        return self._claim(kind, label, label_span, first)

    def _claim(self, kind: ClaimKind, label: str, label_span: Span, first: int) -> Claim:

        at_form = self.at
        if self.kinds[at_form] not in _FORMS:
            where = f"the label of the {kind}" if label else "MEANWHILE ("
            self.expected(
                f"WHEN or EXISTS after {where}", f"for example: {kind.upper()} c1 WHEN DoorOpened THEN NOT CloseDoor"
            )
        form: ClaimForm = "exists" if self.kinds[at_form] == "EXISTS" else "when"
        self.at += 1
        event, event_span, condition = self._occasion("an event", self.names.condition)
        responses: list[Clause] = []
        self.comma_before("THEN")
        word = "WHILE" if form == "exists" else "THEN"
        while self.kinds[self.at] == word:
            self.at += 1
            responses.append(self._claimed_response())
            word = "WHILE"
        if self.kinds[self.at] in ("THEN", "WHILE"):
            self.expected(
                "the end of this claim" if responses else f"{word} and a response",
                "write EXISTS event WHILE response WHILE response, or WHEN event THEN response WHILE response",
            )
        meanwhile = self._meanwhile(kind) if self.kinds[self.at] == "MEANWHILE" else None
        return Claim(
            kind,
            label,
            form,
            event,
            condition,
            tuple(responses),
            meanwhile,
            self.span(first),
            label_span,
            event_span,
            self.comments_of(first) if label else NO_COMMENTS,
        )

    def _claimed_response(self) -> Clause:
        """A response with the hedges behind it, which need no parentheses here."""
        first = self.at
        # The printer writes parentheses around a response with hedges.
        bare = self.kinds[first] != "("
        self.depth += bare
        obligations, inner = self.response()
        if self.kinds[self.at] == "OR":
            self.no_choice()
        hedges = list(inner)
        while self.kinds[self.at] == "UNLESS":
            if inner:
                self.expected(
                    "WHILE or the next statement", "the exceptions of this chain must be inside its parentheses"
                )
            hedges.append(self.hedge())
        self.depth -= bare
        if hedges and not inner:
            self.leave_room(self.depth)
        return Clause(None, obligations, tuple(hedges), self.span(first))

    def _meanwhile(self, kind: ClaimKind) -> Claim:
        self.at += 1
        opened = self.at
        if self.kinds[opened] != "(":
            self.expected("a parenthesis after MEANWHILE", "for example: MEANWHILE (EXISTS CloseDoor AND windy)")
        self.deeper()
        self.at += 1
        claim = self._claim(kind, "", NOWHERE, self.at)
        self.close(")", opened)
        self.depth -= 1
        return claim

    # Relations ------------------------------------------------------------------------------------------------

    def relation(self) -> Relation:
        first = self.at
        self._mark_words(first + 1)
        self.at += 1
        kind = self.kinds[self.at]
        if kind == OCCASION:
            return self._lasting(first)
        if kind == "ALWAYS":
            return self._of_conditions(first)
        event, _ = self._event_named("an event, ALWAYS or WHEN")
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
        self.expected(f"{_listed([*OF_EVENTS, *EFFECTS])} after the event", self._meant(event.split()) or _AS_IN)

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
        other, _ = self._event_named("another event")
        return EventRelation(relation, event, other, self.span(first), self.comments_of(first))

    def _effect(self, first: int, event: str, relation: EffectKind) -> Effect:

        self.at += 1
        formula = self._condition()
        return Effect(relation, event, formula, self.span(first), self.comments_of(first))

    def _of_conditions(self, first: int) -> MeasureRelation:

        self.at += 1
        left = self._condition()
        word = self.kinds[self.at]
        right: Formula | None = None
        if word in OF_CONDITIONS:
            self.at += 1
            right = self._condition()
        elif word in RELATION_WORDS:
            self.expected(
                f"{_listed(OF_CONDITIONS)} after the condition", "for example: RELATION ALWAYS raining IMPLIES wet"
            )
        relation: MeasureRelationKind = OF_CONDITIONS[word] if right is not None else "invariant"
        return MeasureRelation(relation, left, right, self.span(first), self.comments_of(first))

    def _lasting(self, first: int) -> Lasting:

        self.at += 1
        event, _, condition = self._occasion("an event", self.names.state)
        if self.kinds[self.at] != "THEN":
            self.expected("THEN and a condition", "for example: RELATION WHEN DoorOpened THEN drafty UNTIL CloseDoor")
        self.at += 1
        formula = self._condition()
        end: str | None = None
        end_condition: Formula | None = None
        duration = None
        if self.kinds[self.at] == "FOR":
            self.at += 1
            duration = self.length()
        elif self.kinds[self.at] == "UNTIL":
            self.at += 1
            end, _, end_condition = self._occasion("an event", self.names.state)
        else:
            self.expected(
                "UNTIL and an event, or FOR and a length of time",
                "for example: RELATION WHEN DoorOpened THEN drafty FOR 5 minutes",
            )
        span = self.span(first)
        return Lasting(event, condition, formula, end, end_condition, duration, span, self.comments_of(first))


def _listed(words: list[str] | dict[str, MeasureRelationKind]) -> str:
    *first, last = words
    return f"{', '.join(first)} or {last}"
