"""Repairs of random rules without time: each is a repair, and changes what it announces, by brute force."""

from __future__ import annotations

from hypothesis import given, settings
from hypothesis import strategies as st

from sleec_runtime.language import parse, print_ruleset
from sleec_runtime.model import Ruleset
from tests.support.repairs import differing, found_repairs
from tests.support.small_rulesets import small_rulesets

CODES = ("SLEEC101", "SLEEC102", "SLEEC201", "SLEEC202", "SLEEC301", "SLEEC302", "SLEEC401", "SLEEC503", "SLEEC512")


@settings(max_examples=50, deadline=None)
@given(small_rulesets(rules=3, hedges=2, nested=False), st.sampled_from(CODES))
def test_a_repair_of_random_rules_is_one(ruleset: Ruleset, code: str) -> None:
    """`found_repairs` asserts that the finding is gone, that no other appears, and that the rest stays."""
    stated = parse(print_ruleset(ruleset))
    for _, repair in found_repairs(stated, code):
        situations = repair.effect.situations
        if situations is not None:
            assert (situations > 0) == (differing(stated, repair.repaired) > 0), repair.candidate.title
