"""Corrections of single words."""

from __future__ import annotations

import pytest

from tests.support.repairs import repairs_of, texts_after

DSL = """def_start
  event Fall
  event Call
  event Beep
  measure risk: scale(low, high)
  measure noise: scale(quiet, loud)
def_end
rule_start
  R1 when Fall and ({risk} = high) then Call within 2 minutes // at last
  R2 when Call then Beep
  R3 when Fall and ({noise} = loud) then Beep within 1 minutes
rule_end
purpose_start
  p1 exists Fall while Call
purpose_end
"""
CHANGES = {
    "SLEEC506": ("R2", "R1", "R1_2"),
    "SLEEC507": ("loud)", "high)", "loud)"),
    "SLEEC508": ("loud)", "1)", "loud)"),
    "SLEEC510": ("exists Fall", "exists Falls", "exists Fall"),
    "SLEEC513": (" within 1 minutes", " within 0 minutes", ""),
}


@pytest.mark.parametrize("code", CHANGES)
def test_one_word_is_corrected(code: str) -> None:
    right, wrong, repaired = CHANGES[code]
    at = DSL.index(right, DSL.index("rule_start"))
    head, tail = DSL[:at], DSL[at + len(right) :]
    if code == "SLEEC510":
        head = head.replace("event Fall\n", "event Fall\n  event Falls\n")
    text = head + wrong + tail
    assert (head + repaired + tail).replace("  event Falls\n", "") in [
        one.replace("  event Falls\n", "") for one in texts_after(text, repairs_of(text, code))
    ]


def test_a_purpose_without_a_rule_can_be_removed() -> None:
    text = (
        DSL.replace("event Beep", "event Zap")
        .replace("Beep", "Zap")
        .replace("p1 exists Fall while", "p1 exists Fall\n  p2 when Siren then")
    )
    text = text.replace("event Call\n", "event Call\n  event Siren\n")
    assert text.replace("  p2 when Siren then Call\n", "").replace("  event Siren\n", "") in texts_after(
        text, repairs_of(text, "SLEEC510")
    )


FORBIDDEN = [
    ("EVENT Sleep, Ring, Open\n", "EVENT Sleep, Open\nEVENT Ring BY system\n"),
    ("EVENT Sleep, Open\nEVENT Ring // from outside\n", "EVENT Sleep, Open\nEVENT Ring BY system // from outside\n"),
]


@pytest.mark.parametrize(("before", "after"), FORBIDDEN)
def test_the_robot_causes_a_forbidden_event(before: str, after: str) -> None:
    rules = "WHEN Sleep THEN NOT Ring WITHIN 1 hour\n\nWHEN Ring THEN Open\n"
    assert after + rules in texts_after(before + rules, repairs_of(before + rules, "SLEEC107"))


def test_what_forbids_an_input_is_removed() -> None:
    rules = "WHEN Sleep THEN Lock AND NOT Ring\n\nWHEN Ring THEN Open\n"
    assert rules.replace(" AND NOT Ring", "") in texts_after(rules, repairs_of(rules, "SLEEC107"))
