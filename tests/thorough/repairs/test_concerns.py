"""Repairs of concerns in random rulesets: no trace that follows the changed rules has the concern."""

from __future__ import annotations

from random import Random

import pytest

from sleec_runtime.evaluation.trace_violations import claim_holds, violations
from sleec_runtime.language import parse
from sleec_runtime.model import claims
from tests.support.realistic_rules import ACTS, EVENTS, peoples_rules
from tests.support.repairs import found_repairs
from tests.support.ruleset_traces import trace_of


def with_concern(seed: int) -> str:
    random = Random(seed)
    condition = random.choice(("", " and m0", " and (not m1)", " and (s = hi)", " and (n < 20)"))
    response = random.choice(("not ", "")) + random.choice(ACTS) + random.choice(("", " within 2 seconds"))
    concern = f"concern_start\nc1 when {random.choice(EVENTS)}{condition} then {response}\nconcern_end\n"
    return peoples_rules(seed, 3) + concern


@pytest.mark.parametrize("start", range(0, 60, 15))
def test_no_trace_that_follows_the_rules_has_the_concern(start: int) -> None:
    number = 0
    for seed in range(start, start + 15):
        ruleset = parse(with_concern(seed))
        for _, repair in found_repairs(ruleset, "SLEEC104"):
            number += 1
            new = repair.repaired
            (concern,) = claims(new, "concern")
            random = Random(seed)
            for _ in range(150):
                trace = trace_of(random, new)
                if claim_holds(concern, new, trace):
                    assert violations(new, trace), repair.candidate.title
    assert number
