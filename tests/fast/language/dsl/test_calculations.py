"""Calculations in the DSL."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from sleec_runtime.evaluation.formula_truth import Situation, truth
from sleec_runtime.language import parse, print_ruleset
from sleec_runtime.model import (
    Context,
    Truth,
)

CALCULATING = """def_start
  event A
  event B
  measure x: numeric
  measure y: numeric
  constant K = 3
def_end
rule_start
  R1 when A and %s then B
rule_end
"""


def guard_of(condition: str):
    (rule,) = parse(CALCULATING % condition).rules
    return rule.guard


@pytest.mark.parametrize(
    ("written", "meant"),
    [
        ("(({x} + 1) > 5)", "({x} > 4)"),
        ("((5 - {x}) > 2)", "({x} < 3)"),
        ("((2 * {x}) <= 5)", "({x} <= 2)"),
        ("((2 * {x}) < 5)", "({x} < 3)"),
        ("((2 * {x}) > 5)", "({x} > 2)"),
        ("((2 * {x}) >= 5)", "({x} >= 3)"),
        ("((2 * {x}) = 6)", "({x} = 3)"),
        ("({x} >= (2 * (K + 1)))", "({x} >= 8)"),
        ("(({x} - {y}) < 0)", "({x} < {y})"),
        ("(({x} + K) <= ({y} + 3))", "({x} <= {y})"),
        ("({x} > ({x} - ({x} - 4)))", "({x} > 4)"),
    ],
)
def test_a_calculation_is_read_as_a_comparison(written: str, meant: str) -> None:
    assert guard_of(written) == guard_of(meant)


@pytest.mark.parametrize(
    ("written", "value"),
    [("0 < 1", True), ("50 <> 34", True), ("(K < 3)", False), ("3 >= K", True), ("K = -> K", True), ("-1 > 0", False)],
)
def test_a_comparison_of_fixed_numbers_is_true_or_false(written: str, value: bool) -> None:
    text = CALCULATING % written
    ruleset = parse(text)
    (rule,) = ruleset.rules
    assert rule.guard == Truth(value)
    assert text[slice(*rule.guard.span)] in written
    assert ruleset.calculated_with == ({"K"} if "K" in written else set())
    printed = print_ruleset(ruleset)
    assert f"and {str(value).lower()} then" in printed
    assert parse(printed) == ruleset


@pytest.mark.parametrize(
    ("written", "value"),
    [("((2 * {x}) = 5)", False), ("((2 * {x}) <> 5)", True), ("((1 + 1) < K)", True), ("(({x} - {x}) > K)", False)],
)
def test_a_calculation_may_come_to_what_never_changes(written: str, value: bool) -> None:
    assert guard_of(written) == Truth(value)


@given(st.data())
def test_calculations_mean_what_arithmetic_says(data: st.DataObject) -> None:
    def side(depth: int) -> str:
        kind = data.draw(st.integers(0, 3 if depth else 1))
        if kind == 0:
            return "{x}"
        if kind == 1:
            return str(data.draw(st.integers(0, 9)))
        operator = "*" if kind == 3 else data.draw(st.sampled_from("+-"))
        left = str(data.draw(st.integers(0, 4))) if operator == "*" else side(depth - 1)
        return f"({left} {operator} {side(depth - 1)})"

    left, right = side(3), f"({side(2)} + 0)"
    operator = data.draw(st.sampled_from(["<", "<=", "=", "<>", ">", ">="]))
    x = data.draw(st.integers(-20, 20))
    guard = guard_of(f"({left} {operator} {right})")
    python = f"({left}) {({'=': '==', '<>': '!='}).get(operator, operator)} ({right})".replace("{x}", f"({x})")
    ruleset = parse(CALCULATING % "({x} > 0)")
    situation = Situation(Context(frozenset({"A"}), {"x": x}), ruleset.measures)
    assert truth(guard, situation) == eval(python)


def test_a_window_may_be_calculated() -> None:
    (rule,) = parse((CALCULATING % "({x} > 1)").replace("then B", "then B within (2 * K) minutes")).rules
    (obligation,) = rule.default.obligations
    assert str(obligation.timing) == "within 6 minutes"
