"""The sides of comparisons: numbers, names, and calculations with ``+``, ``-`` and ``*``."""

from __future__ import annotations

from sleec_runtime.language.common.comparisons import MAX_DIGITS, Side
from sleec_runtime.language.common.problems import quoted
from sleec_runtime.language.dsl.calculations import Expression, Operand
from sleec_runtime.language.dsl.token_cursor import DslCursor

MAX_CALCULATION = 400
"""The longest side of a comparison, in tokens. Printed with all parentheses it has some more."""

_OPERATORS = ("+", "-", "*")


class DslOperandParser(DslCursor):
    """Reads sides of comparisons."""

    def opens_calculation(self) -> bool:
        """Whether the parenthesis at hand holds a calculation, and not a condition."""
        depth, has_operator = 0, False
        for at in range(self.at, min(self.at + 3 * MAX_CALCULATION, len(self.kinds))):
            kind = self.kinds[at]
            if kind in _OPERATORS:
                has_operator = True
            elif kind == "(":
                depth += 1
            elif kind == ")":
                depth -= 1
                if depth == 0:
                    return has_operator or self.kinds[at + 1] in _OPERATORS
            elif kind not in ("word", "number", "{", "}", "->"):
                return False
        return False

    def calculation(self, what: str) -> Operand:
        """One side of a comparison, or an amount of time: a name, a number, or a calculation."""
        first = self.at
        left = self._product(what)
        while (operator := self.kinds[self.at]) in ("+", "-"):
            self._operator(first)
            left = Expression(operator, left, self._product("a number or a measure"), self.span(first))
        return left

    def _product(self, what: str) -> Operand:
        first = self.at
        left = self._factor(what)
        while self.kinds[self.at] == "*":
            self._operator(first)
            left = Expression("*", left, self._factor("a number or a measure"), self.span(first))
        if self.kinds[self.at] == "strange" and self.token_text(self.at) == "/":
            message = "a calculation cannot divide; it has +, - and * only"
            self.fail(message, self.token_span(self.at), "multiply the other side: ({x} > (2 * {y}))")
        return left

    def _operator(self, first: int) -> None:
        """Reads the `+`, `-` or `*` at hand, in a calculation that begins at token `first`."""
        self.at += 1
        if self.at - first > MAX_CALCULATION:
            message = f"this calculation has more than {MAX_CALCULATION} words and signs"
            self.fail(message, self.span(first), "simplify it, or compare parts of it")

    def _factor(self, what: str) -> Operand:
        first = self.at
        if self.kinds[first] != "(":
            return self.side(what)
        self.descend()
        self.at += 1
        inner = self.calculation(what)
        self.close(")", first)
        self.depth -= 1
        return inner

    def side(self, what: str) -> Side:
        """A number, or the name of a measure or constant."""
        first = self.at
        kind = self.kinds[first]
        if kind == "{":
            self.at += 1
            name = self.name("the name of a measure", "braces hold one measure: {riskLevel}")
            if self.kinds[self.at] in ("and", "or", "operator"):
                self.expected("a closing brace", f"braces hold one measure: {{{name}}} {self.token_text(self.at)} ...")
            self.close("}", first)
            return Side(name, self.span(first), True)
        if kind == "->":
            self.at += 1
            return Side(self.name("the name of a constant"), self.token_span(self.at - 1))
        if kind == "number" or kind == "-":
            return Side(self._whole_number(), self.span(first))
        if kind in ("and", "or", "then"):
            self.expected(what, f"something is missing before {kind}")
        return Side(self.name(what), self.span(first))

    def _whole_number(self) -> int:
        first = self.at
        negative = self.accept("-")
        if self.kinds[self.at] != "number":
            self.expected("a number")
        text = self.token_text(self.at)
        self.at += 1
        if "." in text:
            message = f"{quoted(text)} is not a whole number"
            self.fail(message, self.span(first), "use a smaller unit: 90 seconds, not 1.5 minutes")
        if len(text) > MAX_DIGITS:
            self.fail(f"this number has more than {MAX_DIGITS} digits", self.span(first), "is a space missing?")
        return -int(text) if negative else int(text)
