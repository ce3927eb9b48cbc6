"""What is printed in the DSL parses to the same ruleset, prints the same again, and keeps its comments."""

from __future__ import annotations

from dataclasses import replace

from hypothesis import given, settings

from sleec_runtime.language import parse, print_ruleset
from sleec_runtime.model import Ruleset
from tests.language.dsl_strategies import dsl_rulesets


@settings(max_examples=150)
@given(dsl_rulesets())
def test_parsing_undoes_printing(ruleset: Ruleset) -> None:
    text = print_ruleset(ruleset)
    # A text without braces or words of LEGOS is not told from one of SLEEC-TK; they differ in nothing then.
    again = replace(parse(text), dialect="legos")
    assert again == ruleset
    assert print_ruleset(again) == text


@settings(max_examples=80)
@given(dsl_rulesets())
def test_the_dialect_changes_nothing_that_is_said(ruleset: Ruleset) -> None:
    bare = replace(ruleset, dialect="sleec-tk")
    again = parse(print_ruleset(bare))
    assert print_ruleset(replace(again, dialect="sleec-tk")) == print_ruleset(bare)
