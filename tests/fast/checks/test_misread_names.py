"""Names that people read differently than the rules do: each is found, at its place, with the text to write instead."""

from __future__ import annotations

import pytest

from sleec_runtime.errors import LanguageError
from sleec_runtime.language import parse
from tests.support.misread import (
    COMPARISON,
    KEYWORD,
    MODAL,
    NEGATION,
    OPPOSITES,
    SIMILAR,
    codes,
    corrected,
    misread,
)
from tests.support.negated_conditions import UNCERTAIN

BESIDE = "WHEN the user calls THEN take care\nUNLESS it is night IN WHICH CASE leave\n"
"""Rules with names that the examples negate."""

OBLIGATIONS = [
    ("the robot must not leave", NEGATION, "NOT leave"),
    ("do not leave", NEGATION, "NOT leave"),
    ("never leave", NEGATION, "NOT leave"),
    ("don't leave", NEGATION, "NOT leave"),
    ("Don\u2019t leave", NEGATION, "NOT leave"),
    ("not leave", NEGATION, "NOT leave"),
    ("it cannot leave", NEGATION, "NOT leave"),
    ("the system shall never leave", NEGATION, "NOT leave"),
    ("the robot is not allowed to leave", NEGATION, "NOT leave"),
    ("the robot has to leave", MODAL, "leave"),
    ("the robot must leave", MODAL, "leave"),
    ("must be quiet", MODAL, "be quiet"),
    ("should do the dishes", MODAL, "do the dishes"),
    ("BUT call the office", KEYWORD, "call the office"),
    ("call the office IMMEDIATELY", KEYWORD, "call the office"),
    ("MUST call the office", KEYWORD, "call the office"),
]


@pytest.mark.parametrize(("written", "code", "instead"), OBLIGATIONS)
def test_words_around_the_action(written: str, code: str, instead: str) -> None:
    """The language may accept a form as what it says; otherwise it is found."""
    text = f"{BESIDE}WHEN the bell rings THEN {written}\n"
    meant = parse(f"{BESIDE}WHEN the bell rings THEN {instead}\n")
    if parse(text).rules != meant.rules:
        (finding,) = misread(text)
        assert finding.code == code
        assert finding.severity == "warning"
        assert text[finding.span.start : finding.span.end] == written
        assert finding.help is not None
        assert f"`{instead}`" in finding.help
        assert parse(corrected(text)).rules == meant.rules


CONDITIONS = [
    ("the child is under 6", COMPARISON, "age < 6"),
    ("the child is under six", COMPARISON, "age < 6"),
    ("the child is not under 6 years old", COMPARISON, "age >= 6"),
    ("the temperature is above 38.5", COMPARISON, "temperature > 38.5"),
    ("the bath temperature is 38", COMPARISON, "bath_temperature = 38"),
    ("at least 3 people are here", COMPARISON, "people >= 3"),
    ("the robot's battery is below 20 percent", COMPARISON, "robot_battery < 20"),
    ("the child is more than 3 steps away", COMPARISON, "steps > 3"),
    ("it is 8 o'clock", COMPARISON, "hour = 8"),
    ("there are 3 people", COMPARISON, "people = 3"),
    ("danger is high", COMPARISON, "danger = high"),
    ("the danger is not high", COMPARISON, "danger != high"),
    ("the danger is at least high", COMPARISON, "danger >= high"),
    ("high danger", COMPARISON, "danger = high"),
    ("noise is below the limit", COMPARISON, "noise < limit"),
    ("it is not night", NEGATION, "NOT it is night"),
    ("it isn't night", NEGATION, "NOT it is night"),
    ("not asleep", NEGATION, "NOT asleep"),
    ("it is dark BUT it is warm", KEYWORD, "(it is dark AND it is warm)"),
    ("it is dark IMPLIES it is warm", KEYWORD, "(NOT it is dark OR it is warm)"),
    ("it is dark XOR it is warm", KEYWORD, "((it is dark AND NOT it is warm) OR (NOT it is dark AND it is warm))"),
]
MEASURES = "MEASURE danger: low < high\nMEASURE noise: number\nCONSTANT limit = 5\n"


@pytest.mark.parametrize(("written", "code", "instead"), CONDITIONS)
@pytest.mark.parametrize("frame", ["WHEN a guest comes THEN greet UNLESS {}\n", "ASSUME {}\n"])
def test_words_in_a_condition(written: str, code: str, instead: str, frame: str) -> None:
    text = MEASURES + BESIDE + frame.format(written)
    meant = parse(MEASURES + BESIDE + frame.format(instead))
    if parse(text).statements != meant.statements:
        (finding,) = misread(text)
        assert finding.code == code
        assert text[finding.span.start : finding.span.end] == written
        assert finding.help is not None
        assert instead in finding.help
        assert parse(corrected(text)).statements == meant.statements


@pytest.mark.parametrize(
    ("written", "code"),
    [
        ("is less than 10", COMPARISON),
        ("age is never below 3", COMPARISON),
        ("x OR NOT age is never below 3", COMPARISON),
        ("the user sleeps FOR 5 minutes", KEYWORD),
        ("it rains AFTER noon", KEYWORD),
        ("the door must not open", NEGATION),
        ("the light should be on", MODAL),
        ("visitors should be asked to wait", MODAL),
        ("the robot may leave", MODAL),
        ("may open the window", MODAL),
        ("it is allowed to leave", MODAL),
        ("no entry for guests", NEGATION),
        ("do not forget the keys", NEGATION),
        ("must not fail to not leave", NEGATION),
    ],
)
def test_a_finding_without_a_replacement_says_what_to_do(written: str, code: str) -> None:
    """Only the author knows what is compared, or what the robot does."""
    place = "UNLESS x IN WHICH CASE" if code in (NEGATION, MODAL) else "UNLESS"
    text = f"WHEN the bell rings THEN greet {place} {written}\n"
    (finding,) = misread(text)
    assert finding.code == code
    assert finding.help
    assert corrected(text) == text


@pytest.mark.parametrize(("positive", "negative"), UNCERTAIN)
def test_a_negation_that_may_mean_something_else_has_no_replacement(positive: str, negative: str) -> None:
    text = f"WHEN a THEN x\nUNLESS {positive}\nWHEN b THEN y\nUNLESS {negative}\n"
    (finding,) = misread(text)
    assert finding.code == NEGATION
    assert finding.help is not None
    assert f"`NOT {positive}`" in finding.help
    assert corrected(text) == text


@pytest.mark.parametrize("written", ["play music FOR 5 minutes", "greet EXCEPT it is night"])
def test_the_parser_reports_some_words_in_capitals(written: str) -> None:
    with pytest.raises(LanguageError, match=r"WITHIN|UNLESS"):
        parse(f"WHEN the bell rings THEN {written}\n")


def test_a_trigger_is_not_negated() -> None:
    (finding,) = misread("WHEN not asleep THEN greet\n")
    assert finding.code == NEGATION
    assert finding.help is not None
    assert "AND NOT" in finding.help


def test_the_trigger_is_an_event_and_no_comparison() -> None:
    (finding,) = misread("WHEN the temperature is above 38 THEN open the window\n")
    assert finding.code == COMPARISON
    assert finding.help is not None
    assert finding.help.endswith("AND temperature > 38")
    assert not codes("WHEN the temperature falls below 20 THEN open the window\n")
    assert not codes("WHEN it is 8 o'clock THEN open the window\n")


OPPOSITE = "WHEN the bell rings THEN go in UNLESS {} IN WHICH CASE knock\nWHEN a guest goes THEN stay UNLESS {}\n"


@pytest.mark.parametrize(
    ("one", "other"),
    [("the door is open", "the door is closed"), ("the user is dressed", "the user is undressed")],
)
def test_opposites_that_nothing_relates(one: str, other: str) -> None:
    text = OPPOSITE.format(one, other)
    (finding,) = misread(text)
    assert finding.code == OPPOSITES
    assert finding.related
    assert {name for rule in parse(corrected(text)).rules for name in (one, other) if name in str(rule)} != {one, other}
    for relation in (f"ASSUME NOT ({one} AND {other})\n", f"RELATION ALWAYS {one} OPPOSES {other}\n"):
        assert not misread(relation + text)


def test_every_place_of_a_name_changes_and_nothing_else() -> None:
    text = (
        "# Call the nurse, if you must.\nEXCLUSIVE Call the nurse, stay\n\nDOMAIN Call the nurse\n"
        "RULE first WHEN the bell rings THEN (Call\n  the nurse AND stay) // Call the nurse\n"
        "WHEN the user falls THEN call the nurse WITHIN 5 minutes AND call the nurse\n"
        "WHEN a guest falls THEN call the nurse OTHERWISE call the nurse\n"
    )
    text = text.replace("OTHERWISE call the nurse", "OTHERWISE stay")
    changed = text.replace("EXCLUSIVE Call", "EXCLUSIVE call").replace("(Call\n  the nurse", "(call the nurse")
    assert corrected(text) == changed


DECLARED = "TRIGGER the bell rings\nCONDITION the child is under 6\nOBLIGATION not leave, leave, leaves\n"


def test_declared_names_are_meant_as_they_are_written() -> None:
    text = "WHEN the bell rings THEN not leave AND leave AND leaves UNLESS the child is under 6\n"
    assert codes(text) == [NEGATION, SIMILAR, COMPARISON]
    assert not codes(DECLARED + text)


@pytest.mark.parametrize(
    "text",
    [
        "WHEN the bell rings THEN not leave // sleec: allow SLEEC520 because it is a dance\n",
        "# sleec: allow SLEEC101, SLEEC520 because it is a dance\nWHEN the bell rings\nTHEN not leave\n",
        "// sleec: allow misread-name because it is a dance\nRULE dance WHEN the bell rings THEN not leave\n",
    ],
)
def test_a_comment_allows_a_finding_with_a_reason(text: str) -> None:
    assert not misread(text)
    assert codes(text.replace(" because it is a dance", "")) == [NEGATION]
    assert codes(text.replace("SLEEC520", "SLEEC521").replace("misread-name", "reading")) == [NEGATION]


def test_a_comment_at_a_definition_allows_a_variant_in_the_dsl() -> None:
    text = (
        "def_start\nevent Called\nevent TakePhoto\nevent TakePhotos{}\ndef_end\nrule_start\n"
        "R1 when Called then TakePhoto\nR2 when Called then not TakePhotos\nrule_end\n"
    )
    assert codes(text.format("")) == [SIMILAR]
    assert not codes(text.format(" // sleec: allow SLEEC525 because one photo is for the file"))


def test_a_name_is_corrected_to_the_declared_one() -> None:
    text = "TRIGGER a guest waits\nWHEN a guest waits THEN greet UNLESS a guest wait AND (asleep OR a guest wait)\n"
    assert corrected(text) == text.replace("a guest wait ", "a guest waits ").replace("a guest wait)", "a guest waits)")


FINE = [
    "THEN tell the user that he must not smoke",
    "THEN say that nobody may enter",
    "THEN do the dishes",
    "THEN wait for 5 minutes",
    "THEN make sure that the user is not alone",
    "THEN keep the volume below 50",
    "THEN can the tomatoes",
    "THEN explain what visitors must do",
    "THEN a UNLESS quiet IS needed",
    "THEN call the ICU",
    "THEN open the left door AND open the right door",
    "THEN switch the light on AND switch the light off",
    "THEN go to room 1 AND go to room 2",
    "THEN a UNLESS the user does not answer",
    "THEN a UNLESS the child is under the table",
    "THEN a UNLESS the user is one of the guests",
    "THEN a UNLESS door 3 is open",
    "THEN a UNLESS the user must stay in bed",
    "THEN a UNLESS the light is red AND the right is free",
    "THEN lower the bed AND power the bed",
    "THEN _ AND __",
    "THEN clear the table AND clean the table",
    "THEN a UNLESS a customer pays IN WHICH CASE b UNLESS a customer plays",
    "THEN guide visitors to exit 2 AND keep a distance of 2 metres",
]


@pytest.mark.parametrize("text", FINE)
def test_plain_names_are_fine(text: str) -> None:
    assert not misread(f"{MEASURES}WHEN the bell rings {text}\n")


def test_letters_that_look_alike_are_left_to_another_check() -> None:
    assert not codes("WHEN the bell rings THEN \u041epen the door AND Open the door\n")


def test_the_place_of_a_name_after_a_modal_verb() -> None:
    text = "WHEN a THEN call the nurse\nWHEN b THEN the robot mustn\u2019t call nurse\n"
    (finding,) = misread(text)
    assert text[finding.span.start : finding.span.end] == "call nurse"


@pytest.mark.parametrize("measure", ["number", "integer", "low < middle"])
@pytest.mark.parametrize("written", ["danger is high", "the danger is not very high"])
def test_a_measure_and_a_word_that_is_no_value(measure: str, written: str) -> None:
    text = f"MEASURE danger: {measure}\nWHEN the bell rings THEN greet UNLESS {written}\n"
    (finding,) = misread(text)
    assert finding.code == COMPARISON
    assert text[finding.span.start : finding.span.end] == written
    assert corrected(text) == text
    assert not codes(f"CONDITION {written}\n{text}")
    assert not codes(text.replace(written, "the danger light is on"))


SCHOOL = """MEASURE danger: low < high
MEASURE age: number
WHEN the bell rings THEN the robot must not leave
WHEN the bell rings twice THEN do not leave
UNLESS the child is under 6 IN WHICH CASE never leave
UNLESS is less than 10 IN WHICH CASE take photo
UNLESS the age is under 6 IN WHICH CASE take photos
WHEN it is dark THEN BUT call the office
UNLESS it is night IN WHICH CASE call the office IMMEDIATELY
UNLESS it is not night IN WHICH CASE call the nurse
UNLESS the door is open IN WHICH CASE Call the nurse
UNLESS the door is closed IN WHICH CASE call nurse
UNLESS danger is high IN WHICH CASE the robot must call the teacher
"""
READ_AS = """MEASURE danger: low < high
MEASURE age: number
WHEN the bell rings THEN NOT leave
WHEN the bell rings twice THEN NOT leave
UNLESS age < 6 IN WHICH CASE NOT leave
UNLESS is less than 10 IN WHICH CASE take photo
UNLESS age < 6 IN WHICH CASE take photo
WHEN it is dark THEN call the office
UNLESS it is night IN WHICH CASE call the office
UNLESS NOT it is night IN WHICH CASE call the nurse
UNLESS NOT the door is closed IN WHICH CASE call the nurse
UNLESS the door is closed IN WHICH CASE call the nurse
UNLESS danger = high IN WHICH CASE call the teacher
"""


def test_the_rules_of_a_school_say_what_people_read() -> None:
    """The language accepts a form, or the check finds the name and says what to write, but for one comparison."""
    assert parse(corrected(SCHOOL)).statements == parse(READ_AS).statements
    assert codes(corrected(SCHOOL)) == [COMPARISON]
