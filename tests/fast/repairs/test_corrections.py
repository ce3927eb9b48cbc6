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


COMPARED = """MEASURE age: number
MEASURE risk: low < middle < high
WHEN Call AND age > 18 AND age {0} 65 THEN Answer // adults

WHEN Stop THEN Wait
UNLESS risk {1} low IN WHICH CASE Ask

WHEN Sleep AND (age <= 3 OR age {2} 3) THEN Rest
"""


@pytest.mark.parametrize(
    ("code", "wrong", "repaired"),
    [
        ("SLEEC201", ("< 9 AND age <", ">", ">="), ("> 9 AND age <", ">", ">=")),
        ("SLEEC202", ("<", "<", ">="), ("<", "<=", ">=")),
        ("SLEEC202", ("<", "<", ">="), ("<", ">", ">=")),
        ("SLEEC512", ("<", ">", ">"), ("<", ">", "<")),
    ],
)
def test_another_operator_has_an_effect(code: str, wrong: tuple[str, ...], repaired: tuple[str, ...]) -> None:
    changed = texts_after(COMPARED.format(*wrong), repairs_of(COMPARED.format(*wrong), code))
    assert COMPARED.format(*repaired) in changed


def test_a_constraint_names_an_obligation_of_a_rule() -> None:
    text = "EXCLUSIVE Answer, StaySilennt\nASSUME NOT (Call AND Sleep)\n"
    text += "WHEN Call THEN Answer\nWHEN Sleep THEN StaySilent\n"
    assert text.replace("nnt", "nt") in texts_after(text, repairs_of(text, "SLEEC502"))


def test_a_second_definition_is_removed() -> None:
    again = DSL.replace("  event Beep\n", "  event Beep // short\n  event Call // again\n")
    assert texts_after(again, repairs_of(again, "SLEEC519")) == [again.replace("  event Call // again\n", "")]
    on_one_line = DSL.replace("  event Beep\n", "  event Beep event Call\n")
    assert texts_after(on_one_line, repairs_of(on_one_line, "SLEEC519")) == []


def test_a_purpose_that_contradicts_itself_is_removed() -> None:
    text = DSL.replace("while Call", "while not Fall")
    assert DSL.replace("  p1 exists Fall while Call\n", "") in texts_after(text, repairs_of(text, "SLEEC105"))
