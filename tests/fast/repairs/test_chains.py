"""Repairs of chains of exceptions: the reading is stated, and a trigger says where nothing is due."""

from __future__ import annotations

import pytest

from tests.support.repairs import repairs_of, texts_after

ENGLISH = """// who calls
WHEN Fall THEN Call
UNLESS awake IN WHICH CASE Ask
UNLESS alone IN WHICH CASE Ring // the bell
"""
DSL = """def_start
  event Fall
  event Call
  event Ask
  event Ring
  measure awake: boolean
  measure alone: boolean
  measure old: boolean
def_end
rule_start
  // who calls
  R1 when Fall then Call
      unless {{awake}} {0}
      unless {{alone}} {1} // the bell
  R2 when Ask and {{old}} then Ring
rule_end
"""


def after(text: str, code: str) -> list[str]:
    return texts_after(text, repairs_of(text, code))


def test_structured_english_states_the_reading() -> None:
    assert after(ENGLISH, "SLEEC401") == [f"READING cascade\n\n{ENGLISH}", f"READING priority\n\n{ENGLISH}"]


def test_the_reading_of_the_file_keeps_its_meaning() -> None:
    assert [repair.effect.keeps_meaning for repair in repairs_of(ENGLISH, "SLEEC401")] == [True, False]


def test_the_dsl_has_conditions_for_which_both_readings_agree() -> None:
    text = DSL.format("then Ask", "then Ring")
    assert after(text, "SLEEC401") == [
        text.replace("unless {awake}", "unless ({awake} or {alone})"),
        text.replace("unless {alone}", "unless ({awake} and {alone})"),
    ]


def test_exceptions_of_a_clause_have_no_such_repair() -> None:
    text = DSL.format("", "")
    clause = "R1 when Fall then {Call unless {awake} then Ask unless {alone} then Ring}\n"
    start, end = text.index("// who calls"), text.index("R2")
    assert after(f"{text[:start]}{clause}{text[end:]}", "SLEEC401") == []


def test_exceptions_with_one_response_are_one_exception() -> None:
    text = DSL.format("then Ask", "then Ask").replace(" // the bell", "")
    assert text.replace("unless {awake} then Ask\n      unless {alone}", "unless ({awake} or {alone})") in after(
        text, "SLEEC401"
    )


@pytest.mark.parametrize(
    ("first", "second", "changed"),
    [
        ("then Ask", "", "and (not {alone})"),
        ("", "", "and ((not {awake}) and (not {alone}))"),
        ("", "then Ask", None),
    ],
)
def test_the_trigger_says_where_nothing_is_due(first: str, second: str, changed: str | None) -> None:
    text = DSL.format(first, second).replace(" // the bell", "")
    found = [repair for repair in repairs_of(text, "SLEEC503") if repair.candidate.operator == "canonical-form"]
    assert all(repair.effect.keeps_meaning for repair in found)
    assert any(f"when Fall {changed} then Call\n" in one for one in texts_after(text, found)) == (changed is not None)


def test_a_comment_of_an_exception_stays() -> None:
    assert after("WHEN Fall THEN Call\nUNLESS asleep // why\n", "SLEEC503") == []
    assert after("WHEN Fall THEN Call\nUNLESS asleep\n", "SLEEC503") == ["WHEN Fall AND NOT asleep THEN Call\n"]


def test_only_the_first_exception_of_a_cascade_can_be_a_condition_of_the_trigger() -> None:
    assert after(f"READING cascade\n{ENGLISH}UNLESS old\n", "SLEEC503") == []
    assert after(f"READING priority\n{ENGLISH}UNLESS old\n", "SLEEC503") == [
        f"READING priority\n{ENGLISH}".replace("Fall", "Fall AND NOT old")
    ]
