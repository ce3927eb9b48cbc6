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


def _dsl(*rules: str) -> str:
    return IN_THE_DSL[: IN_THE_DSL.index("R1")] + "\n".join(rules) + "\nrule_end\n"


STATUTE = "/* law 12, section 3 */"
KEPT = [
    (_dsl("R1 when A and {x} then B", f"R2 when A and {STATUTE} {{y}} then not B"), "SLEEC101", STATUTE),
    (_dsl("R1 when A and {x} then B", f"R2 when A and ({{y}} {STATUTE} or {{z}}) then not B"), "SLEEC101", STATUTE),
    ("WHEN a AND x // one\n OR y THEN b AND c\nWHEN a AND z THEN NOT b // two\n", "SLEEC101", "// one"),
    ("WHEN a THEN b\nUNLESS x // one\n AND y IN WHICH CASE NOT b\nWHEN a AND z THEN b\n", "SLEEC101", "// one"),
    ("WHEN a THEN b AND // one\n c AND d\nWHEN a AND x THEN NOT c\n", "SLEEC101", "// one"),
]


@pytest.mark.parametrize(("text", "code", "comment"), KEPT)
def test_comments_inside_a_changed_rule_stay(text: str, code: str, comment: str) -> None:
    removals = ("rule-removal", "defeater-removal")
    repairs = [one for one in repairs_of(text, code) if one.candidate.operator not in removals]
    changes = {one.candidate.operator for one in repairs}
    assert "trigger-strengthening" in changes
    assert all(comment in changed for changed in texts_after(text, repairs))


def test_a_narrower_exception_keeps_its_comment() -> None:
    text = KEPT[3][0]
    (refined,) = (one for one in repairs_of(text, "SLEEC101") if one.candidate.operator == "defeater-refinement")
    assert "\nUNLESS x // one\n AND y AND NOT z IN WHICH CASE NOT b\n" in texts_after(text, [refined])[0]


@pytest.mark.parametrize(
    ("text", "code"),
    [
        ("WHEN a THEN the robot // important note\n has to leave\n", "SLEEC521"),
        ("WHEN a THEN take // of the child only\n photos\nWHEN b THEN take photo\n", "SLEEC525"),
    ],
)
def test_a_name_with_a_comment_inside_is_not_replaced(text: str, code: str) -> None:
    assert code in {one.code for one in findings(run_checks(parse(text)))}
    assert all("// " in changed for changed in texts_after(text, repairs_of(text, code)))
