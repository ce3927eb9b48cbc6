"""Names that differ only slightly from another one: variants are found, and other words are not."""

from __future__ import annotations

from time import process_time

import pytest

from tests.support.misread import SIMILAR, SLIP, codes, corrected, misread

SIMILAR_NAMES = [
    ("take photo", "take photos"),
    ("Call the nurse", "call the nurse"),
    ("call nurse", "call the nurse"),
    ("call the nurse", "calls the nurse"),
    ("CallTheNurse", "call_the_nurse"),
    ("OpenWindow", "OpenWindows"),
]
SLIPS = [
    ("calling the nurse", "call the nurse"),
    ("call the nurse", "call the nursse"),
    ("call the nruse", "call the nurse"),
]
ONE_AND_TWO = "WHEN the bell rings THEN {}\nWHEN the user sleeps THEN NOT {}\nWHEN the user falls THEN {}\n"


@pytest.mark.parametrize(("one", "other", "code"), [(*p, SIMILAR) for p in SIMILAR_NAMES] + [(*p, SLIP) for p in SLIPS])
def test_similar_names(one: str, other: str, code: str) -> None:
    """The more frequent name is kept, wherever it stands."""
    if other == "call the nursse":
        one, other = other, one  # the frequent word is right
    for written in ((one, other, other), (other, one, other), (other, other, one)):
        text = ONE_AND_TWO.format(*written)
        (finding,) = misread(text)
        assert finding.code == code
        assert finding.severity == ("warning" if code == SIMILAR else "note")
        assert text[finding.span.start : finding.span.end] == one
        assert [text[span.start : span.end] for span, _ in finding.related] == [other]
        assert corrected(text) == ONE_AND_TWO.format(other, other, other)


@pytest.mark.parametrize(("one", "other"), SLIPS)
def test_a_name_that_is_used_twice_is_no_slip(one: str, other: str) -> None:
    assert not codes(f"WHEN the bell rings THEN {one}\nWHEN the user falls THEN {other}\n")
    assert not codes(ONE_AND_TWO.format(one, other, other) + f"WHEN the user sits THEN {one}\n")


OTHER_FORMS = [
    ("the battery is charged", "the battery is charging"),
    ("the door is closing", "the door is closed"),
    ("the user is lifted", "the user is lifting"),
    ("the robot is moving", "the robot is moved"),
    ("the patient walks", "the patient walked"),
    ("the user is dressed", "the user is dressing"),
    ("the battery is charged", "the battery is changed"),
    ("the heart rate is fine", "the heat rate is fine"),
    ("massage the user", "message the user"),
]


@pytest.mark.parametrize(("one", "other"), OTHER_FORMS)
@pytest.mark.parametrize("frame", ["WHEN {} THEN go\n", "WHEN the bell rings THEN go UNLESS {}\n"])
def test_words_that_say_different_things(one: str, other: str, frame: str) -> None:
    for names in ((one, other), (one, other, other), (one, one, other)):
        assert not codes("".join(frame.format(name) for name in names))


def test_one_and_several_are_at_most_a_slip() -> None:
    frame = "WHEN the bell rings THEN go UNLESS {}\n"
    one, other = "the left hand is cold", "the left hands are cold"
    assert not codes(frame.format(one) + frame.format(other))
    assert codes(frame.format(one) + frame.format(other) * 2) == [SLIP]


def test_the_dsl_has_no_slips() -> None:
    text = (
        "def_start\nevent UserIsCalled\nevent UserIsCalling\nevent Insulin\nevent Inulin\ndef_end\nrule_start\n"
        "R1 when UserIsCalled then Insulin\nR2 when UserIsCalling then Inulin\nR3 when UserIsCalled then Inulin\n"
        "rule_end\n"
    )
    assert not codes(text)


@pytest.mark.speed
def test_a_series_of_words_is_no_slip_and_takes_linear_time() -> None:
    """Pairs of these words would be 125,000."""
    rules = [f"WHEN alarm{chr(0x4E00 + at)} rings THEN go{at} AND sensor{chr(0x4E00 + at)}\n" for at in range(500)]
    started = process_time()
    assert not codes("".join(rules))
    assert process_time() - started < 3


def test_several_variants_become_one_name() -> None:
    names = ["call the nurse", "call nurse", "Call the nurse", "call the nurses", "call the nurse"]
    text = "".join(f"WHEN bell {chr(97 + at)} rings THEN {name}\n" for at, name in enumerate(names))
    assert codes(text) == [SIMILAR] * 3
    assert corrected(text) == "".join(f"WHEN bell {chr(97 + at)} rings THEN call the nurse\n" for at in range(5))


def test_an_event_and_a_state_may_differ_by_the_form_of_the_verb() -> None:
    states = "WHEN the alarm sounds THEN go\nWHEN the user calls THEN answer UNLESS the alarm {} IN WHICH CASE wait\n"
    assert not codes(states.format("sounding"))
    assert codes(states.format("sound")) == [SIMILAR]


def test_a_label_of_the_dsl_is_no_place_of_a_name() -> None:
    text = (
        "def_start\nevent Called\nevent TakePhoto\nevent TakePhotos\ndef_end\nrule_start\n"
        "TakePhotos when Called then TakePhotos\nR2 when TakePhotos then TakePhoto\n"
        "R3 when TakePhotos then TakePhotos within 1 minutes otherwise TakePhoto\nrule_end\n"
        "purpose_start\nTakePhoto exists TakePhotos\npurpose_end\n"
    )
    changed = text.replace("TakePhoto\n", "TakePhotos\n")
    assert corrected(text) == changed


def test_the_dsl_has_similar_names_only() -> None:
    text = (
        "def_start\nevent Called\nevent TakePhoto\nevent TakePhotos\nmeasure notAsleep: boolean\n"
        "measure asleep: boolean\ndef_end\nrule_start\nR1 when Called then TakePhoto\n"
        "R2 when Called and {notAsleep} and {asleep} then not TakePhotos\nrule_end\n"
    )
    (finding,) = misread(text)
    assert finding.code == SIMILAR
    assert finding.rules == ("R2",)
