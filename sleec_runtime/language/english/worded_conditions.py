"""Conditions in plain words: comparisons with a declared measure, and negations of a condition that the text has too.

``age is at least 18`` is ``age >= 18`` if `age` is declared as a measure. ``it is not night`` is ``NOT it is night`` if
the text also has the condition ``it is night``. Any other phrase is a name.
"""

from __future__ import annotations

import re
from collections.abc import Callable

from sleec_runtime.language.common.comparisons import Side
from sleec_runtime.language.common.formula_parser import FormulaParser
from sleec_runtime.language.common.token_cursor import composed
from sleec_runtime.language.english.comparison_words import comparison_words
from sleec_runtime.language.english.keywords import PHRASE, STATEMENTS
from sleec_runtime.language.english.name_resolution import EnglishNames
from sleec_runtime.language.english.negations import CONTRACTIONS, negation
from sleec_runtime.language.english.phrases import EnglishPhraseParser
from sleec_runtime.model import And, Atom, Comparison, Formula, Not, Operator, Rational, Span, Truth

_NEGATION = re.compile(r"not\b|n['\u2019]t\b", re.IGNORECASE)


class EnglishWordedConditionParser(EnglishPhraseParser, FormulaParser):
    """Reads phrases that state a comparison or a negation."""

    names: EnglishNames
    resolve: Callable[[str, Span], Atom]
    compare: Callable[[Side, Operator, Side, Span], Comparison]
    _measure_heads: set[str] | None = None

    def number(self) -> Rational:
        """Reads the number at hand."""
        raise NotImplementedError

    def worded_condition(self, first: int) -> Formula | None:
        """Reads the comparison or negation that the phrase at hand states; None if it is a name."""
        end = first
        while self.kinds[end] in PHRASE:
            end += 1
        is_negation = _NEGATION.search(self.text, self.starts[first], self.ends[end - 1]) is not None
        if not (is_negation or self._may_begin_with_measure(first)):
            return None
        if self.kinds[end] == "operator" or self.names.is_condition(self.joined_name(first, end)):
            return None
        words = [self.small_word(token) for token in range(first, end)]
        compared = self._worded_comparison(first, end, words)
        return compared or (self._negation(first, end, words) if is_negation else None)

    def _may_begin_with_measure(self, first: int) -> bool:
        if self._measure_heads is None:
            self._measure_heads = {name.split()[0] for name in self.names.measures}
        heads = [first, first + 1] if self.small_word(first) == "the" else [first]
        return any(composed(self.token_text(token)) in self._measure_heads for token in heads)

    # Comparisons ----------------------------------------------------------------------------------------------

    def _worded_comparison(self, first: int, end: int, words: list[str]) -> Formula | None:
        """The comparison in the phrase from `first` to before `end`, if it begins with a declared measure."""
        behind = self._end_of_measure(first, end)
        if behind is None and words[0] == "the":
            first, words = first + 1, words[1:]
            behind = self._end_of_measure(first, end)
        if behind is None:
            return None
        name = self.joined_name(first, behind)
        found = comparison_words(words[behind - first :], lasting=self._is_whole_assumption(first, end))
        if found is None:
            return None
        at = behind + found.words
        left = Side(name, Span(self.starts[first], self.ends[behind - 1]))
        if found.relation != "between":
            return self._compared(left, found.relation, at, end) if self._is_value(name, at, end) else None
        for middle in range(at + 1, end - 1):
            if (
                words[middle - first] == "and"
                and self._is_value(name, at, middle)
                and self._is_value(name, middle + 1, end)
            ):
                self.descend()
                bounds = self._compared(left, ">=", at, middle), self._compared(left, "<=", middle + 1, end)
                self.depth -= 1
                return And(bounds, self.span(first))
        return None

    def _is_whole_assumption(self, first: int, end: int) -> bool:
        """Whether the phrase from `first` to before `end` is all that an ASSUME says, with or without parentheses."""
        before = first - 1
        while self.kinds[before] == "(" or self.small_word(before) == "the":
            before -= 1
        while self.kinds[end] == ")":
            end += 1
        return self.kinds[before] == "ASSUME" and (self.kinds[end] in STATEMENTS or self.kinds[end] in (".", "end"))

    def _end_of_measure(self, first: int, end: int) -> int | None:
        """The end of the longest name of a measure with which the phrase begins and does not end."""
        ends = (at for at in range(end - 1, first, -1) if self.joined_name(first, at) in self.names.measures)
        return next(ends, None)

    def _is_value(self, measure: str, first: int, end: int) -> bool:
        """Whether these tokens are a number, a constant, a measure, or nearly a value of the scale of `measure`."""
        if end - first == 1 and self.kinds[first] == "number":
            return True
        if end == first or self.kinds[first] != "word":
            return False
        name = self.joined_name(first, end)
        values = self.names.measures[measure].values
        return self.names.has_amount(name) or name in values or self.names.nearest(name, values) is not None

    def _compared(self, left: Side, operator: Operator, first: int, end: int) -> Formula:
        """The comparison of `left` with the value from `first` to before `end`."""
        self.at = first
        value = self.number() if self.kinds[first] == "number" else self.joined_name(first, end)
        self.at = end
        right = Side(value, self.span(first))
        span = Span(left.span.start, right.span.end)
        return Truth(True, span) if self.has_failed else self.compare(left, operator, right, span)

    # Negations ------------------------------------------------------------------------------------------------

    def _negation(self, first: int, end: int, words: list[str]) -> Formula | None:
        """The negation that the phrase from `first` to before `end` states, if the text has the positive phrase."""
        positive = _positive(words, [self.token_text(token) for token in range(first, end)])
        if positive is None or composed(positive) not in self.positions.conditions:
            return None
        self.descend()
        self.depth -= 1
        self.at = end
        span = self.span(first)
        return Not(self.resolve(composed(positive), span), span)


def _positive(small: list[str], words: list[str]) -> str | None:
    """The phrase without its negation; None if it has none that is certain."""
    at = negation(small)
    if at is None:
        return None
    return " ".join([*words[:at], *filter(None, [CONTRACTIONS.get(small[at])]), *words[at + 1 :]])
