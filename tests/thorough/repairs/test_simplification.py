"""`--fix` alone, on random rules: the meaning stays by brute force, and comments stay."""

from __future__ import annotations

import pytest
from hypothesis import given, settings

from sleec_runtime.language import parse, print_ruleset
from sleec_verify.checks import run_checks
from sleec_verify.repairs.simplification import simplifications
from tests.support import brute_force
from tests.support.small_rulesets import small_rulesets


@pytest.mark.slow
@settings(max_examples=60, deadline=None)
@given(small_rulesets(rules=4, hedges=2, nested=False))
def test_simplifications_keep_the_meaning(ruleset):
    lines = print_ruleset(ruleset).splitlines()
    above = {number: f"// above {number}\n" for number, line in enumerate(lines) if line.startswith("RULE")}
    text = "".join(f"{above.get(number, '')}{line}\n" for number, line in enumerate(lines))
    old = parse(text)
    results = run_checks(old)
    new = old
    for repair in simplifications(old, results):
        assert repair.effect.keeps_meaning
        new = repair.repaired
    for context in brute_force.contexts(old):
        assert brute_force.conflicts(old, context) == brute_force.conflicts(new, context)
        if not brute_force.conflicts(old, context):
            assert brute_force.due(old, context) == brute_force.due(new, context)
    assert [line for line in new.source.text.splitlines() if line.startswith("// ")] == [
        line for line in text.splitlines() if line.startswith("// ")
    ]
