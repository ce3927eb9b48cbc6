"""What is printed in the DSL parses to the same ruleset, prints the same again, and keeps its comments."""

from __future__ import annotations

from dataclasses import replace
from random import Random

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sleec_runtime.language import parse, print_ruleset
from sleec_runtime.model import Ruleset
from tests.support.dsl_strategies import dsl_rulesets


@pytest.mark.slow
@settings(max_examples=150)
@given(dsl_rulesets())
def test_parsing_undoes_printing(ruleset: Ruleset) -> None:
    text = print_ruleset(ruleset)
    # A text without braces or words of LEGOS is not told from one of SLEEC-TK; they differ in nothing then.
    again = replace(parse(text), dialect="legos")
    assert again == ruleset
    assert print_ruleset(again) == text


@pytest.mark.slow
@settings(max_examples=80)
@given(dsl_rulesets())
def test_the_dialect_changes_nothing_that_is_said(ruleset: Ruleset) -> None:
    bare = replace(ruleset, dialect="sleec-tk")
    again = parse(print_ruleset(bare))
    assert print_ruleset(replace(again, dialect="sleec-tk")) == print_ruleset(bare)


@pytest.mark.slow
@settings(max_examples=80)
@given(dsl_rulesets(), st.randoms(use_true_random=False))
def test_empty_lines_between_statements_stay(ruleset: Ruleset, random: Random) -> None:
    lines = print_ruleset(ruleset).splitlines()
    spaced = []
    for before, line in zip(["", *lines], lines):
        inside = line.startswith("    ") and not line.lstrip().startswith(("unless", "//"))
        above = before.startswith("    ") and not before.lstrip().startswith("//")
        if inside and above and random.random() < 0.5:
            spaced.append("")
        spaced.append(line)
    text = "".join(f"{line}\n" for line in spaced)
    again = parse(text)
    assert replace(again, dialect="legos") == ruleset
    assert print_ruleset(replace(again, dialect="legos")) == text


def test_several_empty_lines_are_one_and_those_at_the_edges_of_a_block_go() -> None:
    text = (
        "\n\ndef_start\n\n  event A\n\n\n  event B // here\r\n \t\r\n  // there\n\n\n  event C\n\n\ndef_end\n\n\n"
        "rule_start\n\n  R1 when A then B\n\n    unless true\n\n\n  R2 when B then C R3 when C then A\n\nrule_end\n\n"
    )
    laid_out = (
        "def_start\n    event A\n\n    event B  // here\n\n    // there\n\n    event C\ndef_end\n\n"
        "rule_start\n    R1 when A then B\n        unless true\n\n"
        "    R2 when B then C\n    R3 when C then A\nrule_end\n"
    )
    assert print_ruleset(parse(text)) == laid_out
    assert print_ruleset(parse(laid_out)) == laid_out
