"""Parses assertions: ``never A and not B when condition``, ``always A``."""

from __future__ import annotations

import re
from array import array
from collections.abc import Collection, Iterator, Mapping
from fractions import Fraction
from typing import ClassVar, NoReturn

from sleec_runtime.errors import LanguageError, Problem
from sleec_runtime.language.common.comparisons import OPERATORS, Side, scale_text
from sleec_runtime.language.common.formula_parser import FormulaParser
from sleec_runtime.language.common.problems import quoted
from sleec_runtime.language.common.token_cursor import ClauseError
from sleec_runtime.language.common.tokens import Tokens
from sleec_runtime.model import (
    Atom,
    Comparison,
    Formula,
    MeasureRef,
    Number,
    Obligation,
    ScaleValue,
    Source,
    Span,
    Term,
    Truth,
)
from sleec_runtime.support.suggestions import did_you_mean, nearest
from sleec_verify.changes.assertions.assertion import Assertion
from sleec_verify.changes.assertions.vocabulary import Vocabulary

_TOKENS = re.compile(
    r"(?P<operator><=|>=|!=|<>|==|[<>=\u2264\u2265\u2260])|(?P<mark>[(),])"
    r"|(?P<number>[+-]?[0-9]{1,100}(?:\.[0-9]{1,100})?)(?![\w.])|(?P<word>[^\s()<>=!,\u2264\u2265\u2260]+)|(?P<other>\S)"
)
_KEYWORDS = frozenset({"never", "always", "and", "or", "not", "when", "true", "false"})
_EXAMPLE = "for example: never RefuseRequest when MedicalEmergency"


def parse_assertion(text: str, known: Vocabulary, path: str = "--assert") -> Assertion:
    """The assertion in `text`, over the names of `known`.

    Raises:
        LanguageError: it is not an assertion.
    """
    source = Source(path, text)
    problems: list[Problem] = []
    assertion = _parse(source, Span(0, len(text)), known, problems)
    if assertion is None:
        raise LanguageError(source, problems)
    return assertion


def parse_assertions(source: Source, known: Vocabulary) -> list[Assertion]:
    """The assertions of a text, one per line; ``#`` starts a comment.

    Raises:
        LanguageError: with the problem of each line that is not an assertion.
    """
    found: list[Assertion] = []
    problems: list[Problem] = []
    start = 0
    for line in source.text.splitlines(keepends=True):
        content = line.partition("#")[0]
        if content.strip():
            assertion = _parse(source, Span(start, start + len(content)), known, problems)
            if assertion is not None:
                found.append(assertion)
        start += len(line)
    if not found and not problems:
        problems = [Problem("this file contains no assertion", Span(0, 0), _EXAMPLE)]
    if problems:
        raise LanguageError(source, problems)
    return found


def _parse(source: Source, span: Span, known: Vocabulary, problems: list[Problem]) -> Assertion | None:
    text = source.text[span.start : span.end]
    end = span.start + len(text.rstrip())
    start = min(end, span.start + len(text) - len(text.lstrip()))
    try:
        return _AssertionParser(source, _scan(source.text, start, end), problems, known).assertion(Span(start, end))
    except ClauseError:
        return None


def _scan(text: str, start: int, end: int) -> Tokens:
    matches = list(_TOKENS.finditer(text, start, end))
    kinds = [_kind(match) for match in matches] + ["end"]
    starts = array("q", [*(match.start() for match in matches), end])
    ends = array("q", [*(match.end() for match in matches), end])
    return Tokens(text, kinds, starts, ends, {}, ())


def _kind(match: re.Match[str]) -> str:
    kind, text = str(match.lastgroup), match[0].lower()
    return text if kind == "mark" or (kind == "word" and text in _KEYWORDS) else kind


class _AssertionParser(FormulaParser):
    precedence: ClassVar[Mapping[str, int]] = {"or": 1, "and": 2}
    conjunction = "and"
    negation = "not"

    def __init__(self, source: Source, tokens: Tokens, problems: list[Problem], known: Vocabulary) -> None:
        super().__init__(source, tokens, problems)
        self._known = known
        self._values = {value for measure in known.measures.values() for value in measure.values}
        self._conditions = {*known.triggers, *known.conditions, *known.measures, *known.constants}

    def assertion(self, span: Span) -> Assertion:
        """The assertion that the tokens are; `span` is its span."""
        word = self.kinds[0]
        if word not in ("never", "always"):
            self._refuse("an assertion must begin with never or always", _EXAMPLE)
        self.at = 1
        literals = [self._obligation()]
        while self.kinds[self.at] in ("and", ","):
            self.at += 1
            literals.append(self._obligation())
        if self.kinds[self.at] == "or":
            self._refuse("obligations in an assertion can only be joined by and", "write one assertion for each")
        when: Formula = Truth(True)
        if self.kinds[self.at] == "when":
            self.at += 1
            when = self.formula()
            self._require_end("join conditions with and or or")
        self._require_end("write when and a condition after the obligations")
        return Assertion("never" if word == "never" else "always", tuple(literals), when, self.source, span)

    def expected(self, what: str, hint: str | None = None) -> NoReturn:
        found = "the assertion ends here" if self.kinds[self.at] == "end" else f"found {self._shown()}"
        self._refuse(f"expected {what}, but {found}", hint)

    def _require_end(self, hint: str) -> None:
        if self.kinds[self.at] != "end":
            self._refuse(f"unexpected {self._shown()}", hint)

    def _obligation(self) -> Obligation:
        known = self._known.obligations
        negated = self.kinds[self.at] == "not" and self._name_at_hand(known) is None
        if negated:
            self.at += 1
        name = self._name_at_hand(known)
        if name is None:
            self._refuse_name("an obligation", known, "write what the robot must or must not do")
        self.at += name.count(" ") + 1
        return Obligation(name, negated)

    # Formulas -------------------------------------------------------------------------------------------------

    def operand(self) -> Formula:
        # A name may contain a keyword.
        return super().operand() if self._name_at_hand(self._conditions) is None else self.leaf()

    def leaf(self) -> Formula:
        name = self._name_at_hand(self._conditions)
        if name is None and self.kinds[self.at] in ("true", "false"):
            self.at += 1
            return Truth(self.kinds[self.at - 1] == "true")
        words = 1 if name is None else name.count(" ") + 1
        if self.kinds[self.at] == "number" or self.kinds[min(self.at + words, len(self.kinds) - 1)] == "operator":
            return self._comparison()
        if name is None:
            self._refuse_name("a trigger, condition or measure", self._conditions, "write in which situations")
        known = self._known
        if name in known.triggers or name in known.conditions:
            self.at += words
            return Atom("trigger" if name in known.triggers else "condition", name)
        if name in known.measures:
            value = (18, *known.measures[name].values)[-1]
            self._refuse(f"{quoted(name)} is a measure, neither true nor false", f"compare it: {name} >= {value}")
        return self._refuse(
            f"{quoted(name)} is a constant", f"compare a measure with it, for example: UserAge < {name}"
        )

    def _comparison(self) -> Formula:
        first = self.at
        left = self._side()
        if self.kinds[self.at] != "operator":
            self._refuse("a comparison such as < or >= is missing after the number", "for example: 18 <= UserAge")
        operator = OPERATORS[self.token_text(self.at)]
        self.at += 1
        right = self._side()
        span = self.span(first)
        return Comparison(self._term(left, right, span), operator, self._term(right, left, span), span)

    def _side(self) -> Side:
        first = self.at
        if self.kinds[first] == "number":
            self.at += 1
            value = Fraction(self.token_text(first))
            return Side(int(value) if value.denominator == 1 else value, self.span(first))
        names = {*self._known.measures, *self._known.constants}
        name = self._name_at_hand(names | self._values)
        if name is None:
            self._refuse_name("a measure, a constant or a value of a scale", names, _EXAMPLE)
        self.at += name.count(" ") + 1
        return Side(name, self.span(first))

    def _term(self, side: Side, opposite: Side, span: Span) -> Term:
        name, other = side.written, opposite.written
        measures = self._known.measures
        against = measures.get(other) if isinstance(other, str) else None
        if not isinstance(name, str):
            if against is None or against.kind == "scale":
                hint = "for example: UserAge < 18" if against is None else f"its values are {scale_text(against)}"
                self.fail(f"{quoted(str(other))} cannot be compared with a number", span, hint)
            return Number(name)
        if against is not None and name in against.values:
            return ScaleValue(name, against.values.index(name))
        measure = measures.get(name)
        if measure is not None:
            if against is not None and measure.values != against.values:
                self.fail(f"{quoted(name)} and {quoted(str(other))} have different scales", span, None)
            if against is None and measure.kind == "scale" and other not in measure.values:
                message = f"{quoted(str(other))} is not a value of {quoted(name)}"
                self.fail(message, span, f"its values are {scale_text(measure)}")
            return MeasureRef(name)
        if name in self._known.constants and against is not None and against.kind != "scale":
            return Number(self._known.constants[name], name)
        message = f"{quoted(name)} and {quoted(str(other))} cannot be compared"
        return self.fail(message, span, "compare a measure with a number or one of its values")

    # Names ----------------------------------------------------------------------------------------------------

    def _words(self) -> Iterator[int]:
        """The tokens at hand that may be words of a name."""
        at = self.at
        while self.kinds[at] in ("word", "number") or self.kinds[at] in _KEYWORDS:
            yield at
            at += 1

    def _name_at_hand(self, names: Collection[str]) -> str | None:
        """The longest of `names` at hand, word by word."""
        words = [self.token_text(token) for token in self._words()]
        found = [name for name in names if name.split(" ") == words[: name.count(" ") + 1]]
        return max(found, key=len, default=None)

    def _refuse_name(self, what: str, names: Collection[str], hint_if_missing: str) -> NoReturn:
        first = self.at
        for token in self._words():
            if self.kinds[token] in ("and", "or", "not", "when"):
                break
            self.at = token + 1
        if self.at == first:
            self._refuse(f"{what} is missing here", hint_if_missing)
        name, span = self.joined_name(first, self.at), self.span(first)
        known = self._known
        kinds: dict[str, Collection[str]] = {
            "an obligation": known.obligations,
            "a trigger": known.triggers,
            "a condition": known.conditions,
            "a measure": known.measures,
        }
        for kind, others in kinds.items():
            if name in others:
                hint = "write obligations after never and always; triggers, conditions and measures after when"
                self.fail(f"{quoted(name)} is {kind}, but {what} is needed here", span, hint)
        shown = sorted(names)
        listed = f"the rules have {', '.join(shown[:8])}{', …' if len(shown) > 8 else ''}" if shown else None
        hint = did_you_mean(nearest(name, shown)) or listed or "the rules have none"
        self.fail(f"{quoted(name)} is not in the rules", span, hint)

    def _refuse(self, message: str, hint: str | None) -> NoReturn:
        self.fail(message, self.token_span(self.at), hint)

    def _shown(self) -> str:
        return quoted(self.token_text(self.at))
