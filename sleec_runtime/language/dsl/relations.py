"""Concerns and purposes, and relations among events and measures."""

from __future__ import annotations

from typing import cast

from sleec_runtime.errors import Problem
from sleec_runtime.language.common.problems import quoted
from sleec_runtime.language.dsl.keywords import UNNAMED
from sleec_runtime.language.dsl.responses import ResponseParser
from sleec_runtime.model import (
    NO_COMMENTS,
    NOWHERE,
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
    Span,
)
from sleec_runtime.support.suggestions import did_you_mean, nearest

_EVENT_RELATIONS = ("witness", "equal", "mutualExclusive", "happenBefore")
OF_MEASURES = ("imply", "iff", "mutualExclusive", "opposite", "invariant")
"""The relations of measures, as they are called behind the keyword `measure`."""


_NAMED = {
    "rule": "start a rule with its name: R1 when Event then Response",
    "concern": "start a concern with its name: c1 when Event then not Response",
    "purpose": "start a purpose with its name: p1 exists Event",
}


class RelationParser(ResponseParser):
    """Reads what a ruleset says besides its rules."""

    def label(self, what: str) -> tuple[str, Span]:
        """Reads the name of a rule or claim, as `what` says, up to its ``when`` or ``exists``. What is wrong with it
        leaves the rest readable."""
        at = self.at
        span = self.token_span(at)
        if self.kinds[at] == UNNAMED:
            message = f"the {what} in line {self.line_of(at)} has no name"
            self.problems.append(Problem(message, span, _NAMED[what]))
            return "", span
        self.at += 1
        label = self.names.label(self.token_text(at), span)
        if self.kinds[self.at] == ":":
            message = f"unexpected colon after the name of the {what}"
            self.problems.append(Problem(message, self.token_span(self.at), "delete it"))
            self.at += 1
        return label, span

    def occasion(self, what: str) -> tuple[str, Span, Formula | None]:
        """``Event [and condition]``."""
        at_event = self.at
        if self.kinds[at_event] == "not":
            self.expected(f"the name of {what}", f"{what} is an event; write conditions after and")
        name = self.name(f"the name of {what}", "the name of an event, without braces and parentheses")
        span = self.token_span(at_event)
        if not self.hurt:
            self.names.event(name, span, what)
        return name, span, self.formula() if self.accept("and") else None

    # Concerns and purposes ------------------------------------------------------------------------------------

    def claim(self, kind: ClaimKind) -> Claim:
        first = self.at
        self.allows_events = True
        label, _ = self.label(kind)
        return self._claim(kind, label, first)

    def _claim(self, kind: ClaimKind, label: str, first: int) -> Claim:
        form: ClaimForm = "exists" if self.token_text(self.at) == "exists" else "when"
        self.at += 1
        event, event_span, condition = self.occasion(f"the event of a {kind}")
        responses: list[Clause] = []
        word = "while" if form == "exists" else "then"
        while self.kinds[self.at] == word:
            self.at += 1
            responses.append(self._response())
            word = "while"
        meanwhile: Claim | None = None
        if self.kinds[self.at] == "meanwhile":
            self.at += 1
            opened = self.at
            self.require("(", "a parenthesis after meanwhile", "for example: meanwhile (exists Event and {condition})")
            self.deeper()
            if self.kinds[self.at] not in ("exists", "when"):
                self.expected("exists or when", "for example: meanwhile (exists Event and {condition})")
            meanwhile = self._claim(kind, "", self.at)
            self.close(")", opened)
            self.depth -= 1
        return Claim(
            kind,
            label,
            form,
            event,
            condition,
            tuple(responses),
            meanwhile,
            self.span(first),
            self.token_span(first) if label else NOWHERE,
            event_span,
            self.comments_of(first) if label else NO_COMMENTS,
        )

    def _response(self) -> Clause:
        """A response with the hedges behind it, which need no braces here."""
        first = self.at
        clause = self.chain(None, first)
        hedges: list[Clause] = []
        while self.kinds[self.at] == "unless":
            hedges.append(self.hedge())
        if not hedges:
            return clause
        if clause.hedges:
            self.fail(
                "the exceptions of a chain in braces must be inside the braces",
                hedges[0].span,
                "move it inside the braces",
            )
        return Clause(None, clause.obligations, tuple(hedges), self.span(first))

    # Relations ------------------------------------------------------------------------------------------------

    def relation(self) -> EventRelation | MeasureRelation | Effect | Lasting:
        first = self.at
        word = self.token_text(first)
        self.at += 1
        self.allows_events = False
        if word == "when":
            return self._lasting(first)
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
        if not self.hurt:
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

    def _lasting(self, first: int) -> Lasting:
        event, _, condition = self.occasion("the event of a relation")
        self.require("then", "then and a condition", "for example: when A then {p} until B")
        formula = self.formula()
        end: str | None = None
        end_condition: Formula | None = None
        duration = None
        if self.accept("for"):
            duration = self.length()
        else:
            self.require(
                "until", "until and an event, or for and a length of time", "for example: when A then {p} until B"
            )
            end, _, end_condition = self.occasion("the event that ends it")
        return Lasting(
            event, condition, formula, end, end_condition, duration, self.span(first), self.comments_of(first)
        )
