"""Concerns and purposes: ``CONCERN label WHEN event … THEN response``, ``… EXISTS event … WHILE response``."""

from __future__ import annotations

from sleec_runtime.language.common.claim_parser import ClaimParser
from sleec_runtime.language.english.keywords import OCCASION
from sleec_runtime.language.english.rules import EnglishRuleParser
from sleec_runtime.model import Claim, ClaimKind, Clause, Formula, Span


class EnglishClaimParser(EnglishRuleParser, ClaimParser):
    """Reads concerns and purposes. They apply to the whole text."""

    claim_forms = (OCCASION, "WHEN", "IF", "EXISTS")
    claim_example = "CONCERN c1 WHEN DoorOpened THEN NOT CloseDoor, or PURPOSE p1 EXISTS DoorOpened WHILE CloseDoor"
    meanwhile_example = "MEANWHILE (EXISTS CloseDoor AND windy)"
    lasting_example = "RELATION WHEN DoorOpened THEN drafty FOR 5 minutes"

    def keyword(self, word: str) -> str:
        return word.upper()

    def claim(self) -> Claim:
        """The claim at hand."""
        first = self.at
        kind: ClaimKind = "concern" if self.kinds[first] == "CONCERN" else "purpose"
        self.at += 1
        label, label_span = self.label_word(self.kinds[first], f"{kind[0]}1", self.claim_forms)
        self.names.label(label, label_span, kind)
        self.resolve = self.names.condition
        return self.labelled_claim(kind, label, label_span, first)

    def occasion(self, what: str) -> tuple[str, Span, Formula | None]:
        """``Event [AND condition]``, with or without a comma after it."""
        name, span = self.event(what)
        guard = None
        if self.kinds[self.at] == "AND":
            self.at += 1
            guard = self.formula()
        self.comma_before("THEN")
        return name, span, guard

    def event(self, what: str) -> tuple[str, Span]:
        """Reads the name of an event."""
        first = self.at
        if self.kinds[first] != "word":
            self.refuse_name(what, "an event is one name, without NOT or parentheses; write conditions after AND")
        name = self.name(what) or self.expected(what)
        span = self.span(first)
        if not self.has_failed:
            self.names.event(name, span)
        return name, span

    def claim_response(self) -> Clause:
        """A response and the exceptions after it, which need no parentheses here."""
        first = self.at
        # The printer writes parentheses around a response with exceptions.
        is_bare = self.kinds[first] != "("
        self.depth += is_bare
        obligations, inner = self.response()
        if self.kinds[self.at] == "OR":
            self.refuse_choice()
        hedges = list(inner)
        while self.kinds[self.at] == "UNLESS":
            if inner:
                hint = "the exceptions of this chain must be inside its parentheses"
                self.expected("WHILE or the next statement", hint)
            hedges.append(self.hedge())
        self.depth -= is_bare
        if hedges and not inner:
            self.check_room(self.depth)
        self.resolve = self.names.condition
        return Clause(None, obligations, tuple(hedges), self.span(first))
