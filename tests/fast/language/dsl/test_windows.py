"""Times and alternatives of responses in the DSL."""

from __future__ import annotations

from fractions import Fraction

import pytest

from sleec_runtime.errors import LanguageError
from sleec_runtime.language import parse, print_ruleset
from sleec_runtime.model import (
    Calculation,
    Length,
    MeasureRef,
    Number,
)
from tests.support.dsl_rules import rules, timing


@pytest.mark.parametrize(
    ("text", "seconds"),
    [("5 minutes", 300), ("1 minute", 60), ("2 hours", 7200), ("1 day", 86400), ("K seconds", 5), ("L hours", 18000)],
)
def test_windows_have_exact_seconds_and_keep_what_is_written(text, seconds):
    window = timing(f"B within {text}").window
    assert window.end.seconds == Fraction(seconds)
    assert window.start is None
    assert f"within {text}".rstrip("s") in print_ruleset(rules(f"R1 when A then B within {text}"))


@pytest.mark.parametrize(
    "text", ["[1, 5] minutes", "[1 minutes, 5 minutes]", "[1, 5 minutes]", "[60 seconds, 5 minutes]"]
)
def test_windows_with_two_ends(text):
    window = timing(f"B within {text}").window
    assert (window.start.seconds, window.end.seconds) == (60, 300)


def test_a_measure_may_say_how_long():
    assert timing("B within {x} seconds").window.end == Length(MeasureRef("x"), "seconds")


@pytest.mark.parametrize(
    ("text", "amount", "printed"),
    [
        ("({x} + 2) minutes", ((1, ("x",)), (2, ())), "({x} + 2) minutes"),
        ("(120 - ((22 - {x}) * 15)) seconds", ((15, ("x",)), (-210, ())), "((15 * {x}) - 210) seconds"),
        ("(K - {x}) seconds", ((5, ()), (-1, ("x",))), "(5 - {x}) seconds"),
        ("(2 * {x}) hours", ((2, ("x",)),), "(2 * {x}) hours"),
        ("({x} * {x} - 1) days", ((1, ("x", "x")), (-1, ())), "(({x} * {x}) - 1) days"),
    ],
)
def test_measures_may_say_how_long_by_a_calculation(text, amount, printed):
    found = timing(f"B within {text}").window.end
    assert (found.amount, found.seconds, found.measures) == (Calculation(amount), None, ("x",))
    again = print_ruleset(rules(f"R1 when A then B within {text} unless {{m}}"))
    assert f"within {printed}" in again
    assert str(parse(again).rules[0].default.obligations[0].timing) == f"within {found}"


def test_what_comes_to_a_measure_or_a_number_is_one():
    assert timing("B within ({x} + K - 5) seconds").window.end == Length(MeasureRef("x"), "seconds")
    assert timing("B within ({x} - {x} + K) seconds").window.end == Length(Number(5), "seconds")


def test_otherwise_and_else_belong_to_the_nearest_response():
    found = timing("B within 5 minutes otherwise C else A")
    (otherwise,) = found.otherwise.obligations
    assert found.instead is None
    assert otherwise.timing.instead.obligations[0].name == "A"
    found = timing("B within 5 minutes otherwise {C} else not A eventually")
    assert found.otherwise.obligations[0].timing is None
    assert found.instead.obligations[0].negated
    assert found.instead.obligations[0].timing.window.end is None


def test_an_unless_without_braces_belongs_to_the_rule():
    (rule,) = rules("R1 when A then B within 1 hours otherwise C unless m").rules
    assert len(rule.hedges) == 1
    (rule,) = rules("R1 when A then B within 1 hours otherwise {C unless m}").rules
    assert not rule.hedges
    assert len(timing("B within 1 hours otherwise {C unless m}").otherwise.hedges) == 1
    assert {"A", "B", "C"} == rules("R1 when A then B within 1 hours otherwise {C unless m}").obligations | {"A"}


@pytest.mark.parametrize("depth", [33, 34, 20_000])
def test_alternatives_without_braces_are_not_nested_too_deeply(depth):
    text = f"def_start event A def_end rule_start R1 when A then {'A otherwise ' * depth}A rule_end"
    if depth == 33:
        assert print_ruleset(parse(text)).count("otherwise") == depth
    else:
        with pytest.raises(LanguageError, match="nested too deeply"):
            parse(text)
