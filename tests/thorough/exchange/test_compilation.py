"""The compiled forms say what the rules say, read back by programs that did not write them."""

from __future__ import annotations

import json
from fractions import Fraction
from itertools import islice

import pytest
import z3
from hypothesis import given, settings

from sleec_runtime.language import load, parse
from sleec_verify.exchange.compilation import FORMS, compile_to
from sleec_verify.exchange.compilation.clauses import encode_ruleset, variable_names
from sleec_verify.exchange.compilation.equation_one import EquationOne
from tests.fast.checks.test_semantics import EIGHT
from tests.support import brute_force as brute
from tests.support.growth import grows_in_proportion
from tests.support.small_rulesets import small_rulesets
from tests.support.studies import each_study

TEXT = """
MEASURE Age: number
MEASURE Repeats: integer
MEASURE Risk: low < middle < high
CONSTANT LegalAge = 18
EXCLUSIVE Answer, Wait, Leave
NEVER Leave AND NOT (Tell OR the user is asleep)
ASSUME NOT (Called AND Alarm)
RULE calls
WHEN Called AND (Age < LegalAge OR Age > 65.5) THEN Answer AND NOT Leave
UNLESS Repeats >= 2.5 IN WHICH CASE (Wait UNLESS Risk != middle)
UNLESS Dark
RULE answered
WHEN Answer THEN Tell
DOMAIN ward
RULE alarmed
WHEN Alarm AND Age >= Limit THEN Leave AND Tell
"""


@pytest.mark.parametrize("form", FORMS)
def test_every_rule_and_constraint_is_in_every_form(form):
    text = compile_to(parse(TEXT), form)
    for name in ("Called", "Age", "Repeats", "Risk", "Answer", "Leave", "Tell", "Alarm", "Limit"):
        assert name in text


@pytest.mark.parametrize("form", FORMS)
def test_a_domain_leaves_out_the_rules_of_others(form):
    ruleset = parse(TEXT.replace("DOMAIN ward", "DOMAIN ward") + "DOMAIN home\nRULE last WHEN Bell THEN Open")
    assert "Open" not in compile_to(ruleset, form, "ward")
    assert "Open" in compile_to(ruleset, form, "home")


def test_another_form_is_a_key_error():
    with pytest.raises(KeyError):
        compile_to(parse(TEXT), "prose")


def test_a_name_that_is_trigger_and_obligation_is_two_symbols():
    ruleset = parse(TEXT)
    equation = EquationOne(ruleset)
    assert equation.symbol("trigger", "Answer") == "Answer"
    assert equation.symbol("obligation", "Answer") == "due(Answer)"
    assert equation.symbol("obligation", "Tell") == "Tell"
    assert "due(Answer)" in compile_to(ruleset, "sympy")


def test_sympy_reads_as_people_read():
    lines = compile_to(parse(EIGHT), "sympy").splitlines()
    assert "# dress_assist, hedge 1" in lines
    assert (
        "Implies(CurtainOpenRequest & UserUndressed & ~UserDistressed, ExplainWhy & RefuseRequest)"
        in lines[lines.index("# dress_assist, hedge 1") + 1]
    )
    assert "Implies(PreparingExamination & (UserAge < LegalAge), AskLegalPresence)" in lines


def test_latex_names_are_escaped():
    text = compile_to(parse("RULE a_b\nWHEN the user calls THEN pick_up"), "latex")
    assert r"pick\_up" in text
    assert r"the\ user\ calls" in text
    assert r"\text{a\_b,\ default}" in text
    assert text.startswith("\\begin{align*}")


def test_dimacs_comments_map_every_variable():
    lines = compile_to(parse(TEXT), "dimacs").splitlines()
    (header,) = (line for line in lines if line.startswith("p "))
    _, _, variables, clauses = header.split()
    comments = [line.split(maxsplit=3) for line in lines if line.startswith("c ")]
    assert [int(number) for _, number, _, _ in comments] == list(range(1, int(variables) + 1))
    assert ["c", "1", "trigger", "Called"] in comments
    rows = [line for line in lines if line[0] not in "cp"]
    assert len(rows) == int(clauses)
    assert all(row.endswith(" 0") for row in rows)
    kinds = {kind for _, _, kind, _ in comments}
    assert kinds >= {"trigger", "condition", "obligation", "measure", "prefix", "guard"}


def test_json_and_lines_hold_the_same_clauses():
    ruleset = parse(TEXT)
    document = json.loads(compile_to(ruleset, "json"))
    encoder = encode_ruleset(EquationOne(ruleset))
    assert document["clauses"] == encoder.clauses
    assert document["reading"] == "cascade"
    names = variable_names(encoder)
    assert {v["variable"]: (v["kind"], v["name"]) for v in document["variables"]} == names
    lines = compile_to(ruleset, "cnf").splitlines()
    assert [line.count(" | ") + 1 for line in lines] == [len(clause) for clause in encoder.clauses]


@settings(max_examples=60, deadline=None)
@given(small_rulesets(measures=True, rules=2))
def test_smtlib_entails_what_the_rules_entail(ruleset):
    """z3 reads the SMT-LIB text, and decides in some contexts what follows from it."""
    solver = z3.Solver()
    solver.from_string(compile_to(ruleset, "smtlib").replace("(check-sat)", ""))
    for context in islice(brute.contexts(ruleset), 5, None, 397):
        solver.push()
        for name in ruleset.triggers:
            solver.add(z3.Bool(name) == (name in context.triggers))
        for name in ruleset.conditions:
            solver.add(z3.Bool(name) == (context.conditions[name] is True))
        for name, measure in ruleset.measures.items():
            value = context.conditions[name]
            number = z3.Real(name) if measure.kind == "number" else z3.Int(name)
            solver.add(number == (measure.values.index(value) if isinstance(value, str) else _exact(value)))
        possible = solver.check() == z3.sat
        assert possible == (not brute.conflicts(ruleset, context))
        for literal in brute.due(ruleset, context) if possible else ():
            variable = z3.Bool(EquationOne(ruleset).symbol("obligation", literal.name))
            assert solver.check(variable if literal.negated else z3.Not(variable)) == z3.unsat
        solver.pop()


def _exact(value):
    fraction = Fraction(value)
    return z3.Q(fraction.numerator, fraction.denominator) if fraction.denominator != 1 else fraction.numerator


def test_numbers_of_smtlib_are_exact():
    text = compile_to(parse("MEASURE n: integer\nWHEN t AND (x < -0.5 OR n >= 1.5 OR n < x) THEN o AND p"), "smtlib")
    assert "(- (/ 1.0 2.0))" in text
    assert "(>= (to_real |n|) (/ 3.0 2.0))" in text
    solver = z3.Solver()
    solver.from_string(text)
    assert solver.check() == z3.sat


def _timed(rules: int) -> str:
    """Rules with every construct for time, each with events and conditions of its own."""
    each = range(rules)
    return "".join(
        (
            "def_start\n",
            *(f"event A{n} event B{n} measure p{n}: boolean\n" for n in each),
            "def_end\nrule_start\n",
            *(
                f"R{n} when A{n} then B{n} within {n + 1} seconds otherwise {{B{n} eventually unless {{p{n}}} then not "
                f"A{n} within 9 seconds}} unless {{p{n}}} then not B{n} within [3, 4] minutes else A{n}\n"
                for n in each
            ),
            "rule_end\nrelation_start\n",
            *(f"mutualExclusive A{n} B{n}\nhappenBefore A{n} B{n}\n" for n in each),
            "relation_end\nconcern_start\n",
            *(f"c{n} exists A{n}\n" for n in each),
            "concern_end\n",
        )
    )


@pytest.mark.speed
@pytest.mark.parametrize("form", FORMS)
def test_the_work_grows_with_the_rules(form):
    few, many = parse(_timed(20)), parse(_timed(200))
    for ruleset in (few, many):
        compile_to(ruleset, form)
    assert grows_in_proportion(lambda: compile_to(few, form), lambda: compile_to(many, form), 10)


@each_study
def test_no_form_refuses_a_study(path):
    ruleset = load(path)
    for form in FORMS:
        assert compile_to(ruleset, form)
