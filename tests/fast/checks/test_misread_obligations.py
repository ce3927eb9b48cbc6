"""Obligations with a negation or modal verb: there is a text to write only if the words say one thing."""

from __future__ import annotations

import pytest

from sleec_runtime.language import parse
from tests.support.misread import MODAL, NEGATION, corrected, misread

RULE = "WHEN the bell rings THEN {}\n"

FORBIDDEN = """
dont leave, mustnt leave, cant leave, shalln't leave, shan't leave, shant leave, had better not leave,
the robot is not supposed to leave, the system mayn\u2019t leave, the robot isnt allowed to leave
"""
REQUIRED = "the robot had better leave, had better leave, is required to leave"
OPEN = """
the robot couldn't leave, wouldnt leave, need not leave, needn't leave, neednt leave, must not not leave,
should not have to leave, the robot does not have to leave, the robot doesn't need to leave,
the robot is not required to leave, the robot isn't able to leave, NOT must not leave, NOT never leave, NOT dont leave
"""
NO_ACTION = """
neither shout nor run, the robot must neither shout nor run, nobody may leave, no one leaves, nothing may leave,
avoid leaving, avoid leaving the room, refrain from leaving, the robot should abstain from leaving,
must only leave with the nurse, only leave with the nurse, not only leave, must not only leave, rather not leave,
it is forbidden to leave, the robot is prohibited from leaving, leaving is forbidden, leaving the room is forbidden,
leave never, hardly leave, under no circumstances leave
"""
DENIED = """
do not forget the keys, must not fail to not leave, must not refuse to help, do not hesitate to call the nurse,
must not avoid leaving, NOT fail to leave, forget to leave, the robot cannot decline to help, must not fail
"""
FINE = """
avoid obstacles, avoid the bedroom, clean the only window, find a better seat, say that nobody may enter,
say that it is forbidden to leave, forget the request, refuse to help, fail safely, must not stop the music
"""


def phrases(text: str) -> list[str]:
    return [phrase.strip() for phrase in text.split(",")]


@pytest.mark.parametrize("written", phrases(FORBIDDEN))
def test_a_negation_that_forbids(written: str) -> None:
    assert parse(corrected(RULE.format(written))).rules == parse(RULE.format("NOT leave")).rules


@pytest.mark.parametrize("written", phrases(REQUIRED))
def test_a_modal_verb_that_requires(written: str) -> None:
    assert parse(corrected(RULE.format(written))).rules == parse(RULE.format("leave")).rules


@pytest.mark.parametrize("written", phrases(OPEN))
def test_a_negation_that_may_only_permit(written: str) -> None:
    text = RULE.format(written)
    (finding,) = misread(text)
    assert finding.code == NEGATION
    assert finding.help == (
        "write `leave` if the robot must do it, and `NOT leave` if it must not; remove it if the robot may choose"
    )
    assert corrected(text) == text


@pytest.mark.parametrize("written", phrases(DENIED))
def test_what_is_not_to_be_omitted(written: str) -> None:
    text = RULE.format(written)
    (finding,) = misread(text)
    assert finding.code == NEGATION
    assert finding.help == "name the action itself, for example: open the door; to forbid it, write NOT before it"
    assert corrected(text) == text


@pytest.mark.parametrize("written", ["has to leave", "should leave", "had better leave"])
def test_a_modal_verb_after_not(written: str) -> None:
    """`NOT has to leave` says that the robot need not leave, or that it must not."""
    text = RULE.format(f"greet AND NOT {written}")
    (finding,) = misread(text)
    assert finding.code == MODAL
    assert corrected(text) == text


@pytest.mark.parametrize("written", phrases(NO_ACTION))
def test_words_that_forbid_without_an_action(written: str) -> None:
    text = RULE.format(written)
    (finding,) = misread(text)
    assert finding.code == NEGATION
    assert corrected(text) == text


@pytest.mark.parametrize("written", phrases(FINE))
def test_actions_with_such_words(written: str) -> None:
    assert not misread(RULE.format(written))
