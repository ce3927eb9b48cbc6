"""Comparisons in words: there is a text to write only if it says all that the words say."""

from __future__ import annotations

from time import process_time

import pytest

from sleec_runtime.language import parse
from sleec_verify.checks.misread_names import misreadings
from sleec_verify.encoding.name_uses import names_used
from tests.support.misread import COMPARISON, codes, corrected, misread

MEASURES = "MEASURE age: number\nMEASURE count: number\nMEASURE danger: low < mid < high\n"
RULE = "WHEN the bell rings THEN greet UNLESS {} IN WHICH CASE wave\n"

WRITTEN = [
    ("age isn't under 6", "age >= 6"),
    ("age isn\u2019t 6", "age != 6"),
    ("the child is not under 6", "age >= 6"),
    ("the child's age is under 6", "age < 6"),
    ("the child is under 6 years old", "age < 6"),
    ("a child of age under 6 is here", "age < 6"),
    ("the count is not more than 5", "count <= 5"),
]


@pytest.mark.parametrize(("written", "instead"), WRITTEN)
def test_a_comparison_that_says_all(written: str, instead: str) -> None:
    text = MEASURES + RULE.format(written)
    assert parse(corrected(text)).statements == parse(MEASURES + RULE.format(instead)).statements


MORE_WORDS = """
age is no longer under 6, nobody of age under 6 is here, age is hardly under 6, age is 7 or more, age is 6 at most,
age is 6 to 10, age is over 18 and under 65, danger is low or high, danger is not high enough, no child is under 6,
every child is under 6, it is not the case that age is under 6, the child or the user is under 6,
the child was under 6, the child has been under 6, the count had been 5, age is under 6 months,
the count is not never 5, the patient is not not exactly 18, danger is never not low, danger is not not high
"""
OTHER_WORDS = """
age is six, age does not exceed 6, age is neither 3 nor 4, age is no longer 6, age is not only 6, age is about 6, age 5,
age of 5, danger becomes high, danger is medium, danger is near, age is not between 3 and 5,
age is between 3 and 5 and it rains, the danger has been mid, danger might get high
"""


def phrases(text: str) -> list[str]:
    return [phrase.strip() for phrase in text.split(",")]


@pytest.mark.parametrize("written", phrases(MORE_WORDS) + phrases(OTHER_WORDS))
def test_words_beside_a_comparison_are_left_to_the_author(written: str) -> None:
    text = MEASURES + RULE.format(written)
    (finding,) = misread(text)
    assert finding.code == COMPARISON
    assert text[finding.span.start : finding.span.end] == written
    assert finding.help is not None
    assert "by an operator" in finding.help
    assert corrected(text) == text


@pytest.mark.parametrize("written", phrases(OTHER_WORDS))
def test_only_a_declared_measure_is_named(written: str) -> None:
    assert not codes(RULE.format(written).replace("5", "five").replace("6", "six"))
    assert not codes(f"{MEASURES}CONDITION {written}\n{RULE.format(written)}")


@pytest.mark.parametrize("written", ["the user has taken more than 3 tablets", "the user ate over 3 tablets"])
def test_a_measure_that_is_not_declared(written: str) -> None:
    text = RULE.format(written)
    (finding,) = misread(text)
    assert finding.code == COMPARISON
    assert finding.help is not None
    assert "MEASURE tablets: number" in finding.help
    assert corrected(text) == text


@pytest.mark.parametrize(
    "written",
    [
        "the temperature has not fallen below 20",
        "the noise is hardly above 5",
        "the child is 6 or 7",
        "all users are 6",
    ],
)
def test_words_that_deny_or_count_are_no_part_of_a_measure(written: str) -> None:
    text = RULE.format(written)
    (finding,) = misread(text)
    assert finding.code == COMPARISON
    assert finding.help is not None
    assert "MEASURE amount: number" in finding.help
    assert corrected(text) == text


@pytest.mark.parametrize("unit", ["metres away", "cm", "kg", "degrees", "months old"])
def test_a_number_of_other_units_is_no_age(unit: str) -> None:
    text = MEASURES + RULE.format(f"the child is under 6 {unit}")
    (finding,) = misread(text)
    assert finding.code == COMPARISON
    assert finding.help is not None
    assert "age" not in finding.help
    assert corrected(text) == text


@pytest.mark.parametrize("written", ["age is under 6", "danger becomes high", "the age 5"])
def test_an_obligation_is_not_a_comparison(written: str) -> None:
    text = f"{MEASURES}WHEN the bell rings THEN greet AND {written}\n"
    (finding,) = misread(text)
    assert finding.code == COMPARISON
    assert "is not a comparison" in finding.message
    assert corrected(text) == text


@pytest.mark.parametrize("written", ["the danger light is on", "the age group is large", "the danger zone is near"])
def test_a_word_of_a_measure_in_another_name(written: str) -> None:
    assert not codes(MEASURES + RULE.format(written))
    assert not codes(f"{MEASURES}WHEN the bell rings THEN report danger AND keep the count below 50 AND ask the age\n")


@pytest.mark.speed
def test_many_measures_take_linear_time() -> None:
    """Pairs of a measure and a condition would be a million."""
    names = [f"{chr(97 + at // 676)}{chr(97 + at // 26 % 26)}{chr(97 + at % 26)}q" for at in range(1000)]
    measures = "".join(f"MEASURE {name}: number\n" for name in names)
    rules = "".join(f"WHEN {name} rings THEN go UNLESS {name} < 3 AND the box {name} is open\n" for name in names)
    ruleset = parse(measures + rules)
    used = names_used(ruleset)
    started = process_time()
    assert not misreadings(ruleset, used)
    assert process_time() - started < 2
