"""What is printed with times parses to the same ruleset, prints the same again, and keeps its comments."""

from __future__ import annotations

import re

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sleec_runtime.language import parse, print_ruleset
from sleec_runtime.model import Ruleset
from tests.support.timed_language_strategies import timed_rulesets
from tests.thorough.language.test_mutations import mutations, parses_or_complains


@pytest.mark.slow
@settings(max_examples=100)
@given(timed_rulesets())
def test_parsing_undoes_printing(ruleset: Ruleset) -> None:
    text = print_ruleset(ruleset)
    again = parse(text)
    assert again == ruleset
    assert print_ruleset(again) == text


@pytest.mark.slow
@settings(max_examples=100)
@given(timed_rulesets())
def test_no_comment_is_lost(ruleset: Ruleset) -> None:
    text = print_ruleset(ruleset)
    kept = print_ruleset(parse(re.sub(r"\n +UNLESS", "\nUNLESS", text)))
    assert sorted(re.findall("//.*", kept)) == sorted(re.findall("//.*", text))


@pytest.mark.slow
@given(st.data(), timed_rulesets())
def test_damaged_rulesets(data: st.DataObject, ruleset: Ruleset) -> None:
    parses_or_complains(data.draw(mutations(print_ruleset(ruleset))))
