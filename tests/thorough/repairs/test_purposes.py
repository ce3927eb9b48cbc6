"""Repairs of purposes in random rulesets: a trace that follows the changed rules has the purpose. A purpose is
removed only if it is impossible without any rule."""

from __future__ import annotations

from dataclasses import replace
from random import Random

import pytest

from sleec_runtime.evaluation.trace import Instant, Trace
from sleec_runtime.evaluation.trace_violations import claim_holds, violations
from sleec_runtime.language import parse
from sleec_runtime.model import Rule, claims
from sleec_verify.traces.index import TraceIndex
from sleec_verify.traces.questions import find_claim
from tests.support.realistic_rules import peoples_rules
from tests.support.repairs import found_repairs


def with_purpose(seed: int) -> str:
    random = Random(seed)
    planted = ["P1 when E0 then X0", "P2 when X0 and m1 then not X1 within 2 seconds", "P3 when E0 and m0 then not X2"]
    chosen = "\n".join(random.sample(planted, 3))
    wanted = random.choice(("while not X0", "and m1 while X1", "and (m0 and (s = hi)) while X2", "and m0 while X2"))
    purpose = f"purpose_start\np1 exists E0 {wanted}\npurpose_end\n"
    return peoples_rules(seed, 2).replace("rule_end", f"{chosen}\nrule_end") + purpose


@pytest.mark.parametrize("start", range(0, 45, 15))
def test_a_trace_that_follows_the_rules_has_the_purpose(start: int) -> None:
    number = 0
    for seed in range(start, start + 15):
        old = parse(with_purpose(seed))
        for _, repair in found_repairs(old, "SLEEC105"):
            number += 1
            new = repair.repaired
            if repair.candidate.operator == "claim-removal":
                relations = tuple(one for one in old.statements if not isinstance(one, Rule))
                (impossible,) = claims(old, "purpose")
                assert find_claim(TraceIndex(replace(old, statements=relations)), impossible).trace is None
                continue
            (purpose,) = claims(new, "purpose")
            found = find_claim(TraceIndex(new), purpose).trace
            assert found is not None
            trace = Trace(tuple(Instant(*one) for one in found))
            assert claim_holds(purpose, new, trace)
            assert not violations(new, trace)
    assert number
