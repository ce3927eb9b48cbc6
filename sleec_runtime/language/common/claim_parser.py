"""The grammar of claims (concerns and purposes) and of lasting relations, which both languages share."""

from __future__ import annotations

from collections.abc import Collection
from typing import ClassVar

from sleec_runtime.language.common.formula_parser import FormulaParser
from sleec_runtime.model import (
    NO_COMMENTS,
    NOWHERE,
    Claim,
    ClaimForm,
    ClaimKind,
    Clause,
    Formula,
    Lasting,
    Length,
    Span,
)


class ClaimParser(FormulaParser):
    """Reads claims after their label, and lasting relations."""

    claim_forms: ClassVar[Collection[str]]
    """The kinds of token that may follow the label."""

    claim_example: ClassVar[str]
    meanwhile_example: ClassVar[str]
    lasting_example: ClassVar[str]

    def keyword(self, word: str) -> str:
        """A keyword as the language writes it, which is its kind of token."""
        raise NotImplementedError

    def occasion(self, what: str) -> tuple[str, Span, Formula | None]:
        """Reads ``event [and condition]``."""
        raise NotImplementedError

    def claim_response(self) -> Clause:
        """Reads a response and the exceptions after it."""
        raise NotImplementedError

    def length(self) -> Length:
        """Reads a length of time."""
        raise NotImplementedError

    def labelled_claim(self, kind: ClaimKind, label: str, label_span: Span, first: int) -> Claim:
        """``when event … then response`` or ``exists event … while response``, of a claim that begins with token
        `first`."""
        then, repeat = self.keyword("then"), self.keyword("while")
        if self.kinds[self.at] not in self.claim_forms:
            where = f"the label of the {kind}" if label else f"{self.keyword('meanwhile')} ("
            what = f"{self.keyword('when')} or {self.keyword('exists')} after {where}"
            self.expected(what, f"for example: {self.claim_example}")
        form: ClaimForm = "exists" if self.token_text(self.at).lower() == "exists" else "when"
        self.at += 1
        event, event_span, condition = self.occasion(f"the event of a {kind}")
        responses: list[Clause] = []
        next_word = repeat if form == "exists" else then
        while self.kinds[self.at] == next_word:
            self.at += 1
            responses.append(self.claim_response())
            next_word = repeat
        if self.kinds[self.at] in (then, repeat):
            what = "the end of this claim" if responses else f"{next_word} and a response"
            self.expected(what, f"for example: {self.claim_example}")
        return Claim(
            kind,
            label,
            form,
            event,
            condition,
            tuple(responses),
            self._meanwhile(kind) if self.kinds[self.at] == self.keyword("meanwhile") else None,
            self.span(first),
            label_span,
            event_span,
            self.comments_of(first) if label else NO_COMMENTS,
        )

    def _meanwhile(self, kind: ClaimKind) -> Claim:
        self.at += 1
        opened = self.at
        if self.kinds[opened] != "(":
            what = f"a parenthesis after {self.keyword('meanwhile')}"
            self.expected(what, f"for example: {self.meanwhile_example}")
        self.descend()
        self.at += 1
        claim = self.labelled_claim(kind, "", NOWHERE, self.at)
        self.close(")", opened)
        self.depth -= 1
        return claim

    def lasting(self, first: int) -> Lasting:
        """``event … then condition until event …`` or ``… for 5 minutes``, of a relation that begins with token
        `first`."""
        example = f"for example: {self.lasting_example}"
        event, _, condition = self.occasion("the event of a relation")
        if self.kinds[self.at] != self.keyword("then"):
            self.expected(f"{self.keyword('then')} and a condition", example)
        self.at += 1
        formula = self.formula()
        comments = self.comments_of(first)
        if self.kinds[self.at] == self.keyword("for"):
            self.at += 1
            duration = self.length()
            return Lasting(event, condition, formula, None, None, duration, self.span(first), comments)
        if self.kinds[self.at] != self.keyword("until"):
            what = f"{self.keyword('until')} and an event, or {self.keyword('for')} and a length of time"
            self.expected(what, example)
        self.at += 1
        end, _, end_condition = self.occasion("the event that ends it")
        return Lasting(event, condition, formula, end, end_condition, None, self.span(first), comments)
