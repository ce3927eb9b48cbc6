"""Longer random sequences of edits, and edits of the rulesets of people."""

from __future__ import annotations

from collections.abc import Iterator
from random import Random

import pytest

from sleec_runtime.language import parse
from tests.support.incremental import assert_equal_to_whole_checks
from tests.support.paths import ROOT
from tests.support.text_edits import edited_texts

RULESETS = ("hospital-ward", "household", "medication-round", "studies/greenhouse", "studies/parcel-drone-revised")


@pytest.mark.slow
@pytest.mark.parametrize("timed", [False, True])
@pytest.mark.parametrize("first", [100, 120])
def test_random_edits(first: int, timed: bool) -> None:
    for seed in range(first, first + (5 if timed else 20)):
        assert_equal_to_whole_checks(edited_texts(seed, edits=4, timed=timed))


@pytest.mark.parametrize("name", RULESETS)
def test_edits_of_rulesets_of_people(name: str) -> None:
    text = (ROOT / "rulesets" / f"{name}.sleec").read_text(encoding="utf-8")
    assert_equal_to_whole_checks(_edited(text, Random(name)))


def _edited(text: str, random: Random) -> Iterator[str]:
    """The text, and the text after each of some edits: a rule disappears, gets other words, or comes back."""
    yield text
    for _ in range(2):
        rule = random.choice(parse(text).rules)
        start, end = rule.span
        other = random.choice(parse(text).rules)
        words = text[start:end]
        yield f"{text[:start]}{text[end:]}"
        yield f"{text[:start]}{words.replace(rule.trigger, other.trigger)}{text[end:]}"
        yield text
