"""Conditions: comparisons bind tightest, then `not`, then `and` and `or`, alike and from the left.

Measures may stand in braces or not, whatever the dialect.
"""

from __future__ import annotations

from sleec_runtime.errors import Problem
from sleec_runtime.language.common.comparisons import MAX_DIGITS, OPERATORS, Side
from sleec_runtime.language.common.problems import quoted
from sleec_runtime.language.common.tokens import Tokens
from sleec_runtime.language.dsl.calculations import Calculation, Operand
from sleec_runtime.language.dsl.comparisons import Terms
from sleec_runtime.language.dsl.keywords import KEYWORDS
from sleec_runtime.language.dsl.slips import COMPARING, before_measure
from sleec_runtime.language.dsl.token_cursor import Cursor
from sleec_runtime.model import And, Atom, Dialect, Formula, Not, Or, Source, Span, Truth

MAX_CALCULATION = 400
"""Tokens that one side of a comparison may have; printed with all parentheses it has some more."""


class FormulaParser(Cursor):
    """Reads conditions."""

    def __init__(self, source: Source, tokens: Tokens, dialect: Dialect, problems: list[Problem], names: Terms) -> None:
        super().__init__(source, tokens, dialect, problems)
        self.names = names
        self.names_events = True
        """Whether an event may be named where a condition stands: in rules and claims, and not in relations."""

    def formula(self) -> Formula:
        first = self.at
        formula = self._unary()
        operands = [formula]
        joined = ""
        while (kind := self.kinds[self.at]) in ("and", "or"):
            if joined and kind != joined:
                operands = [self._join(joined, operands, self.span(first))]
            joined = kind
            self.at += 1
            operands.append(self._unary())
        return self._join(joined, operands, self.span(first)) if joined else formula

    def _join(self, word: str, operands: list[Formula], span: Span) -> Formula:
        """A chain of one connective. LEGOS writes two operands at a time; nested to the right they are one chain."""
        kind = And if word == "and" else Or
        last = operands[-1]
        if self.dialect == "legos" and isinstance(last, kind):
            operands[-1:] = last.operands
        return kind(tuple(operands), span)

    def _unary(self) -> Formula:
        first = self.at
        if self.kinds[first] != "not":
            return self._primary()
        self.deeper()
        self.at += 1
        operand = self._unary()
        self.depth -= 1
        return Not(operand, self.span(first))

    def _primary(self) -> Formula:
        first = self.at
        kind = self.kinds[first]
        if kind == "(" and not self._opens_calculation():
            self.deeper()
            self.at += 1
            formula = self.formula()
            self.close(")", first)
            self.depth -= 1
            if self.kinds[self.at] == "operator":
                self.fail(
                    "a comparison has a name or a number on each side, without parentheses",
                    self.token_span(self.at),
                    "as in: ({riskLevel} > low)",
                )
            return formula
        if kind in ("true", "false"):
            self.at += 1
            return Truth(kind == "true", self.token_span(first))
        left = self.operand("a condition")
        if self.kinds[self.at] != "operator":
            if isinstance(left, Calculation) or not isinstance(left.written, str):
                self.expected("a comparison such as < or >= after the number", self._compared(left))
            self._refuse_plain_words(left)
            if self.names_events and not left.braced and self.names.kinds.get(left.written) == "event":
                return Atom("trigger", left.written, left.span)
            if not self.hurt:
                self.names.boolean(left.written, left.span)
            return Atom("condition", left.written, left.span)
        return self._comparison(first, left)

    def _refuse_plain_words(self, left: Side) -> None:
        """Gives up where a name is a keyword in capitals, or is a word before or behind a measure that says in plain
        words what an operator would: that it is no condition is not what is wrong."""
        self._refuse_capitals(left)
        name, kind, written = str(left.written), self.kinds[self.at], self.token_text(self.at)
        unknown = kind in ("strange", "digits", "number", ":") or (
            written.lower() in COMPARING and written not in self.names.kinds
        )
        if unknown and self.names.kinds.get(name) in ("measure", "constant"):
            self.expected("then and a response")
        hint = before_measure(name) if name not in self.names.kinds and kind == "word" else None
        if hint is not None:
            self.fail(f"expected a condition, but found {quoted(name)}", left.span, hint)

    def _refuse_capitals(self, side: Side) -> None:
        """Gives up where a name without a definition is a keyword in another case."""
        word = str(side.written)
        if word not in self.names.kinds and word not in KEYWORDS and word.lower() in KEYWORDS:
            said = f"{quoted(word)} is no keyword; did you mean {word.lower()}?"
            self.fail(said, side.span, "keywords are written in small letters")

    def _comparison(self, first: int, left: Operand) -> Formula:
        operator = OPERATORS[self.token_text(self.at)]
        self.at += 1
        if self.kinds[self.at] in ("true", "false"):
            return self._truth_of(first, left, operator)
        right = self.operand("a number or a name to compare with")
        if isinstance(right, Side):
            self._refuse_capitals(right)
        span = self.span(first)
        if self.kinds[self.at] == "operator":
            self.fail(
                "only two things are compared at a time",
                self.token_span(self.at),
                "write two comparisons with and between them",
            )
        found: Formula | None = None
        if not self.hurt:
            if isinstance(left, Side) and isinstance(right, Side):
                found = self.names.comparison(left, operator, right, span)
            else:
                found = self.names.calculated(left, operator, right, span)
        return found if found is not None else Truth(True, span)

    def _truth_of(self, first: int, left: Operand, operator: str) -> Formula:
        """``{measure} = true`` is the measure itself."""
        value = self.kinds[self.at] == "true"
        self.at += 1
        span = self.span(first)
        if not (isinstance(left, Side) and isinstance(left.written, str)):
            self.fail("a number is neither true nor false", span, self._compared(left))
        if not self.hurt:
            before = len(self.problems)
            self.names.boolean(left.written, left.span)
            self.hurt = len(self.problems) > before
        if operator not in ("=", "!="):
            self.fail("true and false have no order", span, f"write {left.written} alone, or not {left.written}")
        atom = Atom("condition", left.written, left.span)
        return atom if value == (operator == "=") else Not(atom, span)

    def _compared(self, number: Operand) -> str:
        """How to compare a number that stands where a condition must."""
        if isinstance(number, Side):
            return f"as in: {self.names.numeric_example()} > {number.written}"
        return f"as in: {self.text[number.span.start : number.span.end]} > 3"

    # Calculations ---------------------------------------------------------------------------------------------

    def _opens_calculation(self) -> bool:
        """Whether the parenthesis at hand holds a calculation, and not a condition."""
        depth, found = 0, False
        for at in range(self.at, min(self.at + 3 * MAX_CALCULATION, len(self.kinds))):
            kind = self.kinds[at]
            if kind in ("+", "-", "*"):
                found = True
            elif kind == "(":
                depth += 1
            elif kind == ")":
                depth -= 1
                if depth == 0:
                    return found or self.kinds[at + 1] in ("+", "-", "*")
            elif kind not in ("word", "number", "{", "}", "->"):
                return False
        return False

    def operand(self, what: str) -> Operand:
        """One side of a comparison, or a length of time: a name, a number, or a calculation with some."""
        first = self.at
        left = self._product(what)
        while (operator := self.kinds[self.at]) in ("+", "-"):
            self._operator(first)
            left = Calculation(operator, left, self._product("a number or a measure"), self.span(first))
        return left

    def _product(self, what: str) -> Operand:
        first = self.at
        left = self._factor(what)
        while self.kinds[self.at] == "*":
            self._operator(first)
            left = Calculation("*", left, self._factor("a number or a measure"), self.span(first))
        if self.kinds[self.at] == "strange" and self.token_text(self.at) == "/":
            message = "calculations have +, - and *, and nothing is divided"
            self.fail(message, self.token_span(self.at), "multiply the other side: ({x} > (2 * {y}))")
        return left

    def _operator(self, first: int) -> None:
        """Reads the `+`, `-` or `*` at hand, in a calculation that begins at token `first`."""
        self.at += 1
        if self.at - first > MAX_CALCULATION:
            message = f"this calculation is longer than {MAX_CALCULATION} words and signs"
            self.fail(message, self.span(first), "multiply out less, or compare parts of it")

    def _factor(self, what: str) -> Operand:
        first = self.at
        if self.kinds[first] != "(":
            return self._side(what)
        self.deeper()
        self.at += 1
        inner = self.operand(what)
        self.close(")", first)
        self.depth -= 1
        return inner

    def _side(self, what: str) -> Side:
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
            return Side(self.number(), self.span(first))
        if kind in ("and", "or", "then"):
            self.expected(what, f"something is missing before {kind}")
        return Side(self.name(what), self.span(first))

    def number(self) -> int:
        """Reads the whole number at hand."""
        first = self.at
        negative = self.accept("-")
        if self.kinds[self.at] != "number":
            self.expected("a number")
        text = self.token_text(self.at)
        self.at += 1
        if "." in text:
            self.fail(
                f"{quoted(text)} is no whole number",
                self.span(first),
                "count in a smaller unit, as in 90 seconds for 1.5 minutes",
            )
        if len(text) > MAX_DIGITS:
            self.fail(f"this number has more than {MAX_DIGITS} digits", self.span(first), "is a blank missing?")
        return -int(text) if negative else int(text)
