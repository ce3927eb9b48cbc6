"""Repairs of names that people read differently than the rules do."""

from __future__ import annotations

import pytest

from sleec_runtime.language import parse
from sleec_verify.checks import run_checks
from sleec_verify.repairs.simplification import simplifications
from tests.support.repairs import repairs_of, texts_after


@pytest.mark.parametrize(
    ("code", "wrong", "right"),
    [
        ("SLEEC520", "WHEN t THEN the robot is not allowed to leave\n", "WHEN t THEN NOT leave\n"),
        ("SLEEC522", "WHEN t AND the child is under 6 THEN stop\n", "WHEN t AND age < 6 THEN stop\n"),
        ("SLEEC524", "WHEN t THEN BUT call the office\n", "WHEN t THEN call the office\n"),
        (
            "SLEEC525",
            (
                "WHEN s THEN take photos\nWHEN v THEN take photos\nWHEN w THEN take photos\n"
                "WHEN t THEN take photo // twice\nWHEN u THEN take photo AND wait\n"
            ),
            (
                "WHEN s THEN take photos\nWHEN v THEN take photos\nWHEN w THEN take photos\n"
                "WHEN t THEN take photos // twice\nWHEN u THEN take photos AND wait\n"
            ),
        ),
    ],
)
def test_the_text_to_write_is_written(code: str, wrong: str, right: str) -> None:
    assert right in texts_after(wrong, repairs_of(wrong, code))


def test_variants_need_no_decision_but_the_meaning_of_words_does() -> None:
    text = "WHEN s THEN take photos\nWHEN t THEN take photo AND the robot is not allowed to leave\n"
    ruleset = parse(text)
    *_, last = simplifications(ruleset, run_checks(ruleset))
    assert last.repaired.source.text == text.replace("photo AND", "photos AND")


@pytest.mark.parametrize("wrong", ["calling the nurse", "call the nruse"])
def test_a_slip_is_renamed_only_on_request(wrong: str) -> None:
    right = "WHEN r THEN call the nurse\nWHEN s THEN call the nurse\n"
    text = f"{right}WHEN t THEN {wrong}\n"
    assert texts_after(text, repairs_of(text, "SLEEC526")) == [f"{right}WHEN t THEN call the nurse\n"]
    ruleset = parse(text)
    assert all(one.finding.code != "SLEEC526" for one in simplifications(ruleset, run_checks(ruleset)))


OTHER_WORDS = [
    ("is charged", "is charging"),
    ("is closing", "is closed"),
    ("massage", "message"),
    ("battery is charged", "battery is changed"),
    ("user is lifted", "user is lifting"),
    ("is moving", "is moved"),
    ("patient walks", "patient walked"),
    ("heart rate", "heat rate"),
    ("insulin", "inulin"),
    ("dressed", "dressing"),
    ("the left hand is up", "the left hands are up"),
]


@pytest.mark.parametrize("pair", OTHER_WORDS)
def test_different_words_are_never_merged_without_a_question(pair: tuple[str, str]) -> None:
    one, other = pair
    text = "".join(
        f"WHEN {name} THEN go{at}\nWHEN t{at} THEN {name}\nWHEN s{at} THEN stay{at} UNLESS {name}\n"
        for at, name in enumerate((one, other, other))
    )
    ruleset = parse(text)
    assert all(one.candidate.operator != "renaming" for one in simplifications(ruleset, run_checks(ruleset)))


def test_two_definitions_of_the_dsl_are_merged_only_on_request() -> None:
    text = (
        "def_start\nevent Bell\nevent Hand\nevent Hands\ndef_end\n"
        "rule_start\nR1 when Bell then Hand\nR2 when Hand then Hands\nrule_end\n"
    )
    ruleset = parse(text)
    assert repairs_of(text, "SLEEC525")
    assert not list(simplifications(ruleset, run_checks(ruleset)))
