"""Rules in plain language."""

from __future__ import annotations

import pytest

from sleec_runtime.language import parse
from sleec_verify.results.finding import Witness
from sleec_verify.wording.names import spoken
from sleec_verify.wording.plain_language import condition_words, response_words, situation_words

RULES = """
MEASURE UserAge: number
MEASURE RiskLevel: r_low < r_high
CONSTANT LegalAge = 18

RULE curtains
WHEN CurtainOpenRequest AND NOT UserAge < LegalAge THEN OpenCurtains WITHIN 5 minutes OTHERWISE WarnUser
UNLESS UserUndressed IN WHICH CASE (RefuseRequest AND ExplainWhy)
UNLESS NOT (RiskLevel = r_low AND DoorOpen) OR (Night AND Cold) IN WHICH CASE (CallNurse AND NOT Speak AND NOT Move)
UNLESS Asleep

RULE call
WHEN the user calls THEN answer the call
"""


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("CurtainOpenRequest", "curtain open request"),
        ("r_moderate", "r moderate"),
        ("AEDNeeded", "AED needed"),
        ("NeedAED", "need AED"),
        ("ÄrztinRuft", "ärztin ruft"),
        ("within10Minutes", "within 10 minutes"),
        ("hasB12", "has B12"),
        ("R1", "R1"),
        ("A", "A"),
        ("the user calls", "the user calls"),
        ("_", "_"),
        ("CallADoctor", "call a doctor"),
        ("TürÖffnen", "tür öffnen"),
        ("das Café Öffnen", "das Café Öffnen"),
        ("don’tCall", "don’t call"),
        ("\u0928\u092e\u0938\u094d\u0924\u0947", "\u0928\u092e\u0938\u094d\u0924\u0947"),
    ],
)
def test_names_read_as_words(name: str, words: str) -> None:
    assert spoken(name) == words


def test_conditions_and_responses_read_as_sentences() -> None:
    curtains, call = parse(RULES).rules
    window = "within 5 minutes (otherwise: the robot must warn user)"
    either = "it is not true that (risk level is r low and “door open” is true) or (“night” is true and “cold” is true)"
    assert curtains.guard is not None
    assert condition_words(curtains.guard) == "user age is at least legal age (18)"
    conditions = [clause.condition for clause in curtains.hedges]
    assert [condition_words(condition) for condition in conditions if condition is not None] == [
        "“user undressed” is true",
        either,
        "“asleep” is true",
    ]
    assert [response_words(clause) for clause in curtains.clauses()] == [
        f"the robot must open curtains {window}",
        "the robot must refuse request and explain why",
        "the robot must call nurse and must not speak or move",
        "nothing is required",
    ]
    assert response_words(call.default) == "the robot must answer the call"


def test_alternatives_have_their_exceptions() -> None:
    ruleset = parse("WHEN A THEN B ELSE (C UNLESS p IN WHICH CASE (D UNLESS q IN WHICH CASE E) UNLESS r)")
    assert response_words(ruleset.rules[0].default) == (
        "the robot must B (or instead: the robot must C, "
        "unless “p” is true (then: the robot must D, unless “q” is true (then: the robot must E)), "
        "unless “r” is true (then: nothing is required))"
    )


def test_a_constant_is_shown_with_its_value() -> None:
    rule = parse("CONSTANT Soon = 5\nWHEN A THEN B WITHIN Soon TO 9 minutes UNLESS Age < Soon").rules[0]
    assert response_words(rule.default) == "the robot must B from soon (5) minutes to 9 minutes after the trigger"
    assert rule.hedges[0].condition is not None
    assert condition_words(rule.hedges[0].condition) == "age is below soon (5)"


def test_situations_read_as_sentences() -> None:
    witness = Witness(("UserCalls",), {"Asleep": False, "UserAge": 15, "is cold": True}, ("FireAlarm",))
    assert situation_words(witness) == (
        "“user calls” occurs, “fire alarm” does not occur, “asleep” is false, user age is 15 and “is cold” is true"
    )
    assert situation_words(Witness((), {})) == "in every situation"
