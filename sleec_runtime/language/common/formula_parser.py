"""The grammar of formulas, by precedence climbing (Pratt 1973).

A language says which tokens are its connectives, how tightly these bind, and what its leaves are.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

from sleec_runtime.language.common.token_cursor import TokenCursor
from sleec_runtime.model import And, Formula, Not, Or, Span


class FormulaParser(TokenCursor):
    """Reads formulas: leaves, negations and parentheses, joined by connectives."""

    precedence: ClassVar[Mapping[str, int]] = {"OR": 1, "AND": 2}
    """How tightly each connective binds. Those of equal precedence associate to the left."""

    conjunction: ClassVar[str] = "AND"
    negation: ClassVar[str] = "NOT"
    comparison_example: ClassVar[str] = "UserAge < 18"

    def formula(self, lowest: int = 1) -> Formula:
        """The longest formula at hand whose connectives have at least the precedence `lowest`."""
        first = self.at
        formula = self.operand()
        while (level := self.precedence.get(connective := self.kinds[self.at], 0)) >= lowest:
            operands = [formula]
            while self.kinds[self.at] == connective:
                self.at += 1
                operands.append(self.formula(level + 1))
            formula = self.join(And if connective == self.conjunction else Or, operands, self.span(first))
        return formula

    def join(self, kind: type[And] | type[Or], operands: list[Formula], span: Span) -> Formula:
        return kind(tuple(operands), span)

    def operand(self) -> Formula:
        """A negation, a formula in parentheses, or a leaf."""
        first = self.at
        kind = self.kinds[first]
        if kind == "(":
            self.descend()
            self.at += 1
            formula = self.formula()
            self.close(")", first)
            self.depth -= 1
            if self.kinds[self.at] == "operator":
                self.fail(
                    "a comparison has a name or a number on each side, without parentheses",
                    self.token_span(self.at),
                    f"for example: {self.comparison_example}",
                )
            return formula
        if kind == self.negation:
            self.descend()
            self.at += 1
            operand = self.operand()
            self.depth -= 1
            return Not(operand, self.span(first))
        return self.leaf()

    def leaf(self) -> Formula:
        """A condition, a truth value or a comparison."""
        raise NotImplementedError
