"""Conditions: comparisons bind tightest, then `not`, then `and` and `or`, which have equal precedence.

Measures may be in braces or not, whatever the dialect.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

from sleec_runtime.errors import Problem
from sleec_runtime.language.common.comparisons import OPERATORS, Side
from sleec_runtime.language.common.formula_parser import FormulaParser
from sleec_runtime.language.common.problems import quoted
from sleec_runtime.language.common.tokens import Tokens
from sleec_runtime.language.dsl.calculations import Expression, Operand
from sleec_runtime.language.dsl.comparisons import DslComparisons
from sleec_runtime.language.dsl.keywords import KEYWORDS
from sleec_runtime.language.dsl.operands import DslOperandParser
from sleec_runtime.model import And, Atom, Dialect, Formula, Not, Or, Source, Span, Truth


class DslConditionParser(DslOperandParser, FormulaParser):
    """Reads conditions."""

    precedence: ClassVar[Mapping[str, int]] = {"and": 1, "or": 1}
    conjunction = "and"
    negation = "not"
    comparison_example = "({riskLevel} > low)"

    def __init__(
        self, source: Source, tokens: Tokens, dialect: Dialect, problems: list[Problem], names: DslComparisons
    ) -> None:
        super().__init__(source, tokens, dialect, problems)
        self.names = names
        self.allows_events = True
        """Whether a condition may name an event: in rules and claims, and not in relations."""

    def join(self, kind: type[And] | type[Or], operands: list[Formula], span: Span) -> Formula:
        """A chain of one connective. LEGOS writes two operands at a time; nested to the right they are one chain."""
        last = operands[-1]
        if self.dialect == "legos" and isinstance(last, kind):
            operands[-1:] = last.operands
        return kind(tuple(operands), span)

    def operand(self) -> Formula:
        if self.kinds[self.at] == "(" and self.opens_calculation():
            return self.leaf()
        return super().operand()

    def leaf(self) -> Formula:
        first = self.at
        kind = self.kinds[first]
        if kind in ("true", "false"):
            self.at += 1
            return Truth(kind == "true", self.token_span(first))
        left = self.calculation("a condition")
        if self.kinds[self.at] == "operator":
            return self._comparison(first, left)
        if isinstance(left, Expression) or not isinstance(left.written, str):
            self.expected("a comparison such as < or >= after the number", self._comparison_hint(left))
        self._refuse_keyword(left)
        if self.allows_events and not left.braced and self.names.kinds.get(left.written) == "event":
            return Atom("trigger", left.written, left.span)
        if not (self.has_failed or self.precedes_mistake()):
            self.names.boolean(left.written, left.span)
        return Atom("condition", left.written, left.span)

    def _refuse_keyword(self, side: Side) -> None:
        """Gives up where an undefined name is a keyword in another case."""
        word = str(side.written)
        if word not in self.names.kinds and word not in KEYWORDS and word.lower() in KEYWORDS:
            self.fail(
                f"{quoted(word)} is not a keyword; did you mean `{word.lower()}`?",
                side.span,
                "write keywords in lowercase",
            )

    def _comparison(self, first: int, left: Operand) -> Formula:
        operator = OPERATORS[self.token_text(self.at)]
        self.at += 1
        if self.kinds[self.at] in ("true", "false"):
            return self._boolean_comparison(first, left, operator)
        right = self.calculation("a number or a name to compare with")
        if isinstance(right, Side):
            self._refuse_keyword(right)
        span = self.span(first)
        if self.kinds[self.at] == "operator":
            self.fail(
                "a comparison has two sides, not more",
                self.token_span(self.at),
                "join two comparisons with and",
            )
        found: Formula | None = None
        if not self.has_failed:
            if isinstance(left, Side) and isinstance(right, Side):
                found = self.names.comparison(left, operator, right, span)
            else:
                found = self.names.calculated(left, operator, right, span)
        return found if found is not None else Truth(True, span)

    def _boolean_comparison(self, first: int, left: Operand, operator: str) -> Formula:
        """``{measure} = true`` is the measure itself."""
        value = self.kinds[self.at] == "true"
        self.at += 1
        span = self.span(first)
        if not (isinstance(left, Side) and isinstance(left.written, str)):
            self.fail("a number is neither true nor false", span, self._comparison_hint(left))
        if not self.has_failed:
            before = len(self.problems)
            self.names.boolean(left.written, left.span)
            self.has_failed = len(self.problems) > before
        if operator not in ("=", "!="):
            self.fail("true and false have no order", span, f"write {left.written} alone, or not {left.written}")
        atom = Atom("condition", left.written, left.span)
        return atom if value == (operator == "=") else Not(atom, span)

    def _comparison_hint(self, number: Operand) -> str:
        """How to compare a number that stands where a condition must."""
        if isinstance(number, Side):
            return f"for example: {self.names.numeric_example()} > {number.written}"
        return f"for example: {self.text[number.span.start : number.span.end]} > 3"
