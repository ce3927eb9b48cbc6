"""What is printed parses to the same ruleset, and prints the same again."""

from __future__ import annotations

import pytest
from hypothesis import given, settings

from sleec_runtime.language import parse, print_ruleset
from sleec_runtime.model import Ruleset
from tests.support.strategies import rulesets


@pytest.mark.slow
@given(rulesets(exotic=True, max_depth=3, always=True))
def test_parsing_undoes_printing(ruleset: Ruleset) -> None:
    assert parse(print_ruleset(ruleset)) == ruleset


@pytest.mark.slow
@settings(max_examples=200)
@given(rulesets(comments=True, max_rules=3, max_hedges=2, always=True))
def test_printing_again_changes_nothing_and_loses_no_comment(ruleset: Ruleset) -> None:
    text = print_ruleset(ruleset)
    again = parse(text)
    assert again == ruleset
    assert print_ruleset(again) == text
