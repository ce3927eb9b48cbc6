"""Comments with parentheses and words do not disturb a repair."""

from __future__ import annotations

import pytest

from sleec_runtime.language import parse
from sleec_verify.checks import run_checks
from sleec_verify.repairs.operators import OPERATORS
from sleec_verify.repairs.search import RepairSearch
from tests.support.repairs import findings, repairs_of, texts_after

IN_A_GUARD = "WHEN a AND // see (1\n x OR y THEN b\nWHEN a AND z THEN NOT b\n"
CLOSED_LATER = "WHEN a AND ( // see (1)\n x OR y) THEN b // 2)\nWHEN a AND z THEN NOT b\n"
IN_A_CONDITION = "WHEN a THEN b\nUNLESS // (\nq IN WHICH CASE NOT b\nWHEN a AND z THEN b\n"
IN_THE_DSL = """\
def_start
event A
event B
measure x: boolean
measure y: boolean
measure z: boolean
def_end
rule_start
R1 when A and /* (odd */ ({x} and {y}) then B
R2 when A and {z} then not B
rule_end
"""


@pytest.mark.parametrize("text", [IN_A_GUARD, CLOSED_LATER, IN_A_CONDITION, IN_THE_DSL])
def test_a_parenthesis_in_a_comment_is_no_part_of_a_formula(text: str) -> None:
    repairs = repairs_of(text, "SLEEC101")
    operators = {repair.candidate.operator for repair in repairs}
    assert {"trigger-strengthening", "rule-removal"} <= operators


def test_a_formula_beside_a_comment_gets_its_own_parentheses() -> None:
    texts = texts_after(IN_A_GUARD, repairs_of(IN_A_GUARD, "SLEEC101"))
    assert IN_A_GUARD.replace("x OR y THEN", "(x OR y) AND NOT z THEN") in texts
    texts = texts_after(CLOSED_LATER, repairs_of(CLOSED_LATER, "SLEEC101"))
    assert CLOSED_LATER.replace("y) THEN", "y) AND NOT z THEN") in texts


def test_an_operator_that_fails_hides_no_other_repair(monkeypatch: pytest.MonkeyPatch) -> None:
    def fails(*_: object) -> None:
        raise ValueError("substring not found")

    ruleset = parse("WHEN a AND x THEN b\nWHEN a AND z THEN NOT b\n")
    results = run_checks(ruleset)
    (conflict,) = (one for one in findings(results) if one.code == "SLEEC101")
    before = RepairSearch(ruleset, results).repairs(conflict)
    monkeypatch.setitem(OPERATORS, "SLEEC101", (fails, *OPERATORS["SLEEC101"]))
    search = RepairSearch(ruleset, results)
    assert len(search.repairs(conflict)) == len(before)
    assert search.undecided == "internal error: ValueError: substring not found"
