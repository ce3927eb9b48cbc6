"""Repairs of a conflict over time by other windows."""

from __future__ import annotations

from tests.support.repairs import repairs_of, texts_after

RULES = """RULE help
WHEN Fall THEN Call WITHIN 5 minutes // by telephone
UNLESS alone IN WHICH CASE Ring

RULE quiet
WHEN Sleep THEN NOT Call WITHIN 10 minutes // so that nobody wakes up
"""


def after(text: str) -> list[str]:
    return texts_after(
        text, [one for one in repairs_of(text, "SLEEC101") if one.candidate.operator == "deadline-refinement"]
    )


def test_a_response_has_any_time_or_an_alternative() -> None:
    assert set(after(RULES)) == {
        RULES.replace("Call WITHIN 5 minutes", "Call EVENTUALLY"),
        RULES.replace("5 minutes", "5 minutes OTHERWISE Ring"),
    }


def test_an_alternative_belongs_to_one_obligation() -> None:
    text = RULES.replace("Call WITHIN 5 minutes", "Speak AND Call WITHIN 5 minutes AND Wave")
    assert text.replace("Call WITHIN 5 minutes", "(Call WITHIN 5 minutes OTHERWISE Ring)") in after(text)


def test_a_response_without_a_window_gets_any_time() -> None:
    text = """def_start
  event A
  event B
  event C
def_end
rule_start
  R1 when A then B
  R2 when C then not B within 3 seconds
rule_end
"""
    assert after(text) == [text.replace("then B\n", "then B eventually\n")]


def test_rules_without_time_get_none() -> None:
    assert after("WHEN Fall THEN Call\n\nWHEN Fall AND asleep THEN NOT Call\n") == []


def test_a_repair_stays_in_its_dialect() -> None:
    """SLEEC-TK has no `eventually`."""
    text = """def_start
  event A
  event B
  event C
  measure m: boolean
def_end
rule_start
  R1 when A and m then B within 3 seconds
  R2 when C then not B within 3 seconds
rule_end
"""
    assert repairs_of(text, "SLEEC101")
    assert after(text) == []


def test_an_act_that_no_rule_requires_any_more_is_declared() -> None:
    text = """def_start
  event Prepare
  event Deploy
  event Watch
  measure treaty: boolean
  measure owned: boolean
def_end
rule_start
  R1 when Prepare and owned then not Deploy within 2 minutes
      unless treaty then Deploy
  R2 when Deploy and treaty then Watch
rule_end
"""
    changed = text.replace("event Deploy", "event Deploy as system").replace("\n      unless treaty then Deploy", "")
    assert changed in texts_after(text, repairs_of(text, "SLEEC101"))
