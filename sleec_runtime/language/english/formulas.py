"""Conditions: OR binds loosest, then AND, then NOT; comparisons bind tightest."""

from __future__ import annotations

import re
from typing import NoReturn

from sleec_runtime.errors import Problem
from sleec_runtime.language.common.comparisons import MAX_DIGITS, OPERATORS, Side
from sleec_runtime.language.common.problems import quoted
from sleec_runtime.language.common.tokens import Tokens
from sleec_runtime.language.english.comparisons import EnglishComparisons
from sleec_runtime.language.english.keywords import IN_WHICH_CASE, PHRASE, STATEMENTS
from sleec_runtime.language.english.name_resolution import EnglishNames
from sleec_runtime.language.english.worded_conditions import EnglishWordedConditionParser
from sleec_runtime.model import Atom, Formula, Rational, Source, Span, Truth

_DECIMAL_COMMA = re.compile(r"-?[0-9]+,[0-9]+")
_THOUSANDS = re.compile(r"-?[1-9][0-9]{0,2},[0-9]{3}")
_BOOLEAN_HINT = "a condition is true or false by itself: write its name alone, or NOT and its name"


class EnglishConditionParser(EnglishWordedConditionParser):
    """Reads conditions. `resolve` makes an atom of a name; what a name means depends on the statement."""

    def __init__(self, source: Source, tokens: Tokens, problems: list[Problem], names: EnglishNames) -> None:
        super().__init__(source, tokens, problems)
        self.names = names
        self.compare = EnglishComparisons(names).comparison
        self.resolve = names.condition

    def leaf(self) -> Formula:
        first = self.at
        kind = self.kinds[first]
        if kind == "word":
            return self._named(first)
        if kind == "digits" and self.kinds[first + 1] == "operator":
            self._refuse_number(first, first)
        if kind in ("dotted", "digits"):
            self.refuse_name("a condition", None)
        if kind != "number":
            self.expected("a condition", self._hint_at_condition(kind))
        return self._comparison(first, Side(self.number(), self.token_span(first)))

    def _named(self, first: int) -> Formula:
        if self.text[self.starts[first] : self.ends[first]].casefold() in ("true", "false"):
            truth = self._truth(first)
            if truth is not None:
                return truth
        if self.kinds[first + 1] in PHRASE:
            worded = self.worded_condition(first)
            if worded is not None:
                return worded
        name = self.name("a condition")
        if not name:
            return self.operand()
        span = Span(self.starts[first], self.ends[self.at - 1])
        if self.kinds[self.at] == "operator":
            return self._comparison(first, Side(name, span))
        if self.has_failed:
            return Atom("condition", name, span)
        return self.resolve(name, span)

    def _truth(self, token: int) -> Truth | None:
        """``true`` or ``false``, unless a phrase begins with it."""
        if self.kinds[token + 1] in PHRASE:
            return None
        word = self.token_text(token)
        if word not in ("true", "false"):
            message = f"{quoted(word)} is not a keyword; did you mean `{word.casefold()}`?"
            self.problem(message, self.token_span(token), "write true and false in lowercase")
        if self.kinds[token + 1] == "operator":
            self.fail(
                f"`{word}` cannot be compared",
                self.token_span(token),
                _BOOLEAN_HINT,
            )
        self.at += 1
        return Truth(word.casefold() == "true", self.token_span(token))

    def _comparison(self, first: int, left: Side) -> Formula:
        if self.kinds[self.at] != "operator":
            self.expected(
                "a comparison such as < or >= after the number", "compare a number with a measure: 3 <= UserAge"
            )
        operator = OPERATORS[self.token_text(self.at)]
        self.at += 1
        right = self.side("a number or a name to compare with", "for example: UserAge < 18")
        span = self.span(first)
        if self.kinds[self.at] == "operator":
            self.fail(
                "a comparison has two sides, not more",
                self.token_span(self.at),
                "join two comparisons with AND: 18 <= UserAge AND UserAge < 65",
            )
        if self.has_failed:
            return Truth(True, span)
        return self.compare(left, operator, right, span)

    def side(self, what: str, hint: str) -> Side:
        first = self.at
        if self.kinds[first] == "number":
            value = self.number()
            if self.kinds[self.at] in ("word", "digits"):
                self.fail(
                    f"unexpected {self.found(self.at)} after the number",
                    self.token_span(self.at),
                    "put the unit in the measure's name; or is a keyword missing?",
                )
            return Side(value, self.token_span(first))
        if self.kinds[first] == "digits":
            self._refuse_number(first, first)
        if self.kinds[first] == "word" and self.token_text(first).casefold() in ("true", "false"):
            self.fail(
                f"nothing can be compared with {self.found(first)}",
                self.token_span(first),
                _BOOLEAN_HINT,
            )
        name = self.name(what, hint) or self.expected(what, hint)
        return Side(name, self.span(first))

    def number(self) -> Rational:
        """Reads the number at hand, exactly as it is written."""
        token = self.at
        self.at += 1
        text = self.token_text(token)
        if self.kinds[self.at] in (",", ".") and self._goes_on(token) and self._goes_on(self.at):
            self._refuse_number(token, self.at + 1)
        if len(text) > MAX_DIGITS:
            self.fail(f"this number has more than {MAX_DIGITS} digits", self.token_span(token), "is a space missing?")
        if "." not in text:
            return int(text)
        from fractions import Fraction

        value = Fraction(text)
        return int(value) if value.denominator == 1 else value

    def _goes_on(self, token: int) -> bool:
        """Whether the next token follows this one without a space and may be a part of the same number."""
        return self.ends[token] == self.starts[token + 1] and self.kinds[token + 1] in (",", ".", "number", "digits")

    def _refuse_number(self, first: int, last: int) -> NoReturn:
        """Gives up because these tokens are a number in another notation: 1,5 and 1e5 and 1_000 and 18years."""
        span = Span(self.starts[first], self.ends[last])
        written = self.text[span.start : span.end]
        if _DECIMAL_COMMA.fullmatch(written) and len(written) <= MAX_DIGITS:
            decimal = written.replace(",", ".")
            three = f", or {written.replace(',', '')}" if _THOUSANDS.fullmatch(written) else ""
            self.fail(f"unexpected comma in the number {quoted(written)}", span, f"write {decimal}{three}")
        self.fail(
            f"{quoted(written)} is not a number",
            span,
            "write digits, and a decimal point if needed: 18, 100000 or 36.6",
        )

    def _hint_at_condition(self, kind: str) -> str | None:
        if kind in ("AND", "OR"):
            return f"write a condition on both sides of {kind}"
        if kind == "operator":
            return "a comparison has a name or a number on its left: UserAge < 18"
        if kind == ")":
            return "the parentheses are empty, or a condition is missing before the closing one"
        if kind == IN_WHICH_CASE or kind == "end" or kind in STATEMENTS:
            return "say when this applies, for example: UNLESS UserUndressed"
        return None
