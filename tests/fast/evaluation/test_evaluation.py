"""Algorithm 1 in both readings, nested chains, exact comparisons, and the open world."""

from __future__ import annotations

from decimal import Decimal
from fractions import Fraction
from itertools import product
from typing import Any

import pytest

from sleec_runtime.errors import WrongType
from sleec_runtime.evaluation.due import broken_assumptions, due
from sleec_runtime.evaluation.formula_truth import Situation, holds
from sleec_runtime.evaluation.hedge_chain import Decision, Undetermined, decide, walk
from sleec_runtime.model import (
    And,
    Assume,
    Atom,
    Clause,
    Comparison,
    Context,
    Formula,
    Measure,
    MeasureRef,
    Not,
    Number,
    Obligation,
    Or,
    Reading,
    Rule,
    Ruleset,
    ScaleValue,
    Truth,
)

RISK = {"Risk": Measure("Risk", "scale", ("low", "moderate", "severe"))}


def atom(name: str) -> Atom:
    return Atom("condition", name)


def clause(condition: Formula | None, *names: str, hedges: tuple[Clause, ...] = ()) -> Clause:
    return Clause(condition, tuple(Obligation(name) for name in names), hedges)


def chain(*conditions: str, guard: Formula | None = None) -> Rule:
    hedges = tuple(clause(atom(name), f"O{number}") for number, name in enumerate(conditions, 1))
    return Rule("r", "T", guard, clause(None, "O0"), hedges)


def situation(**values: Any) -> Context:
    return Context(frozenset({"T"}), values)


def number_of(rule: Rule, reading: Reading, **values: Any) -> int | None:
    decision = decide(rule, situation(**values), reading)
    return None if decision is None else decision.clause


@pytest.mark.parametrize("length", range(5))
def test_a_cascade_stops_at_the_first_false_condition_and_priority_takes_the_last_true_one(length: int) -> None:
    names = [f"c{i}" for i in range(length)]
    for bits in product((False, True), repeat=length):
        values = dict(zip(names, bits, strict=True))
        prefix = next((i for i, bit in enumerate(bits) if not bit), length)
        last = max((i + 1 for i, bit in enumerate(bits) if bit), default=0)
        assert number_of(chain(*names), "cascade", **values) == prefix
        assert number_of(chain(*names), "priority", **values) == last


def test_a_rule_without_hedges_has_its_default_and_no_layer() -> None:
    decision = decide(chain(), situation(), "cascade")
    assert decision is not None
    assert (decision.clause, decision.layer, decision.steps) == (0, None, ())


def test_a_rule_says_nothing_without_its_trigger_or_its_guard() -> None:
    guarded = chain("a", guard=atom("g"))
    assert decide(guarded, Context(frozenset({"U"}), {"g": True}), "cascade") is None
    assert decide(guarded, Context(), "cascade") is None
    assert number_of(guarded, "cascade", g=False, a=True) is None
    assert number_of(guarded, "cascade", g=True, a=True) == 1


def test_a_nested_chain_speaks_only_where_its_holder_decides() -> None:
    nested = Rule(
        "r",
        "T",
        None,
        clause(None, "O0", hedges=(clause(atom("d"), "O1"),)),
        (
            clause(atom("a"), "O2", hedges=(clause(atom("x"), "O3"), clause(atom("y"), "O4"))),
            clause(atom("b"), "O5"),
        ),
    )
    assert [c.obligations[0].name for c in nested.clauses()] == [f"O{i}" for i in range(6)]
    for bits in product((False, True), repeat=5):
        a, b, d, x, y = bits
        within = (4 if y else 3) if x else 2
        expected = (5 if b else within) if a else (1 if d else 0)
        assert number_of(nested, "cascade", a=a, b=b, d=d, x=x, y=y) == expected
        within = 4 if y else 3 if x else 2
        expected = 5 if b else within if a else 1 if d else 0
        assert number_of(nested, "priority", a=a, b=b, d=d, x=x, y=y) == expected


@pytest.mark.parametrize(
    ("reading", "looked_at"),
    [("cascade", [(1, True), (2, False)]), ("priority", [(3, True)])],
)
def test_a_decision_carries_the_conditions_that_decided_it(reading: Reading, looked_at: list[tuple[int, bool]]) -> None:
    decision = decide(chain("a", "b", "c"), situation(a=True, c=True), reading)
    assert decision is not None
    assert [(step.clause, step.held) for step in decision.steps] == looked_at


# Formulas -------------------------------------------------------------------------------------------------


def test_the_connectives() -> None:
    p, q = atom("p"), atom("q")
    for left, right in product((False, True), repeat=2):
        context = situation(p=left, q=right)
        assert holds(And((p, q)), context) == (left and right)
        assert holds(Or((p, q)), context) == (left or right)
        assert holds(Not(p), context) == (not left)
    assert holds(Truth(True), Context())
    assert not holds(Truth(False), Context())


def test_what_nobody_reported_is_false_in_the_closed_world() -> None:
    older = Comparison(MeasureRef("Age"), ">=", Number(18))
    younger = Comparison(MeasureRef("Age"), "<", Number(18))
    assert not holds(atom("p"), Context())
    assert not holds(older, Context())
    assert not holds(younger, Context())


def test_triggers_are_read_from_the_triggers() -> None:
    assert holds(Atom("trigger", "T"), situation())
    assert not holds(Atom("trigger", "U"), situation(U=True))


@pytest.mark.parametrize(
    ("value", "equal"),
    [
        (36.6, True),
        (Decimal("36.6"), True),
        (Fraction(183, 5), True),
        (36.60000000000001, False),
        (36, False),
    ],
)
def test_a_float_is_the_decimal_that_it_prints_as(value: Any, equal: bool) -> None:
    is_366 = Comparison(MeasureRef("t"), "=", Number(Fraction(183, 5)))
    assert holds(is_366, situation(t=value)) is equal


def test_every_operator_at_the_border() -> None:
    expected = {"<": (1, 0, 0), "<=": (1, 1, 0), "=": (0, 1, 0), "!=": (1, 0, 1), ">=": (0, 1, 1), ">": (0, 0, 1)}
    for operator, answers in expected.items():
        for value, answer in zip((17, 18, 19), answers, strict=True):
            assert holds(Comparison(MeasureRef("n"), operator, Number(18)), situation(n=value)) == bool(answer)  # type: ignore[arg-type]
            mirrored = Comparison(Number(18), operator, MeasureRef("n"))  # type: ignore[arg-type]
            assert holds(mirrored, situation(n=36 - value)) == bool(answer)


def test_scales_compare_by_rank() -> None:
    at_least = Comparison(MeasureRef("Risk"), ">=", ScaleValue("moderate", 1))
    assert [holds(at_least, situation(Risk=value), RISK) for value in RISK["Risk"].values] == [False, True, True]
    below_the_least = Comparison(MeasureRef("Risk"), "<", ScaleValue("low", 0))
    assert not any(holds(below_the_least, situation(Risk=value), RISK) for value in RISK["Risk"].values)
    both = {**RISK, "Other": Measure("Other", "scale", RISK["Risk"].values)}
    assert holds(Comparison(MeasureRef("Risk"), "<", MeasureRef("Other")), situation(Risk="low", Other="severe"), both)


def test_a_value_of_an_unknown_scale_only_equals_itself() -> None:
    is_low = Comparison(MeasureRef("Risk"), "=", ScaleValue("low", 0))
    assert holds(is_low, situation(Risk="low"))
    with pytest.raises(WrongType, match="no known scale"):
        holds(is_low, situation(Risk="severe"))


@pytest.mark.parametrize("value", [True, "eighteen", float("nan"), float("inf"), object()])
def test_what_is_no_number_cannot_be_compared_with_one(value: Any) -> None:
    with pytest.raises(WrongType):
        holds(Comparison(MeasureRef("n"), "<", Number(18)), situation(n=value))


@pytest.mark.parametrize("value", [1, 0, "true", 1.0])
def test_a_condition_is_true_or_false_and_nothing_else(value: Any) -> None:
    with pytest.raises(WrongType, match="true or false"):
        holds(atom("p"), situation(p=value))


def test_a_number_is_no_value_of_a_scale() -> None:
    with pytest.raises(WrongType, match="scale"):
        holds(Comparison(MeasureRef("Risk"), "=", ScaleValue("low", 0)), situation(Risk=1), RISK)
    with pytest.raises(WrongType, match="scale"):
        holds(Comparison(MeasureRef("Risk"), "=", ScaleValue("low", 0)), situation(Risk="middling"), RISK)


def test_obligations_are_no_part_of_a_context() -> None:
    with pytest.raises(ValueError, match="obligation"):
        holds(Atom("obligation", "O"), situation(O=True))


# The open world -------------------------------------------------------------------------------------------


def outcome(rule: Rule, reading: Reading, **values: Any) -> int | tuple[str, ...] | None:
    result = walk(rule, Situation(situation(**values), absent=None), reading)
    if isinstance(result, Undetermined):
        return result.missing
    return None if result is None else result.clause


def test_an_open_decision_stands_where_the_missing_conditions_do_not_matter() -> None:
    assert outcome(chain("a", "b"), "cascade", a=False) == 0
    assert outcome(chain("a", "b"), "cascade", b=True) == ("a",)
    assert outcome(chain("a", "b"), "cascade", a=True) == ("b",)
    assert outcome(chain("a", "b"), "cascade") == ("a", "b")
    assert outcome(chain("a", "b"), "priority", b=True) == 2
    assert outcome(chain("a", "b"), "priority", b=False) == ("a",)
    assert outcome(chain("a", guard=atom("g")), "cascade", g=False) is None
    assert outcome(chain("a", guard=atom("g")), "cascade", a=True) == ("g",)


def test_only_the_missing_conditions_that_matter_are_named() -> None:
    condition = Or((And((atom("a"), Not(atom("b")))), Comparison(MeasureRef("m"), "<", MeasureRef("n"))))
    rule = Rule("r", "T", None, clause(None, "O0"), (clause(condition, "O1"),))
    assert outcome(rule, "cascade", a=True, b=False) == 1
    assert outcome(rule, "cascade", b=True, m=1) == ("n",)
    assert outcome(rule, "cascade", a=True, m=2, n=1) == ("b",)


@pytest.mark.parametrize("reading", ["cascade", "priority"])
def test_an_open_decision_is_that_of_every_completion(reading: Reading) -> None:
    rule = Rule(
        "r",
        "T",
        None,
        clause(None, "O0"),
        (
            clause(atom("a"), "O1", hedges=(clause(atom("b"), "O2"),)),
            clause(Not(atom("c")), "O3"),
        ),
    )
    for values in product((None, False, True), repeat=3):
        known = {name: value for name, value in zip("abc", values, strict=True) if value is not None}
        answers = {
            number_of(rule, reading, **{**dict(zip("abc", bits, strict=True)), **known})
            for bits in product((False, True), repeat=3)
        }
        answer = outcome(rule, reading, **known)
        if len(answers) == 1:
            assert {answer} == answers
        else:
            assert isinstance(answer, tuple)
            assert set(answer) <= set("abc") - known.keys()


# All rules ------------------------------------------------------------------------------------------------


def test_what_is_due_comes_in_the_order_of_the_rules_once() -> None:
    first = Rule("r1", "T", None, Clause(None, (Obligation("B"), Obligation("A"))), ())
    second = Rule("r2", "T", None, Clause(None, (Obligation("A"), Obligation("C", negated=True))), ())
    other = Rule("r3", "U", None, Clause(None, (Obligation("D"),)), ())
    answer = due(Ruleset((second, first, other)), situation())
    assert answer.obligations == ("A", "B")
    assert answer.prohibitions == ("C",)
    assert [decision.rule.label for decision in answer.decisions] == ["r2", "r1"]


def test_definition_1_where_proposition_1_fails_to_the_letter() -> None:
    r1 = Rule("R1", "a", None, clause(None, "o1"), (clause(atom("c"), "o2"),))
    r2 = Rule("R2", "b", None, clause(None, "o3"), (clause(atom("d"), "o4"),))
    assert due(Ruleset((r1, r2)), Context(frozenset("ab"), {"c": True})).obligations == ("o2", "o3")


def test_a_name_that_is_due_has_not_happened() -> None:
    first = Rule("r1", "T", None, clause(None, "U"), ())
    second = Rule("r2", "U", None, clause(None, "O"), ())
    assert due(Ruleset((first, second)), situation()).obligations == ("U",)


def test_a_context_that_breaks_an_assumption_is_told() -> None:
    assumption = Assume(Not(And((atom("Asleep"), atom("Walking")))))
    ruleset = Ruleset((chain(), assumption))
    assert broken_assumptions(ruleset, situation(Asleep=True, Walking=True)) == (assumption,)
    assert broken_assumptions(ruleset, situation(Asleep=True)) == ()


def test_decisions_are_values() -> None:
    assert decide(chain("a"), situation(a=True), "cascade") == decide(chain("a"), situation(a=True), "cascade")
    assert isinstance(decide(chain("a"), situation(), "cascade"), Decision)
