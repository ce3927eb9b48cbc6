"""Reads sentences of FRETish, and evaluates them by FRET's formalization in future-time metric temporal logic.

The grammar is that of FRET (`Requirement.g4`), for sentences without a scope. The formalization is the one for infinite
traces (`formalizations_future.js`; D. Giannakopoulou, T. Pressburger, A. Mavridou, J. Schumann, "Automated
formalization of structured natural language requirements", Information and Software Technology 137, 2021): a sentence
with the condition C and the timing T is `G (C -> T)`.
"""

from __future__ import annotations

import operator
import re
from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from typing import Any

Signals = Mapping[str, Any]
"""The value of each name at one time point."""
Evaluation = Callable[[int], Any]
"""The value of an expression at a time point."""

SENTENCE = re.compile(
    r"(?:Whenever (?P<condition>.+) the|The) robot shall (?P<timing>immediately|eventually|always|within \d+ seconds?|"
    r"for \d+ seconds?|until .+) satisfy (?P<response>.+)"
)
TOKEN = re.compile(r"\s*(->|<=|>=|!=|[-+*/()!&|<>=,]|[a-zA-Z][a-zA-Z0-9_]*|\d+)")
COMPARISONS: Mapping[str, Callable[[Any, Any], Any]] = {
    "<": operator.lt,
    "<=": operator.le,
    "=": operator.eq,
    "!=": operator.ne,
    ">=": operator.ge,
    ">": operator.gt,
}


def satisfied(sentence: str, points: Sequence[Signals]) -> bool:
    """Whether a trace satisfies a sentence. Nothing that matters follows after the last of `points`."""
    match = SENTENCE.fullmatch(sentence)
    assert match is not None, sentence
    condition = Reader(match["condition"] or "true", points).read()
    holds = _timing(match["timing"], Reader(match["response"], points).read(), points)
    return all(holds(at) for at in range(len(points)) if condition(at))


def _timing(text: str, response: Evaluation, points: Sequence[Signals]) -> Evaluation:
    word, _, rest = text.partition(" ")
    end = len(points)
    if word == "immediately":
        return response
    if word == "eventually":
        return lambda at: any(response(n) for n in range(at, end))
    if word == "always":
        return lambda at: all(response(n) for n in range(at, end))
    if word == "until":
        # Weak, and without the point of the stop condition.
        stop = Reader(rest, points).read()
        return lambda at: all(response(n) or any(stop(m) for m in range(at, n + 1)) for n in range(at, end))
    duration = int(rest.split()[0])
    every = all if word == "for" else any
    return lambda at: every(response(n) for n in range(at, min(at + duration + 1, end)))


class Reader:
    """Recursive descent over one Boolean expression."""

    token = TOKEN

    def __init__(self, text: str, points: Sequence[Signals]) -> None:
        self.points = points
        self.tokens: list[str] = [*self.token.findall(text), ""]
        assert "".join(self.tokens) == text.replace(" ", ""), text
        self.at = 0

    def read(self) -> Evaluation:
        found = self.implication()
        assert self.tokens[self.at] == "", self.tokens
        return found

    def take(self, token: str) -> bool:
        if self.tokens[self.at] != token:
            return False
        self.at += 1
        return True

    def next(self) -> str:
        self.at += 1
        return self.tokens[self.at - 1]

    def implication(self) -> Evaluation:
        left = self.disjunction()
        if self.take("->"):
            right = self.implication()
            return lambda t: not left(t) or right(t)
        return left

    def disjunction(self) -> Evaluation:
        parts = [self.conjunction()]
        while self.take("|"):
            parts.append(self.conjunction())
        return parts[0] if len(parts) == 1 else lambda t: any(part(t) for part in parts)

    def conjunction(self) -> Evaluation:
        parts = [self.comparison()]
        while self.take("&"):
            parts.append(self.comparison())
        return parts[0] if len(parts) == 1 else lambda t: all(part(t) for part in parts)

    def comparison(self) -> Evaluation:
        left = self.sum()
        if self.tokens[self.at] not in COMPARISONS:
            return left
        operation = COMPARISONS[self.next()]
        return _combined(left, self.sum(), operation)

    def sum(self) -> Evaluation:
        left = self.product()
        while self.tokens[self.at] in ("+", "-"):
            token, right = self.next(), self.product()
            left = _combined(left, right, operator.add if token == "+" else operator.sub)
        return left

    def product(self) -> Evaluation:
        left = self.primary()
        while self.tokens[self.at] in ("*", "/"):
            token, right = self.next(), self.primary()
            left = _combined(left, right, operator.mul if token == "*" else operator.truediv)
        return left

    def primary(self) -> Evaluation:
        token = self.next()
        if token == "!":
            operand = self.primary()
            return lambda t: not operand(t)
        if token == "-":
            number = self.primary()
            return lambda t: -number(t)
        if token == "(":
            found = self.implication()
            assert self.take(")")
            return found
        if token in ("occurs", "persists"):
            return self.predicate(token)
        if token.isdigit():
            return lambda t: Fraction(token)
        if token in ("true", "false"):
            return lambda t: token == "true"
        assert token[0].isalpha(), token
        return lambda t: self.points[t][token]

    def predicate(self, word: str) -> Evaluation:
        assert self.take("(")
        last = int(self.next())
        assert self.take(",")
        inner = self.implication()
        assert self.take(")")
        every = any if word == "occurs" else all
        return lambda t: every(inner(n) for n in range(t, min(t + last + 1, len(self.points))))


def _combined(left: Evaluation, right: Evaluation, operation: Callable[[Any, Any], Any]) -> Evaluation:
    return lambda t: operation(left(t), right(t))
