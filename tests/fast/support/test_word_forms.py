"""The words of names, and their stems."""

from __future__ import annotations

import pytest

from sleec_runtime.support.word_forms import singulars, stem, stems, stems_of_each, words_of_each

PORTER = """
caresses caress  caress caress  cats cat  ponies poni  ties ti  feed feed  agreed agre  plastered plaster  bled bled
motoring motor  sing sing  conflated conflat  troubled troubl  sized size  hopping hop  tanned tan  falling fall
hissing hiss  fizzed fizz  failing fail  filing file  happy happi  sky sky  probate probat  rate rate  cease ceas
controlled control  rolling roll
"""
"""Examples of the article (Porter 1980), after steps 1 and 5."""


@pytest.mark.parametrize(("word", "expected"), list(zip(PORTER.split()[::2], PORTER.split()[1::2])))
def test_stems_are_those_of_porter(word: str, expected: str) -> None:
    assert stem(word) == expected


@pytest.mark.parametrize(
    "names",
    [
        ("take a photo", "takes the photo", "Taking photos", "TakePhotos", "take_photo"),
        ("the child is here", "The children are here"),
        ("the nurse's coat", "the nurse\u2019s coat"),
    ],
)
def test_names_with_the_same_stems(names: tuple[str, ...]) -> None:
    assert len({stems(name) for name in names}) == 1


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("the user's DNR form 12", ("the", "user's", "dnr", "form", "12")),
        ("CallDNRTeam2Go", ("call", "dnr", "team", "2", "go")),
        ("user_is-asleep", ("user", "is", "asleep")),
        ("\u00d6ffneT\u00fcr", ("\u00f6ffne", "t\u00fcr")),
        ("\u7a93\u3092\u958b\u3051\u308b", ("\u7a93\u3092\u958b\u3051\u308b",)),
        ("_", ()),
    ],
)
def test_the_words_of_a_name(name: str, words: tuple[str, ...]) -> None:
    assert words_of_each([name]) == [words]


def test_many_names_are_treated_as_each_alone() -> None:
    names = ["the", "_", "take photos", "CallTheNurse", "", "a b c"]
    assert words_of_each(names) == [words for name in names for words in words_of_each([name])]
    assert stems_of_each(names)[0] == [stems(name) for name in names] == ["", "", "take photo", "call nurs", "", "b c"]


def test_plurals_are_not_other_forms_of_a_verb() -> None:
    assert singulars("the alarm rings") == singulars("alarm ring")
    assert singulars("the alarm rings") != singulars("the alarm ringing")


@pytest.mark.parametrize(
    ("one", "other"),
    [("take photo", "take photos"), ("call the lady", "call ladies"), ("a box", "boxes"), ("try", "tries")],
)
def test_singular_and_plural(one: str, other: str) -> None:
    assert singulars(one) == singulars(other)


@pytest.mark.parametrize(
    ("one", "other"), [("the hand is up", "the hands are up"), ("is charged", "is charging"), ("walks", "walked")]
)
def test_more_than_number(one: str, other: str) -> None:
    assert singulars(one) != singulars(other)
    assert stems(one) == stems(other)
