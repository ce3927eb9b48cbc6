"""Problems in texts of the DSL: one report for each mistake."""

from __future__ import annotations

import pytest

from sleec_runtime.errors import LanguageError
from sleec_runtime.language import parse, print_ruleset
from tests.support.dsl_rules import DEFINITIONS, problems_of, rules

HELD = """when A and {m} then B within {x} minutes otherwise C
else {not B unless {n} then {C unless {m}} unless {n} then C}
unless ({m} and {n}) then {B unless {m} then C within 1 minute otherwise {A unless {n}}} unless {n}"""
PLACES = len(HELD.split())


@pytest.mark.parametrize("place", range(1, PLACES + 1))
def test_a_problem_anywhere_in_a_rule_with_braces_is_one_problem(place):
    assert rules(f"R1 {HELD}").rules
    words = HELD.split()
    broken = " ".join([*words[:place], "?", *words[place:]])
    with pytest.raises(LanguageError) as caught:
        rules(f"R1 {broken}\nR2 {HELD}")
    (problem,) = caught.value.problems
    assert "?" in problem.message


@pytest.mark.parametrize(
    ("clause", "count"),
    [
        ("then B within ({x} + ?) minutes otherwise C else {not B unless {n} then C} unless m", 1),
        ("then not {B unless {n} then C} unless m", 1),
        ("then B within 2 munites unless m then {not B unless n then C} unless ? then A", 2),
        ("and {m then B unless ? then {C unless n} unless ! then A", 3),
        ("then B} unless ?", 2),
        ("then B unless (({m}) then C unless {n} unless {m} then A)", 1),
        ("then B unless (({m}) then C unless ? unless {m} then A unless !", 3),
    ],
)
def test_after_a_problem_the_hedges_of_the_rule_are_read_and_those_in_braces_are_not(clause, count):
    with pytest.raises(LanguageError) as caught:
        rules(f"R1 when A {clause}")
    assert len(caught.value.problems) == count


def test_where_nothing_is_defined_that_is_one_problem():
    text = "rule_start\nR1 when A and {m} and ({x} > K) then B within K minutes unless {r} = low\nR2 when B then A\n"
    nothing = (1, "there is no def_start block, so no name in this text is defined")
    assert problems_of(f"{text}rule_end") == [nothing]
    assert problems_of(f"{text}R3 when A then not\nrule_end") == [
        nothing,
        (4, "expected the name of an event, but found `rule_end`"),
    ]
    assert problems_of(f"event A {text}rule_end") == [
        (1, "expected the start of a block, such as def_start, but found `event`")
    ]
    assert problems_of("rule_start rule_end") == [(1, "there are no rules in this text")]


def test_a_name_without_a_definition_is_reported_where_it_is_used_first():
    text = "R1 when Aa and {mm} then Bb\nR2 when Aa then Bb unless {mm}\nR3 when A and ({y} > k) then B within k days"
    assert problems_of(f"def_start event A event B def_end rule_start\n{text}\nR4 when Bb then A rule_end") == [
        (2, "no event is called `Aa`; it is used in 1 more place"),
        (2, "no boolean measure is called `mm`; it is used in 1 more place"),
        (2, "no event is called `Bb`; it is used in 2 more places"),
        (4, "no constant or numeric measure is called `y`"),
        (4, "no constant or numeric measure is called `k`; it is used in 1 more place"),
    ]


SCALE_OR_NUMBER = "compare `risk` with it, or write a number"


@pytest.mark.parametrize("comparison", ["({level} = low)", "level = low", "low < level"])
def test_a_measure_without_a_definition_that_is_compared_with_a_value_of_a_scale(comparison):
    with pytest.raises(LanguageError) as caught:
        rules(f"R1 when A and {comparison} then B unless ({{level}} > 3)")
    (problem,) = caught.value.problems
    assert problem.message == "no measure is called `level`; it is used in 1 more place"
    assert problem.hint == "define it, between def_start and def_end: measure level: scale(low, ...)"
    with pytest.raises(LanguageError) as caught:
        rules("R1 when A and {m} = low then B unless rism = low unless ({x} = low)")
    assert [(problem.message, problem.hint) for problem in caught.value.problems] == [
        (
            "`m` is a boolean measure (line 5), which cannot be compared with `low`",
            "write m alone, or not m; the values of `risk` are low < middle < high",
        ),
        ("no measure is called `rism`", "did you mean `risk`?"),
        (
            "`x` is a numeric measure (line 7), and `low` is a value of `risk` (line 8); they cannot be compared",
            SCALE_OR_NUMBER,
        ),
    ]


UNNAMED = [(13, "the rule in line 13 has no name")]


@pytest.mark.parametrize(
    "response",
    [
        "B",
        "not B",
        "B eventually",
        "B within 2 minutes",
        "B within K minutes",
        "B within {x} minutes",
        "B within (K + 2) minutes",
        "B within [1, 5] minutes",
        "B within 2 minutes otherwise C",
        "B else C",
        "B unless m",
        "B unless not {n}",
        "B unless risk = high",
        "B unless x > 5",
        "B unless m then C",
        "B unless m then {C unless n}",
    ],
)
def test_a_rule_without_a_name_is_said_to_be_one(response):
    def found(text: str) -> list[tuple[int, str]]:
        return problems_of(f"{DEFINITIONS}rule_start {text} rule_end")

    one = f"R1 when A then {response}"
    assert found(f"{one}\nwhen C then B") == UNNAMED
    assert found(f"{one}\nwhen C then B\nR3 when A then B") == UNNAMED
    assert found(f"{one}\nwhen C then B\nwhen C then B") == [*UNNAMED, (14, "the rule in line 14 has no name")]
    assert found(f"{one}\nwhen C then not") == [
        *UNNAMED,
        (13, "expected the name of an event, but found `rule_end`"),
    ]
    for label in ("\nR2 ", " R2 ", "\nR2\n", "\nminutes ", "\n R2\t"):
        ruleset = rules(f"{one}{label}when C then B")
        assert [rule.label for rule in ruleset.rules] == ["R1", label.strip()]
        assert parse(print_ruleset(ruleset)) == ruleset


def test_an_unfinished_rule_before_one_with_a_name_is_said_to_be_one():
    for unfinished in ("then", "then B within 2", "then B unless", "and", "then B within 2 minutes otherwise"):
        ((line, message),) = problems_of(f"{DEFINITIONS}rule_start R1 when A {unfinished}\nR2 when A then B rule_end")
        assert line == 12
        assert message.endswith("but the rule `R2` starts here") or message.startswith("a unit is missing")


def test_names_of_rules_and_claims_have_no_colon():
    text = f"{DEFINITIONS}rule_start R1: when A then B\nR2 : when A then B unless ?\nR3: exists A rule_end\n"
    claims = (
        "concern_start c1: exists A while B\nexists B\nwhen B then C concern_end purpose_start exists A purpose_end"
    )
    assert problems_of(text + claims) == [
        (12, "unexpected colon after the name of the rule"),
        (13, "unexpected colon after the name of the rule"),
        (13, "expected a condition, but found `?`"),
        (14, "unexpected colon after the name of the rule"),
        (14, "a rule cannot begin with exists"),
        (15, "unexpected colon after the name of the concern"),
        (16, "the concern in line 16 has no name"),
        (17, "the concern in line 17 has no name"),
        (17, "the purpose in line 17 has no name"),
    ]


def test_an_end_of_block_with_a_typo_instead_of_the_first_definition_is_corrected():
    assert problems_of("def_start\n  deff_end\nrule_start\nR1 when A then A\nrule_end")[0] == (
        2,
        "`deff_end` is not a keyword; did you mean `def_end`?",
    )
