"""Statements as lines of text, with the comments above and after them: what both languages print alike."""

from __future__ import annotations

from collections.abc import Sequence

from sleec_runtime.language.common.comment_lines import comment_lines, with_comment
from sleec_runtime.language.common.formula_printer import FormulaPrinter
from sleec_runtime.model import Claim, Clause, Lasting, Length


class StatementPrinter:
    """Writes lines. The current line grows until the next one begins."""

    def __init__(self, formulas: FormulaPrinter) -> None:
        self.formulas = formulas
        self._lines: list[str] = []
        self._line = ""
        self._comment: str | None = None

    def begin(self, indent: str = "", above: Sequence[str] = (), comment: str | None = None) -> None:
        """Begins a line, with the comments above it and the one after it."""
        self._end()
        self._lines += [indent + line if line else line for line in comment_lines(above)]
        self._line = indent
        self._comment = comment

    def write(self, text: str) -> None:
        """Adds to the current line."""
        self._line += text

    def take_lines(self) -> list[str]:
        """The lines that have been written since the last call."""
        self._end()
        lines, self._lines = self._lines, []
        return lines

    def _end(self) -> None:
        if self._line:
            self._lines.append(with_comment(self._line, self._comment))
        self._line = ""

    # Statements -----------------------------------------------------------------------------------------------

    def keyword(self, word: str) -> str:
        """A keyword as the language writes it."""
        raise NotImplementedError

    def response(self, clause: Clause, indent: str = "") -> None:
        """Writes the obligations of a clause and its chain."""
        raise NotImplementedError

    def claim_response(self, clause: Clause) -> None:
        """Writes a response in a claim."""
        self.response(clause)

    def claim(self, claim: Claim) -> None:
        """Writes a concern or purpose after its label."""
        self.write(f"{self.keyword(claim.form)} {claim.event}{self.formulas.guard(claim.condition)}")
        word = "while" if claim.form == "exists" else "then"
        for response in claim.responses:
            self.write(f" {self.keyword(word)} ")
            self.claim_response(response)
            word = "while"
        if claim.meanwhile is not None:
            self.write(f" {self.keyword('meanwhile')} (")
            self.claim(claim.meanwhile)
            self.write(")")

    def lasting(self, relation: Lasting) -> str:
        """The text of a relation between an event and a condition that lasts."""
        guard = self.formulas.guard
        text = f"{self.keyword('when')} {relation.event}{guard(relation.condition)} "
        text += f"{self.keyword('then')} {self.formulas.formula(relation.formula)} "
        if relation.duration is not None:
            return f"{text}{self.keyword('for')} {self.length(relation.duration)}"
        return f"{text}{self.keyword('until')} {relation.end}{guard(relation.end_condition)}"

    def length(self, length: Length) -> str:
        """A length of time."""
        return f"{self.formulas.term(length.amount)} {length.unit}"
