"""Claims, relations, comments and defects in the DSL."""

from __future__ import annotations

import pytest

from sleec_runtime.errors import LanguageError
from sleec_runtime.evaluation.hedge_chain import decide
from sleec_runtime.language import parse, print_ruleset
from sleec_runtime.model import (
    Claim,
    Comparison,
    Context,
    Effect,
    EventRelation,
    Lasting,
    MeasureRef,
    MeasureRelation,
    ScaleValue,
    claims,
    constructs,
)
from tests.support.dsl_rules import DEFINITIONS, rules
from tests.support.growth import grows_in_proportion

BESIDE = f"""// about this file

{DEFINITIONS}
rule_start
  // the only rule
  R1 when A then B  // now
     // unless it is known
     unless {{m}} then not C within 2 minutes else B
rule_end
concern_start
  c1 when A and ({{x}} > K) then not B within [1 minutes, 2 minutes] while C
  c2 exists A while B eventually unless {{m}} then C while C meanwhile (when B then A)
concern_end
/* purposes
 * follow
 */
purpose_start
  p1 exists A
  p2 when A and {{m}} meanwhile (exists B and {{n}} meanwhile (exists C))
purpose_end
relation_start
  witness A B
  equal A B
  mutualExclusive A B
  happenBefore A B
  measure imply {{m}} ({{x}} > 3)
  measure iff {{m}} {{n}}
  measure mutualExclusive {{m}} {{n}}
  measure opposite {{m}} {{n}}
  measure invariant (not {{m}})
  causation A {{m}}
  includes A (not {{m}})
  forbid A {{m}}
  when A and {{m}} then {{n}} until B and ({{risk}} > low)
  when A then {{n}} for 5 minutes
relation_end
// the end
"""


def test_concerns_purposes_and_relations():
    ruleset = parse(BESIDE)
    one, two = claims(ruleset, "concern")
    assert (one.form, one.event, len(one.responses)) == ("when", "A", 2)
    assert (two.form, len(two.responses), len(two.responses[0].hedges)) == ("exists", 2, 1)
    assert two.meanwhile is not None
    assert two.meanwhile.form == "when"
    assert [p.label for p in claims(ruleset, "purpose")] == ["p1", "p2"]
    kinds = [type(s) for s in ruleset.statements[10:]]
    assert kinds == [Claim] * 4 + [EventRelation] * 4 + [MeasureRelation] * 5 + [Effect] * 3 + [Lasting] * 2
    assert len(list(constructs(ruleset))) == 2 + 14


def test_what_is_printed_says_the_same_and_keeps_the_comments():
    ruleset = parse(BESIDE)
    text = print_ruleset(ruleset)
    again = parse(text)
    assert again == ruleset
    assert print_ruleset(again) == text
    for comment in ("about this file", "the only rule", "now", "unless it is known", "purposes", "follow", "the end"):
        assert f"// {comment}" in text


def test_every_node_has_its_span():
    ruleset = parse(BESIDE)
    source = ruleset.source.text
    (rule,) = ruleset.rules
    assert source[slice(*rule.span)].startswith("R1 when A")
    assert source[slice(*rule.span)].endswith("else B")
    assert source[slice(*rule.hedges[0].span)].startswith("unless {m}")
    assert source[slice(*rule.hedges[0].obligations[0].span)] == "not C within 2 minutes else B"
    for statement in ruleset.statements:
        assert source[slice(*statement.span)].strip()


def test_labels_and_values_that_others_read_are_defects():
    ruleset = rules("R1 when A and risk = low then B\nR1 when A then C")
    assert [rule.label for rule in ruleset.rules] == ["R1", "R1#2"]
    assert [defect.kind for defect in ruleset.defects] == ["repeated-label"]
    assert parse(print_ruleset(ruleset)) == ruleset
    ruleset = parse(
        "def_start\nevent A\nmeasure one: scale(a, b)\nmeasure two: scale(c, d)\ndef_end\n"
        "rule_start\nR1 when A and ({one} = d) then A\nrule_end\n"
    )
    assert [defect.kind for defect in ruleset.defects] == ["foreign-value"]
    assert ruleset.rules[0].guard == Comparison(MeasureRef("one"), "=", ScaleValue("d", 1))
    assert parse(print_ruleset(ruleset)) == ruleset


@pytest.mark.parametrize(
    ("written", "rank", "said"),
    [
        ("1", 1, "`one` is a scale, but 1 is a number; it is read as `b`, which has place 1, counted from 0"),
        ("K", 20, "`one` is a scale, but `K` (= 20) is a number; every value of `one` is below it, so"),
        ("-1", -1, "`one` is a scale, but -1 is a number; every value of `one` is above it, so"),
        ("e", 2, "`e` is a value of `two`, not of `one`; every value of `one` is below it, so"),
    ],
)
def test_what_is_no_value_of_a_scale_is_read_by_its_place(written, rank, said):
    text = (
        "def_start\nevent A\nmeasure one: scale(a, b)\nmeasure two: scale(c, d, e)\nconstant K = 20\ndef_end\n"
        f"rule_start\nR1 when A and ({{one}} > {written}) then A\n"
        f"R2 when A and ({written} <= {{one}}) then A\nrule_end\n"
    )
    ruleset = parse(text)
    assert ruleset.rules[0].guard == Comparison(MeasureRef("one"), ">", ScaleValue(written, rank))
    assert ruleset.rules[1].guard == Comparison(ScaleValue(written, rank), "<=", MeasureRef("one"))
    assert {defect.kind for defect in ruleset.defects} == {"foreign-value" if written == "e" else "number-as-value"}
    assert [defect.message.startswith(said) for defect in ruleset.defects] == [True, True]
    assert parse(print_ruleset(ruleset)) == ruleset
    for rule in ruleset.rules:
        decided = [
            decide(rule, Context(frozenset({"A"}), {"one": value}), "priority", ruleset.measures) for value in "ab"
        ]
        above = [place > rank if rule.label == "R1" else place >= rank for place in range(2)]
        assert [decision is not None for decision in decided] == above


def test_neither_a_constant_in_braces_nor_a_measure_is_a_place_in_a_scale():
    for written in ("{K}", "{n}", "n"):
        with pytest.raises(LanguageError, match="not a value of `one`"):
            parse(
                "def_start\nevent A\nmeasure one: scale(a, b)\nmeasure n: numeric\nconstant K = 1\ndef_end\n"
                f"rule_start\nR1 when A and ({{one}} > {written}) then A\nrule_end\n"
            )


@pytest.mark.speed
def test_ten_thousand_rules_are_read_in_time_linear_in_their_size():
    line = "R{} when A and ({{risk}} > low) then B within 5 minutes unless {{m}} then C\n"
    small, large = ("".join(line.format(n) for n in range(size)) for size in (1_000, 10_000))
    assert len(rules(large).rules) == 10_000
    assert grows_in_proportion(lambda: rules(small), lambda: rules(large), 10)


@pytest.mark.parametrize("gap", ["\n", "\n\n"])
def test_comments_inside_a_block_stay_inside(gap):
    text = (
        "// head\n\n// of the names\ndef_start\n    event A\n    event B\ndef_end\n\n// of the rules\nrule_start\n"
        f"    // all of them{gap}    // the first{gap}    R1 when A then B\nrule_end\n"
    )
    written = print_ruleset(parse(text))
    assert written == text
    assert print_ruleset(parse(written)) == written
