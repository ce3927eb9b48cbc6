"""Repairs of a conflict by its situation: another bound, an assumption, and a rule for a part of a response."""

from __future__ import annotations

import pytest

from sleec_verify.repairs.repair import Operator
from tests.support.repairs import repairs_of, texts_after

WINDOW = """MEASURE temperature: number
RULE warm
WHEN Check AND temperature >= 30 THEN OpenWindow AND Speak // fresh air

RULE cold
WHEN Check AND ({} AND night) THEN NOT OpenWindow // at last
"""


def after(text: str, operator: Operator) -> list[str]:
    return texts_after(text, [one for one in repairs_of(text, "SLEEC101") if one.candidate.operator == operator])


@pytest.mark.parametrize(
    ("own", "other", "changed"),
    [
        ("temperature <= 30", "temperature < 30", "temperature > 30"),
        ("temperature < 40", "temperature < 30", "temperature >= 40"),
        ("temperature is at most 40", "temperature < 30", "temperature > 40"),
    ],
)
def test_two_bounds_do_not_overlap(own: str, other: str, changed: str) -> None:
    text = WINDOW.format(own)
    assert set(after(text, "correction")) == {WINDOW.format(other), text.replace("temperature >= 30", changed)}


@pytest.mark.parametrize("own", ["temperature >= 40", "temperature = 30", "NOT temperature < 30", "humid > 3"])
def test_bounds_of_the_same_side_stay(own: str) -> None:
    assert after(WINDOW.format(own), "correction") == []


def test_a_value_of_a_scale_is_a_bound() -> None:
    text = """def_start
  event A
  event B
  measure risk: scale(low, middle, high)
def_end
rule_start
  R1 when A and ({risk} < high) then B
  R2 when A and ({risk} > low) then not B
rule_end
"""
    assert set(after(text, "correction")) == {text.replace("> low", ">= high"), text.replace("< high", "<= low")}


def test_the_situation_cannot_occur() -> None:
    text = WINDOW.format("home")
    assumption = "\n\nASSUME NOT (Check AND temperature >= 30 AND home AND night)\n"
    assert after(text, "assumption") == [text[:-1] + assumption]


RELATED = """def_start
  event A
  event B
  event C
  measure m: boolean
  measure n: boolean
def_end
rule_start
  R1 when A and {{m}} then C // one
  R2 when {0} and {{n}} then not C // two
  R3 when B then A eventually
rule_end // the end
{1}purpose_start
  p1 exists B while C
purpose_end
"""


def test_the_dsl_has_a_relation_of_conditions() -> None:
    text = RELATED.format("A", "")
    block = "\n\nrelation_start\n  measure invariant (not ({m} and {n}))\nrelation_end"
    assert after(text, "assumption") == [text.replace("// the end", f"// the end{block}")]


def test_a_relation_follows_the_last_one() -> None:
    text = RELATED.format("A", "relation_start\n\tmutualExclusive B C // never\nrelation_end\n")
    relation = "\n\tmeasure invariant (not ({m} and {n}))"
    assert after(text.replace("  p1 exists B while C", "  p1 exists B"), "assumption") == [
        text.replace("// never", f"// never{relation}").replace("  p1 exists B while C", "  p1 exists B")
    ]


def test_two_events_do_not_occur_together() -> None:
    text = RELATED.format("B", "").replace(" and {m}", "").replace(" and {n}", "").replace("then A", "then C")
    text = text.replace("  measure m: boolean\n  measure n: boolean\n", "").replace("while C", "while B")
    assert any("\n  mutualExclusive A B\n" in one for one in after(text, "assumption"))


def test_no_assumption_excludes_a_trigger() -> None:
    text = "RULE one\nWHEN Check THEN Open AND Speak\n\nRULE two\nWHEN Check THEN NOT Open AND Beep\n"
    assert repairs_of(text, "SLEEC101")
    assert after(text, "assumption") == []


def test_a_rule_is_split() -> None:
    text = WINDOW.format("humid")
    rule = "\n\nRULE warm_part\nWHEN Check AND temperature >= 30 AND NOT (humid AND night) THEN OpenWindow"
    assert after(text, "rule-decomposition") == [
        text.replace("OpenWindow AND Speak // fresh air", f"Speak // fresh air{rule}")
    ]
