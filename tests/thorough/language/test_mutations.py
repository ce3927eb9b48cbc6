"""However a text is damaged, the answer is a ruleset or a list of problems, and soon."""

from __future__ import annotations

import time

import pytest
from hypothesis import given
from hypothesis import strategies as st

from sleec_runtime.errors import LanguageError, Problem
from sleec_runtime.language import parse, print_ruleset
from sleec_runtime.language.english.keywords import KEYWORDS, RELATION_WORDS
from sleec_runtime.model import Ruleset
from tests.support.paths import ROOT
from tests.support.strategies import rulesets

PAPER = (ROOT / "rulesets" / "household.sleec").read_text(encoding="utf-8")
PIECES = [
    *sorted(RELATION_WORDS),
    "BY",
    "TO",
    "5 minutes",
    "[",
    "]",
    *sorted(KEYWORDS),
    "(",
    ")",
    ",",
    ".",
    ":",
    "<",
    ">=",
    "=",
    "-3",
    "1.5",
    "true",
    "a",
    "CamelCase",
    "a.b",
    "é",
    "\n",
]


def parses_or_complains(text: str) -> None:
    start = time.process_time()
    ruleset: Ruleset | None = None
    problems: tuple[Problem, ...] = ()
    try:
        ruleset = parse(text)
    except LanguageError as error:
        problems = error.problems
        length = len(error.source.text)
    if ruleset is not None:
        assert parse(print_ruleset(ruleset)) == ruleset
    else:
        assert problems
    for problem in problems:
        assert 0 <= problem.span.start <= problem.span.end <= length
        assert len(problem.message) < 500
    assert time.process_time() - start < 5


@given(st.text(max_size=200))
def test_any_text(text: str) -> None:
    parses_or_complains(text)


@given(st.lists(st.sampled_from(PIECES), max_size=60).map(" ".join))
def test_any_sequence_of_tokens(text: str) -> None:
    parses_or_complains(text)


@st.composite
def mutations(draw: st.DrawFn, text: str) -> str:
    """`text` with up to five stretches deleted, doubled, swapped or replaced by a token."""
    for _ in range(draw(st.integers(1, 5))):
        start = draw(st.integers(0, len(text)))
        end = start + draw(st.integers(0, 12))
        piece = draw(st.one_of(st.just(""), st.sampled_from(PIECES), st.text(max_size=3), st.just(text[start:end] * 2)))
        text = text[:start] + piece + text[end:]
    return text


@given(mutations(PAPER))
def test_damaged_rules_of_the_paper(text: str) -> None:
    parses_or_complains(text)


@pytest.mark.slow
@given(st.data(), rulesets(max_rules=2, comments=True))
def test_damaged_rulesets(data: st.DataObject, ruleset: Ruleset) -> None:
    parses_or_complains(data.draw(mutations(print_ruleset(ruleset))))


@given(st.data())
def test_swapped_words(data: st.DataObject) -> None:
    words = PAPER.split(" ")
    one, other = (data.draw(st.integers(0, len(words) - 1)) for _ in range(2))
    words[one], words[other] = words[other], words[one]
    parses_or_complains(" ".join(words))


@pytest.mark.parametrize("keyword", sorted(KEYWORDS - {"IN", "OR", "IF"}))
def test_a_keyword_with_two_letters_swapped_is_named(keyword: str) -> None:
    slip = keyword[0] + keyword[2] + keyword[1] + keyword[3:] if keyword[1] != keyword[2] else keyword[:2] + keyword[3:]
    if keyword not in PAPER or slip in KEYWORDS:
        return
    with pytest.raises(LanguageError) as caught:
        parse(PAPER.replace(f"{keyword} ", f"{slip} ", 1))
    assert any(keyword in problem.message for problem in caught.value.problems), caught.value
