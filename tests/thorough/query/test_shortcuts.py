"""What is decided without a solver, or once for many rules, is what the solver says of each."""

from __future__ import annotations

from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from benchmarks import checking
from benchmarks.random_rules import random_rules
from sleec_runtime.language import parse
from sleec_runtime.model import And, Atom, Comparison, MeasureRef, Not, Number, Or, Rule, Truth
from sleec_verify.checks import reading, run_checks
from sleec_verify.query import witness
from sleec_verify.query.rule_shape import LARGEST, shape_of
from sleec_verify.query.ruleset_index import RulesetIndex
from sleec_verify.query.unit_propagation import Impossible, Propagation, propagate_units
from sleec_verify.query.witness import smallest_situation
from tests.support.small_rulesets import small_rulesets

_ATOMS = [Atom("trigger", "t"), Atom("trigger", "u"), *(Atom("condition", name) for name in "abcd")]
FORMULAS = st.recursive(
    st.one_of(st.sampled_from(_ATOMS), st.booleans().map(Truth), st.just(Comparison(MeasureRef("x"), "<", Number(3)))),
    lambda inner: st.one_of(
        inner.map(Not),
        st.lists(inner, min_size=1, max_size=3).map(lambda parts: And(tuple(parts))),
        st.lists(inner, min_size=1, max_size=3).map(lambda parts: Or(tuple(parts))),
    ),
    max_leaves=12,
)
CONES = RulesetIndex(parse("MEASURE x: number\nWHEN t AND x < 3 THEN o\n"))


@pytest.mark.slow
@settings(max_examples=600)
@given(FORMULAS)
def test_forced_literals_are_the_smallest_situation(formula) -> None:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(witness, "propagate_units", nothing_forced)
        searched = smallest_situation(CONES, formula)
    assert smallest_situation(CONES, formula) == searched
    try:
        found = propagate_units(formula)
    except Impossible:
        assert searched is None
    else:
        if searched is not None:
            assert found.least() <= len(searched.triggers) + len(searched.absent) + len(searched.conditions)


class NothingForced(Propagation):
    def least(self) -> int:
        return 0


def nothing_forced(formula) -> Propagation:
    return NothingForced({}, [formula])


@pytest.mark.parametrize(
    ("formula", "literals", "least"),
    [
        (
            And((_ATOMS[0], Or((Not(_ATOMS[0]), Not(_ATOMS[2]))))),
            {("trigger", "t"): True, ("condition", "a"): False},
            2,
        ),
        (And((_ATOMS[2], Or((_ATOMS[2], _ATOMS[3])))), {("condition", "a"): True}, 1),
        (Or((_ATOMS[2], _ATOMS[3])), {}, 1),
        (And((Or((_ATOMS[2], _ATOMS[3])), Or((_ATOMS[3], _ATOMS[4])), Or((_ATOMS[0], _ATOMS[1])))), {}, 2),
        (Comparison(MeasureRef("x"), "<", Number(3)), {}, 1),
    ],
)
def test_what_is_forced(formula, literals, least) -> None:
    assert (propagate_units(formula).literals, propagate_units(formula).least()) == (literals, least)


@pytest.mark.slow
@settings(max_examples=100)
@given(small_rulesets(assumptions=False, measures=True, rules=6, hedges=3, nested=False))
def test_the_readings_of_rules_of_one_shape_part_as_those_of_each_alone(ruleset) -> None:
    found = {f.rules[0]: f for f in run_checks(ruleset, ["reading"])[0].findings}
    for rule in ruleset.rules:
        alone = replace(
            ruleset, statements=tuple(s for s in ruleset.statements if s is rule or not isinstance(s, Rule))
        )
        (result,) = run_checks(alone, ["reading"])
        assert [f for label, f in found.items() if label == rule.label] == list(result.findings)


def test_rules_of_one_shape_are_asked_about_once(monkeypatch: pytest.MonkeyPatch) -> None:
    asked = []
    parted = reading.where_readings_differ

    def counted(index: RulesetIndex, position: int):
        asked.append(position)
        return parted(index, position)

    monkeypatch.setattr(reading, "where_readings_differ", counted)
    rules = "WHEN t{0} THEN o{0} UNLESS a{0} IN WHICH CASE p{0} UNLESS {1}{0} IN WHICH CASE q{0}\n"
    ruleset = parse("".join(rules.format(number, "zZ"[number % 2]) for number in range(1, 9)))
    (result,) = run_checks(ruleset, ["reading"])
    assert len(result.findings) == 8
    assert len(asked) == 2
    witnesses = [dict(f.witness.conditions) for f in result.findings if f.witness is not None]
    assert witnesses[:2] == [{"a1": False, "Z1": True}, {"a2": False, "z2": True}]


def test_a_large_formula_has_no_shape() -> None:
    formula = And(tuple(Atom("condition", f"c{number}") for number in range(LARGEST)))
    assert shape_of([formula], {}) is None
    assert shape_of([Comparison(MeasureRef("x"), "<", MeasureRef("y"))], {}) is None


def test_random_rules_are_found_the_same_with_and_without(monkeypatch: pytest.MonkeyPatch) -> None:
    ruleset = parse(random_rules(150, hedges=2, names_per_rule=0.1))

    def found() -> list[object]:
        return [finding for result in run_checks(ruleset) for finding in result.findings]

    quick = found()
    monkeypatch.setattr(witness, "propagate_units", nothing_forced)
    monkeypatch.setattr("sleec_verify.query.rule_shape.LARGEST", 0)
    assert found() == quick


@pytest.mark.speed
@pytest.mark.parametrize(
    ("rules", "bound"), [(checking.FEW, checking.BOUND_FEW), (checking.MANY, checking.BOUND_MANY)], ids=["few", "many"]
)
def test_a_check_takes_a_few_times_as_long_as_parsing(rules: tuple[int, float], bound: int) -> None:
    # Another process on the same core disturbs one measurement, and hardly three.
    assert any(checking.ratio(*rules, rounds=2)[0] <= bound for _ in range(3))
