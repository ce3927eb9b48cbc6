"""Concerns and purposes: ``label when event … then response``, ``label exists event … while response``."""

from __future__ import annotations

from sleec_runtime.errors import Problem
from sleec_runtime.language.common.claim_parser import ClaimParser
from sleec_runtime.language.dsl.keywords import UNNAMED
from sleec_runtime.language.dsl.responses import DslResponseParser
from sleec_runtime.model import NOWHERE, Claim, ClaimKind, Clause, Formula, Span

_EXAMPLES = {
    "rule": "R1 when Event then Response",
    "concern": "c1 when Event then not Response",
    "purpose": "p1 exists Event",
}


class DslClaimParser(DslResponseParser, ClaimParser):
    """Reads concerns and purposes."""

    claim_forms = ("when", "exists", UNNAMED)
    claim_example = "c1 when Event and {condition} then not Response"
    meanwhile_example = "meanwhile (exists Event and {condition})"
    lasting_example = "when A then {p} until B"

    def keyword(self, word: str) -> str:
        return word

    def claim(self, kind: ClaimKind) -> Claim:
        """The claim at hand."""
        first = self.at
        self.allows_events = True
        label, label_span = self.label(kind)
        return self.labelled_claim(kind, label, label_span if label else NOWHERE, first)

    def label(self, what: str) -> tuple[str, Span]:
        """Reads the name of a rule or claim, as `what` says, up to its ``when`` or ``exists``. After a problem, the
        rest can still be read."""
        at = self.at
        span = self.token_span(at)
        if self.kinds[at] == UNNAMED:
            message = f"the {what} in line {self.line_of(at)} has no name"
            self.problems.append(Problem(message, span, f"start a {what} with its name: {_EXAMPLES[what]}"))
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
        name = self.name(f"the name of {what}", "write the name of an event, without braces or parentheses")
        span = self.token_span(at_event)
        if not self.has_failed:
            self.names.event(name, span, what)
        return name, span, self.formula() if self.accept("and") else None

    def claim_response(self) -> Clause:
        """A response and the exceptions after it, which need no braces here."""
        first = self.at
        clause = self.chain(None, first)
        hedges: list[Clause] = []
        while self.kinds[self.at] == "unless":
            hedges.append(self.hedge())
        if not hedges:
            return clause
        if clause.hedges:
            message = "the exceptions of a chain in braces must be inside the braces"
            self.fail(message, hedges[0].span, "move it inside the braces")
        return Clause(None, clause.obligations, tuple(hedges), self.span(first))
