"""Conditions: OR binds loosest, then AND, then NOT; comparisons bind tightest."""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import NoReturn

from sleec_runtime.errors import Problem
from sleec_runtime.language.common.comparisons import MAX_DIGITS, OPERATORS, Side
from sleec_runtime.language.common.problems import quoted
from sleec_runtime.language.common.tokens import Tokens
from sleec_runtime.language.english.comparisons import Comparisons
from sleec_runtime.language.english.keywords import IN_WHICH_CASE, PHRASE, STATEMENTS
from sleec_runtime.language.english.name_resolution import Names
from sleec_runtime.language.english.token_cursor import Cursor
from sleec_runtime.model import And, Atom, Formula, Not, Or, Rational, Source, Span, Truth

_DECIMAL_COMMA = re.compile(r"-?[0-9]+,[0-9]+")
_THOUSANDS = re.compile(r"-?[1-9][0-9]{0,2},[0-9]{3}")

Leaf = Callable[[str, Span], Atom]
"""What a bare name stands for."""


class FormulaParser(Cursor):
    """Reads formulas. What a bare name becomes depends on the statement: it is `leaf` who says."""

    def __init__(self, source: Source, tokens: Tokens, problems: list[Problem], names: Names) -> None:
        super().__init__(source, tokens, problems)
        self.names = names
        self._compare = Comparisons(names).comparison
        self.leaf: Leaf = names.condition

    def formula(self) -> Formula:
        first = self.at
        formula = self._conjunction()
        if self.kinds[self.at] != "OR":
            return formula
        operands = [formula]
        while self.kinds[self.at] == "OR":
            self.at += 1
            operands.append(self._conjunction())
        return Or(tuple(operands), self.span(first))

    def _conjunction(self) -> Formula:
        first = self.at
        formula = self._unary()
        if self.kinds[self.at] != "AND":
            return formula
        operands = [formula]
        while self.kinds[self.at] == "AND":
            self.at += 1
            operands.append(self._unary())
        return And(tuple(operands), self.span(first))

    def _unary(self) -> Formula:
        first = self.at
        kind = self.kinds[first]
        if kind == "word":
            return self._leaf()
        if kind == "(":
            self.deeper()
            self.at += 1
            formula = self.formula()
            if self.kinds[self.at] != ")":
                self.missing_parenthesis(first)
            self.at += 1
            self.depth -= 1
            if self.kinds[self.at] == "operator":
                self.fail(
                    "a comparison has a name or a number on each side, without parentheses",
                    self.token_span(self.at),
                    "as in: UserAge < 18",
                )
            return formula
        if kind == "NOT":
            self.deeper()
            self.at += 1
            operand = self._unary()
            self.depth -= 1
            return Not(operand, self.span(first))
        if kind == "digits" and self.kinds[first + 1] == "operator":
            self._no_number(first, first)
        if kind in ("dotted", "digits"):
            self.no_name("a condition", None)
        if kind != "number":
            self.expected("a condition", self._hint_at_condition(kind))
        return self._comparison(first, Side(self.number(), self.token_span(first)))

    def _leaf(self) -> Formula:
        first = self.at
        if self.text[self.starts[first] : self.ends[first]].casefold() in ("true", "false"):
            truth = self._truth(first)
            if truth is not None:
                return truth
        name = self.name("a condition")
        if not name:
            return self._unary()
        span = Span(self.starts[first], self.ends[self.at - 1])
        if self.kinds[self.at] == "operator":
            return self._comparison(first, Side(name, span))
        if self.hurt:
            return Atom("condition", name, span)
        return self.leaf(name, span)

    def _truth(self, token: int) -> Truth | None:
        """``true`` or ``false``, if it stands alone; a phrase may begin with either word."""
        if self.kinds[token + 1] in PHRASE:
            return None
        word = self.token_text(token)
        if word not in ("true", "false"):
            self.problem(f"{word} is written in small letters: {word.casefold()}", self.token_span(token), None)
        if self.kinds[token + 1] == "operator":
            self.fail(
                f"{word} cannot be compared",
                self.token_span(token),
                "a condition is true or false by itself: write its name alone, or NOT and its name",
            )
        self.at += 1
        return Truth(word.casefold() == "true", self.token_span(token))

    def _comparison(self, first: int, left: Side) -> Formula:
        if self.kinds[self.at] != "operator":
            self.expected(
                "a comparison such as < or >= after the number", "a number is compared with a measure: 3 <= UserAge"
            )
        operator = OPERATORS[self.token_text(self.at)]
        self.at += 1
        right = self.side("a number or a name to compare with", "as in: UserAge < 18")
        span = self.span(first)
        if self.kinds[self.at] == "operator":
            self.fail(
                "only two things are compared at a time",
                self.token_span(self.at),
                "write two comparisons and AND between them: 18 <= UserAge AND UserAge < 65",
            )
        if self.hurt:
            return Truth(True, span)
        return self._compare(left, operator, right, span)

    def side(self, what: str, hint: str) -> Side:
        first = self.at
        if self.kinds[first] == "number":
            value = self.number()
            if self.kinds[self.at] in ("word", "digits"):
                self.fail(
                    f"unexpected {self.found(self.at)} after the number",
                    self.token_span(self.at),
                    "write the number alone, and put the unit in the measure's name; or is a keyword missing?",
                )
            return Side(value, self.token_span(first))
        if self.kinds[first] == "digits":
            self._no_number(first, first)
        if self.kinds[first] == "word" and self.token_text(first).casefold() in ("true", "false"):
            self.fail(
                f"{self.token_text(first)} is no value that something is compared with",
                self.token_span(first),
                "a condition is true or false by itself: write its name alone, or NOT and its name",
            )
        name = self.name(what, hint) or self.expected(what, hint)
        return Side(name, self.span(first))

    def number(self) -> Rational:
        """Reads the number at hand, exactly as it is written."""
        token = self.at
        self.at += 1
        text = self.token_text(token)
        if self.kinds[self.at] in (",", ".") and self._goes_on(token) and self._goes_on(self.at):
            self._no_number(token, self.at + 1)
        if len(text) > MAX_DIGITS:
            self.fail(f"this number has more than {MAX_DIGITS} digits", self.token_span(token), "is a blank missing?")
        if "." not in text:
            return int(text)
        from fractions import Fraction

        value = Fraction(text)
        return int(value) if value.denominator == 1 else value

    def _goes_on(self, token: int) -> bool:
        """Whether the next token follows this one without a blank, and both are parts of what looks like a number."""
        return self.ends[token] == self.starts[token + 1] and self.kinds[token + 1] in (",", ".", "number", "digits")

    def _no_number(self, first: int, last: int) -> NoReturn:
        """Gives up because these tokens are written as numbers are elsewhere: 1,5 and 1e5 and 1_000 and 18years."""
        span = Span(self.starts[first], self.ends[last])
        written = self.text[span.start : span.end]
        if _DECIMAL_COMMA.fullmatch(written) and len(written) <= MAX_DIGITS:
            decimal = written.replace(",", ".")
            three = f", or {written.replace(',', '')}" if _THOUSANDS.fullmatch(written) else ""
            self.fail(f"unexpected comma in the number {quoted(written)}", span, f"write {decimal}{three}")
        self.fail(
            f"{quoted(written)} is no number",
            span,
            "write a number with digits only and a point, as in 18, 100000 or 36.6",
        )

    def _hint_at_condition(self, kind: str) -> str | None:
        if kind in ("AND", "OR"):
            return f"{kind} stands between two conditions"
        if kind == "operator":
            return "a comparison has a name or a number on its left: UserAge < 18"
        if kind == ")":
            return "there is nothing in the parentheses, or a condition is missing before the closing one"
        if kind == IN_WHICH_CASE or kind == "end" or kind in STATEMENTS:
            return "say how things must be for this to apply, as in: UNLESS UserUndressed"
        return None
