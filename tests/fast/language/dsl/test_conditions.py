"""Conditions of the DSL as formulas."""

from __future__ import annotations

import pytest

from sleec_runtime.model import (
    And,
    Atom,
    Comparison,
    MeasureRef,
    Not,
    Number,
    Or,
    ScaleValue,
)
from tests.support.dsl_rules import rules

M, N = Atom("condition", "m"), Atom("condition", "n")
HIGH = Comparison(MeasureRef("risk"), "=", ScaleValue("high", 2))
MANY = Comparison(MeasureRef("x"), ">", Number(5, "K"))


@pytest.mark.parametrize(
    ("text", "formula"),
    [
        ("m", M),
        ("{m}", M),
        ("not m", Not(M)),
        ("m and n or risk = high", Or((And((M, N)), HIGH))),
        ("m or n and risk = high", And((Or((M, N)), HIGH))),
        ("m or n or m", Or((M, N, M))),
        ("not m and n", And((Not(M), N))),
        ("not risk = high and m", And((Not(HIGH), M))),
        ("({m} and ({n} and {m}))", And((M, N, M))),
        ("(({m} and {n}) and {m})", And((And((M, N)), M))),
        ("({x} > K)", MANY),
        ("({x} > -> K)", MANY),
        ("m = true", M),
        ("m <> true", Not(M)),
        ("high = risk", Comparison(ScaleValue("high", 2), "=", MeasureRef("risk"))),
        ("x >= -3", Comparison(MeasureRef("x"), ">=", Number(-3))),
    ],
)
def test_conditions(text, formula):
    (rule,) = rules(f"R1 when A and {text} then B").rules
    assert rule.guard == formula


def test_dialects_are_told_apart():
    assert rules("R1 when A and m then B").dialect == "sleec-tk"
    assert rules("R1 when A then B within 5 minutes otherwise {C unless m}").dialect == "sleec-tk"
    assert rules("R1 when A and {m} then B").dialect == "legos"
    assert rules("R1 when A then B eventually").dialect == "legos"
    assert rules("R1 when A then B").dialect == "legos"


def test_rules_of_the_dsl_are_read_by_priority():
    ruleset = rules("R1 when A then B unless m then C unless n")
    assert (ruleset.reading, ruleset.syntax) == ("priority", "dsl")
    (rule,) = ruleset.rules
    assert [hedge.obligations != () for hedge in rule.hedges] == [True, False]
