"""Conditions that deny or exclude each other in words: with a text to write only if one of the two is always true."""

from __future__ import annotations

import pytest

from tests.support.misread import NEGATION, OPPOSITES, codes, corrected, misread

RULES = "WHEN the bell rings THEN go in UNLESS {} IN WHICH CASE knock\nWHEN a guest goes THEN stay UNLESS {}\n"

COMPLEMENTS = [
    ("the door is open", "the door is closed"),
    ("the user is asleep", "the user is awake"),
    ("somebody is here", "nobody is here"),
    ("someone is here", "nobody is here"),
    ("the user is dressed", "the user is undressed"),
]
CONTRARIES = [
    ("the cup is full", "the cup is empty"),
    ("the user is standing", "the user is sitting"),
    ("it is day", "it is night"),
    ("the user is happy", "the user is unhappy"),
    ("everybody is here", "nobody is here"),
]


@pytest.mark.parametrize(("one", "other"), COMPLEMENTS)
def test_one_of_two_complements_is_not_the_other(one: str, other: str) -> None:
    for first, second in ((one, other), (other, one)):
        text = RULES.format(first, second)
        (finding,) = misread(text)
        assert finding.code == OPPOSITES
        assert corrected(text) in (RULES.format(first, f"NOT {first}"), RULES.format(f"NOT {second}", second))


@pytest.mark.parametrize(("one", "other"), CONTRARIES)
def test_two_contraries_may_both_be_false(one: str, other: str) -> None:
    for text in (RULES.format(one, other), RULES.format(other, one)):
        (finding,) = misread(text)
        assert finding.code == OPPOSITES
        assert finding.help is not None
        assert "ASSUME NOT (" in finding.help
        assert "instead" not in finding.help
        assert corrected(text) == text


@pytest.mark.parametrize(
    ("one", "other"),
    [
        ("the light is not on", "the light is off"),
        ("the light isn't on", "the light is off"),
        ("the user is not awake", "the user is asleep"),
        ("the cup is not full", "the cup is empty"),
    ],
)
def test_a_negated_opposite(one: str, other: str) -> None:
    for text in (RULES.format(one, other), RULES.format(other, one)):
        (finding,) = misread(text)
        assert finding.code == NEGATION
        assert text[finding.span.start : finding.span.end] == one
        assert corrected(text) == text


@pytest.mark.parametrize("trigger", ["it is not night", "it isn't night"])
def test_a_trigger_that_denies_a_condition(trigger: str) -> None:
    text = f"WHEN {trigger} THEN open the curtains\nWHEN the bell rings THEN greet UNLESS it is night\n"
    (finding,) = misread(text)
    assert finding.code == NEGATION
    assert finding.help == "name an event, and write `AND NOT it is night` after it"
    assert corrected(text) == text
    assert not codes(f"TRIGGER {trigger}, the bell rings\n{text}")
