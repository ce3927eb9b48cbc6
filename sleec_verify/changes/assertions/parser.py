"""Parses assertions."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from typing import NamedTuple, NoReturn

from sleec_runtime.errors import LanguageError, Problem
from sleec_runtime.language.common.comparisons import OPERATORS
from sleec_runtime.model import (
    And,
    Atom,
    Comparison,
    Formula,
    MeasureRef,
    Not,
    Number,
    Obligation,
    Or,
    Rational,
    ScaleValue,
    Source,
    Span,
    Term,
    Truth,
)
from sleec_verify.changes.assertions.assertion import Assertion
from sleec_verify.changes.assertions.vocabulary import Vocabulary


class _Token(NamedTuple):
    kind: str
    text: str
    span: Span


_TOKENS = re.compile(
    r"(?P<operator><=|>=|!=|<>|==|[<>=\u2264\u2265\u2260])|(?P<parenthesis>[()])|(?P<comma>,)"
    r"|(?P<number>[+-]?[0-9]{1,100}(?:\.[0-9]{1,100})?)(?![\w.])|(?P<word>[^\s()<>=!,\u2264\u2265\u2260]+)|(?P<other>\S)"
)
_JOINING = ("and", "or", "not", "when")
_EXAMPLE = "as in: never RefuseRequest when MedicalEmergency"
_DEEPEST = 200


def parse_assertion(text: str, known: Vocabulary, path: str = "--assert") -> Assertion:
    """The assertion that `text` says, over the names of `known`.

    Raises:
        LanguageError: it is none, with the place, what is wrong and what to try.
    """
    return _Reader(Source(path, text), Span(0, len(text)), known).assertion()


def parse_assertions(source: Source, known: Vocabulary) -> list[Assertion]:
    """The assertions of a text, one a line; ``#`` starts a comment.

    Raises:
        LanguageError: with the problem of each line that is none.
    """
    found: list[Assertion] = []
    problems: list[Problem] = []
    start = 0
    for line in source.text.splitlines(keepends=True):
        said = line.partition("#")[0]
        if said.strip():
            try:
                found.append(_Reader(source, Span(start, start + len(said)), known).assertion())
            except LanguageError as error:
                problems += error.problems
        start += len(line)
    if problems:
        raise LanguageError(source, problems)
    if not found:
        raise LanguageError(source, [Problem("there is no assertion in this file", Span(0, 0), _EXAMPLE)])
    return found


class _Reader:
    def __init__(self, source: Source, span: Span, known: Vocabulary) -> None:
        self._source = source
        self._known = known
        self._tokens = [
            _Token(str(match.lastgroup), match.group(), Span(*match.span()))
            for match in _TOKENS.finditer(source.text, span.start, span.end)
        ]
        text = source.text[span.start : span.end]
        end = span.start + len(text.rstrip())
        start = min(end, span.start + len(text) - len(text.lstrip()))
        self._span = Span(start, end)
        self._tokens.append(_Token("end", "", Span(end, end)))
        self._at = 0
        self._depth = 0

    # The assertion -----------------------------------------------------------------------------------------

    def assertion(self) -> Assertion:
        word = self._word()
        if word not in ("never", "always"):
            self._fail("an assertion begins with never or always", _EXAMPLE)
        self._at += 1
        literals = [self._obligation()]
        while self._word() == "and" or self._here.kind == "comma":
            self._at += 1
            literals.append(self._obligation())
        if self._word() == "or":
            self._fail("an assertion joins obligations with and only", "write an assertion for each of them")
        when: Formula = Truth(True)
        if self._here.kind != "end":
            if self._word() != "when":
                self._fail(f"{self._shown()} is unexpected here", "behind the obligations stands when, or nothing")
            self._at += 1
            when = self._formula()
            if self._here.kind != "end":
                self._fail(f"{self._shown()} is unexpected here", "join conditions with and or or")
        return Assertion("never" if word == "never" else "always", tuple(literals), when, self._source, self._span)

    def _obligation(self) -> Obligation:
        negated = self._word() == "not" and self._name_of(self._known.obligations) is None
        if negated:
            self._at += 1
        name = self._name_of(self._known.obligations)
        if name is None:
            self._unknown("an obligation", self._known.obligations, "name what is to be done")
        self._at += name.count(" ") + 1
        return Obligation(name, negated)

    # Formulas ----------------------------------------------------------------------------------------------

    def _formula(self) -> Formula:
        self._depth += 1
        if self._depth > _DEEPEST:
            self._fail(f"parentheses and nots are nested more than {_DEEPEST} deep", "say it in simpler words")
        operands = [self._conjunction()]
        while self._word() == "or":
            self._at += 1
            operands.append(self._conjunction())
        self._depth -= 1
        return operands[0] if len(operands) == 1 else Or(tuple(operands))

    def _conjunction(self) -> Formula:
        operands = [self._unary()]
        while self._word() == "and":
            self._at += 1
            operands.append(self._unary())
        return operands[0] if len(operands) == 1 else And(tuple(operands))

    def _unary(self) -> Formula:
        if self._here.text == "(":
            opened = self._here
            self._at += 1
            formula = self._formula()
            if self._here.text != ")":
                self._fail("this parenthesis is not closed", "put the closing one behind what belongs together", opened)
            self._at += 1
            return formula
        name = self._name_of(self._names())
        if name is None and self._word() == "not":
            self._at += 1
            self._depth += 1
            if self._depth > _DEEPEST:
                self._fail(f"parentheses and nots are nested more than {_DEEPEST} deep", "say it in simpler words")
            operand = self._unary()
            self._depth -= 1
            return Not(operand)
        if name is None and self._word() in ("true", "false"):
            self._at += 1
            return Truth(self._tokens[self._at - 1].text.lower() == "true")
        return self._leaf(name)

    def _leaf(self, name: str | None) -> Formula:
        words = 1 if name is None else name.count(" ") + 1
        follows = self._tokens[min(self._at + words, len(self._tokens) - 1)]
        if self._here.kind == "number" or follows.kind == "operator":
            return self._comparison()
        if name is None:
            self._unknown("a trigger, condition or measure", self._names(), "say in which situations")
        known = self._known
        if name in known.triggers or name in known.conditions:
            self._at += words
            return Atom("trigger" if name in known.triggers else "condition", name)
        if name in known.measures:
            value = (18, *known.measures[name].values)[-1]
            self._fail(f"{name} is a measure, neither true nor false", f"compare it: {name} >= {value}")
        return self._fail(f"{name} is a number by itself", f"compare a measure with it, as in: UserAge < {name}")

    def _comparison(self) -> Formula:
        first = self._at
        left = self._side()
        if self._here.kind != "operator":
            self._fail("a comparison such as < or >= is missing behind the number", "as in: 18 <= UserAge")
        operator = OPERATORS[self._here.text]
        self._at += 1
        right = self._side()
        span = Span(self._tokens[first].span.start, self._tokens[self._at - 1].span.end)
        return Comparison(self._term(left, right, span), operator, self._term(right, left, span), span)

    def _side(self) -> str | Rational:
        token = self._here
        if token.kind == "number":
            self._at += 1
            from fractions import Fraction

            value = Fraction(token.text)
            return int(value) if value.denominator == 1 else value
        known = self._known
        values = {value for measure in known.measures.values() for value in measure.values}
        name = self._name_of({*known.measures, *known.constants, *values})
        if name is None:
            self._unknown("a measure, a constant or a value of a scale", {*known.measures, *known.constants}, _EXAMPLE)
        self._at += name.count(" ") + 1
        return name

    def _term(self, side: str | Rational, other: str | Rational, span: Span) -> Term:
        opposite = self._known.measures.get(other) if isinstance(other, str) else None
        if not isinstance(side, str):
            if opposite is None or opposite.kind == "scale":
                hint = "as in: UserAge < 18" if opposite is None else f"its values are {' < '.join(opposite.values)}"
                self._fail(f"{other} is not compared with a number", hint, span=span)
            return Number(side)
        if opposite is not None and side in opposite.values:
            return ScaleValue(side, opposite.values.index(side))
        measure = self._known.measures.get(side)
        if measure is not None:
            if opposite is not None and measure.values != opposite.values:
                self._fail(f"{side} and {other} cannot be compared: they have different scales", None, span=span)
            if opposite is None and measure.kind == "scale" and other not in measure.values:
                self._fail(f"{other} is no value of {side}", f"its values are {' < '.join(measure.values)}", span=span)
            return MeasureRef(side)
        if side in self._known.constants and opposite is not None and opposite.kind != "scale":
            return Number(self._known.constants[side], side)
        return self._fail(f"{side} and {other} cannot be compared", "compare a measure with a number", span=span)

    # Tokens ------------------------------------------------------------------------------------------------

    @property
    def _here(self) -> _Token:
        return self._tokens[self._at]

    def _word(self) -> str | None:
        """The word at hand in small letters."""
        return self._here.text.lower() if self._here.kind == "word" else None

    def _names(self) -> set[str]:
        known = self._known
        return {*known.triggers, *known.conditions, *known.measures, *known.constants}

    def _words(self) -> Iterator[_Token]:
        at = self._at
        while self._tokens[at].kind in ("word", "number"):
            yield self._tokens[at]
            at += 1

    def _name_of(self, names: Iterable[str]) -> str | None:
        """The longest of `names` that stands here, word by word."""
        words = [token.text for token in self._words()]
        found = [name for name in names if name.split(" ") == words[: name.count(" ") + 1]]
        return max(found, key=len, default=None)

    def _unknown(self, what: str, names: Iterable[str], missing: str) -> NoReturn:
        words = []
        for token in self._words():
            if token.text.lower() in _JOINING:
                break
            words.append(token)
        if not words:
            self._fail(f"{what} is missing here", missing)
        name = " ".join(token.text for token in words)
        span = Span(words[0].span.start, words[-1].span.end)
        from sleec_runtime.support.suggestions import nearest

        known = self._known
        for kind, others in (
            ("an obligation", known.obligations),
            ("a trigger", known.triggers),
            ("a condition", known.conditions),
            ("a measure", set(known.measures)),
        ):
            if name in others:
                hint = "never and always speak of obligations, when of triggers, conditions and measures"
                self._fail(f"{name} is {kind}, and {what} is wanted here", hint, span=span)
        near = nearest(name, sorted(names))
        shown = sorted(names)
        listed = (
            f"there are {', '.join(shown[:8])}{', …' if len(shown) > 8 else ''}" if shown else "the rules have none"
        )
        self._fail(f"the rules do not know {name}", f"did you mean {near}?" if near else listed, span=span)

    def _shown(self) -> str:
        return self._here.text

    def _fail(self, message: str, hint: str | None, token: _Token | None = None, span: Span | None = None) -> NoReturn:
        where = span or (token or self._here).span
        raise LanguageError(self._source, [Problem(message, where, hint)])
