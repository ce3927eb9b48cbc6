"""The formulas of metric temporal logic agree with the evaluator of traces, on random rulesets and traces."""

from __future__ import annotations

from random import Random

import pytest

from sleec_runtime.evaluation.trace_violations import claim_holds, violations
from sleec_verify.exchange.compilation.temporal_logic import claims_of, requirements
from tests.support.ruleset_traces import trace_of
from tests.support.temporal_semantics import Semantics
from tests.support.timed_strategies import timed_ruleset


@pytest.mark.parametrize("untimed", ["at", "eventually"])
@pytest.mark.parametrize("start", range(0, 400, 100))
def test_a_trace_violates_a_statement_where_its_formula_is_false(start, untimed):
    satisfied = violated = 0
    for seed in range(start, start + 100):
        random = Random(seed)
        ruleset = timed_ruleset(seed, named=seed % 2 == 0)
        for _ in range(10):
            trace = trace_of(random, ruleset)
            semantics = Semantics(ruleset, trace.instants)
            expected = {(v.time, id(v.statement)) for v in violations(ruleset, trace, untimed)}
            found = {
                (instant.time, id(one.statement))
                for one in requirements(ruleset, untimed)
                for at, instant in enumerate(trace.instants)
                if not semantics.holds(one.formula, at)
            }
            assert found == expected, ruleset.source.text
            satisfied += not found
            violated += bool(found)
            for claim, parts in claims_of(ruleset, untimed):
                occurs = all(any(semantics.holds(p, at) for at in range(len(trace.instants))) for p in parts)
                assert occurs == claim_holds(claim, ruleset, trace, untimed), ruleset.source.text
    assert satisfied > 50
    assert violated > 50
