"""Calculations with several measures: read, printed and evaluated."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import sleec_runtime
from sleec_runtime.errors import LanguageError
from sleec_runtime.evaluation.formula_truth import Situation, holds, truth
from sleec_runtime.language import parse, print_ruleset
from sleec_runtime.model import Context
from tests.support.calculations import NAMES, OPERATORS, TEXT, guard_of, results, ruleset_of, worked_out


@st.composite
def sides(draw, depth: int = 3, products: int = 1):
    """One side of a comparison, with at most that many products of two measures on each path."""
    kind = draw(st.sampled_from(("measure", "number", "sum", "sum", "product"))) if depth else "measure"
    if kind == "measure":
        return f"{{{draw(st.sampled_from(NAMES))}}}"
    if kind == "number":
        return draw(st.sampled_from(("0", "1", "2", "K", "-2", "7")))
    if kind == "sum":
        operator = draw(st.sampled_from("+-"))
        return f"({draw(sides(depth - 1, products))} {operator} {draw(sides(depth - 1, products))})"
    if products:
        return f"({draw(sides(depth - 1, 0))} * {draw(sides(depth - 1, 0))})"
    return f"(2 * {draw(sides(depth - 1, 0))})"


conditions = st.builds("({} {} {})".format, sides(), st.sampled_from(sorted(OPERATORS)), sides())
values = st.fixed_dictionaries({name: st.integers(-9, 9) for name in NAMES})


def read(written: str):
    """The guard, or None where there are products of more than two measures."""
    try:
        return guard_of(written)
    except LanguageError as error:
        if {p.message[:9] for p in error.problems} <= {"a product"}:
            return None
        raise


@settings(max_examples=300, deadline=None)
@given(conditions, values)
def test_calculations_mean_what_arithmetic_says(written, known):
    guard = read(written)
    if guard is not None:
        assert holds(guard, Context(frozenset("A"), known)) == worked_out(written, known)


@settings(max_examples=100, deadline=None)
@given(conditions, st.sampled_from(("legos", "sleec-tk")))
def test_what_is_printed_is_read_as_the_same(written, dialect):
    from dataclasses import replace

    if read(written) is not None:
        ruleset = replace(ruleset_of(f"R1 when A and {written} then B"), dialect=dialect)
        text = print_ruleset(ruleset)
        again = parse(text)
        assert again.statements == ruleset.statements
        assert print_ruleset(replace(again, dialect=dialect)) == text


@pytest.mark.parametrize(
    ("written", "printed", "bare"),
    [
        ("(({y} + {x}) > K)", "(({y} + {x}) > K)", "y + x > K"),
        ("(K < ({x} * {y}))", "(({x} * {y}) > K)", "x * y > K"),
        ("((K * ({y} * {x})) <= (6 - {z}))", "(((3 * {x}) * {y}) + {z}) <= 6", "3 * x * y + z <= 6"),
        ("(((2 * {x}) + (2 * {y})) > 7)", "(({x} + {y}) > 3)", "x + y > 3"),
        ("(({x} + {y}) <> {x} * {x} - {y})", "((({x} + (2 * {y})) - ({x} * {x})) <> 0)", "x + 2 * y - x * x <> 0"),
    ],
)
def test_a_calculation_is_written_as_what_it_comes_to(written, printed, bare):
    from dataclasses import replace

    ruleset = ruleset_of(f"R1 when A and {written} then B")
    assert printed in print_ruleset(ruleset)
    assert f"A and {bare} then" in print_ruleset(replace(ruleset, dialect="sleec-tk"))


def test_a_calculation_without_a_value_is_unknown_or_false():
    guard = guard_of("(({x} + {y}) > K)")
    known = Context(frozenset("A"), {"x": 9})
    assert not holds(guard, known)
    assert truth(guard, Situation(known, absent=None)) is None
    with pytest.raises(sleec_runtime.errors.WrongType, match="1,000 digits; got 'nine'"):
        holds(guard, Context(frozenset("A"), {"x": "nine", "y": 1}))


def with_measures(count: int, condition: str) -> str:
    measures = "\n".join(f"  measure m{n}: numeric" for n in range(count))
    return (TEXT % (f"  R1 when A and {condition} then B", "")).replace("def_end", f"{measures}\ndef_end")


def test_too_much_is_refused_with_its_place():
    text = with_measures(21, " + ".join(f"{{m{n}}}" for n in range(21)) + " > 3")
    with pytest.raises(LanguageError) as caught:
        parse(text)
    (problem,) = caught.value.problems
    assert problem.message == "this calculation has 21 terms, more than 20"
    assert caught.value.source.place(problem.span).line == text[: text.index("R1 when")].count("\n") + 1
    assert problem.hint


@pytest.mark.parametrize("dialect", ["legos", "sleec-tk"])
def test_the_longest_calculation_is_read_as_it_is_printed(dialect):
    from dataclasses import replace

    pairs = [(x, y) for x in range(7) for y in range(x)][:20]
    whole = " - ".join(f"{factor} * {{m{x}}} * {{m{y}}}" for factor, (x, y) in enumerate(pairs, 2))
    ruleset = parse(with_measures(7, f"((not ({whole} > 3)) or ({{m1}} > 3))"))
    assert parse(print_ruleset(replace(ruleset, dialect=dialect))).statements == ruleset.statements


def test_a_constant_that_is_calculated_with_is_used():
    verdicts = results("R1 when A and (((K * {x}) + {y} + {z}) > 1) then B", only=["unused-name"])
    assert "constant" not in str(verdicts["unused-name"])
