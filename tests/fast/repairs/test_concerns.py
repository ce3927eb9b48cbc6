"""Repairs of a concern that can happen."""

from __future__ import annotations

import pytest

from tests.support.repairs import repairs_of, texts_after

CALL = """EVENT Fall, Call, Wait BY system
EVENT Alarm BY environment
CONDITION alone, awake
RULE help // when somebody falls
WHEN Fall THEN Call WITHIN 10 minutes // at last

RULE quiet
WHEN Alarm THEN Wait
UNLESS NOT awake IN WHICH CASE NOT Call
"""


def after_concern(concern: str) -> list[str]:
    text = f"{CALL}{concern}\n"
    return texts_after(text, repairs_of(text, "SLEEC104"))


def test_a_window_is_shorter() -> None:
    concern = "CONCERN late WHEN Fall THEN NOT Call WITHIN 2 minutes"
    assert CALL.replace("10 minutes", "2 minutes") + concern + "\n" in after_concern(concern)


def test_the_opposite_of_a_concern_is_a_rule() -> None:
    concern = "CONCERN forgotten WHEN Alarm AND alone THEN NOT Wait WITHIN 1 hour"
    rule = "\n\nRULE forgotten_rule\nWHEN Alarm AND alone THEN Wait WITHIN 1 hour\n"
    assert after_concern(concern) == [CALL[:-1] + rule + concern + "\n"]


@pytest.mark.parametrize("concern", ["WHEN Fall THEN Wait WITHIN 1 minute", "EXISTS Fall WHILE Wait WITHIN 1 minute"])
def test_a_concern_can_forbid(concern: str) -> None:
    rule = "\n\nRULE c_rule\nWHEN Fall THEN NOT Wait WITHIN 1 minute\n"
    text = CALL.replace("UNLESS NOT awake IN WHICH CASE NOT Call\n", "").replace("THEN Wait", "THEN Call")
    text += f"CONCERN c {concern}\n"
    claim = text.index("CONCERN")
    assert text[: claim - 1] + rule + text[claim:] in texts_after(text, repairs_of(text, "SLEEC104"))


def test_what_contradicts_the_rule_gives_way() -> None:
    text = """def_start
  event Alarm
  event Fall
  event Call
  measure asleep: boolean
def_end
rule_start
\tR1 when Alarm then Call
rule_end
concern_start
  c1 when Fall and {asleep} then Call
concern_end
"""
    rule = "\n\tc1_rule when Fall and {asleep} then not Call\n"
    for condition in (
        " and (not (Fall and {asleep})) then Call",
        " then Call\n\t\tunless (Fall and {asleep}) then not Call",
    ):
        assert text.replace(" then Call\nrule_end", f"{condition}{rule}rule_end") in texts_after(
            text, repairs_of(text, "SLEEC104")
        )


def test_a_label_that_exists_is_not_used_again() -> None:
    text = f"{CALL}CONCERN c WHEN Alarm AND alone THEN NOT Wait WITHIN 1 hour\n".replace("RULE help", "RULE c_rule")
    (changed,) = texts_after(text, repairs_of(text, "SLEEC104"))
    assert "RULE c_rule_2\nWHEN Alarm AND alone" in changed


@pytest.mark.parametrize(
    "concern", ["WHEN Fall THEN (Wait UNLESS alone)", "WHEN Fall THEN Wait OTHERWISE Call", "EXISTS Fall AND alone"]
)
def test_a_concern_without_a_single_opposite_has_no_rule(concern: str) -> None:
    assert after_concern(f"CONCERN c {concern}") == []
