"""Repairs of random rules without time: each is a repair, and changes what it announces, by brute force."""

from __future__ import annotations

from hypothesis import given, settings
from hypothesis import strategies as st

from sleec_runtime.language import parse, print_ruleset
from sleec_runtime.model import Assume, Ruleset
from tests.support import brute_force
from tests.support.repairs import found_repairs
from tests.support.small_rulesets import small_rulesets

CODES = ("SLEEC101", "SLEEC102", "SLEEC202", "SLEEC301", "SLEEC302", "SLEEC401", "SLEEC503")


def differing(old: Ruleset, new: Ruleset) -> int:
    """The situations without a conflict in which the rules oblige something else, as the first rules name them, and
    those that an assumption excludes."""
    assumed = [one for one in new.constraints if isinstance(one, Assume) and one not in old.constraints]
    return sum(
        not all(brute_force.value(one.formula, context, measures=new.measures) for one in assumed)
        or (brute_force.due(old, context) != brute_force.due(new, context) and not brute_force.conflicts(old, context))
        for context in brute_force.contexts(old)
    )


@settings(max_examples=40, deadline=None)
@given(small_rulesets(rules=3, hedges=2, nested=False), st.sampled_from(CODES))
def test_a_repair_of_random_rules_is_one(ruleset: Ruleset, code: str) -> None:
    """`found_repairs` asserts that the finding is gone, that no other appears, and that the rest stays."""
    stated = parse(print_ruleset(ruleset))
    for _, repair in found_repairs(stated, code):
        situations = repair.effect.situations
        if situations is not None:
            assert (situations > 0) == (differing(stated, repair.repaired) > 0), repair.candidate.title
