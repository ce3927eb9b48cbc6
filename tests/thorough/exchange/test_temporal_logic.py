"""The formulas of metric temporal logic agree with the evaluator of traces, on random rulesets and traces."""

from __future__ import annotations

from random import Random

import pytest

from sleec_runtime.evaluation.trace import Untimed
from sleec_runtime.evaluation.trace_violations import claim_holds, violations
from sleec_runtime.language import parse
from sleec_verify.exchange.compilation import compile_to
from sleec_verify.exchange.compilation.temporal_logic import claims_of, requirements
from tests.support.ruleset_traces import trace_of
from tests.support.temporal_semantics import Semantics
from tests.support.temporal_text import TemporalReader
from tests.support.timed_english import timed_english
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


def reader(ruleset, trace):
    """Reads formulas over the instants of a trace."""
    scales = [measure for measure in ruleset.measures.values() if measure.kind == "scale"]
    ranks = {value: rank for measure in scales for rank, value in enumerate(measure.values)}
    points = []
    for instant in trace.instants:
        values = {name: ranks.get(value, value) for name, value in instant.conditions.items()}
        events = {name: name in instant.events for name in ruleset.triggers | ruleset.obligations}
        points.append({**ranks, **values, **events})
    times = [instant.time for instant in trace.instants]
    return lambda text: TemporalReader(text, points, times).read()


@pytest.mark.parametrize("start", range(0, 400, 100))
def test_a_trace_satisfies_the_rules_if_it_satisfies_the_text(start):
    satisfied = violated = occurring = 0
    for seed in range(start, start + 100):
        random = Random(seed)
        ruleset = parse(timed_english(seed)) if seed % 4 == 3 else timed_ruleset(seed, named=seed % 2 == 0)
        if seed % 4 == 1:
            ruleset = timed_ruleset(seed, lengths=True, calculations=True)
        untimed: Untimed = "eventually" if seed % 3 == 0 else "at"
        rows = compile_to(ruleset, "mtl", untimed=untimed).splitlines()
        claims = {claim.label: claim for claim, _ in claims_of(ruleset, untimed)}
        for _ in range(6):
            trace = trace_of(random, ruleset)
            read = reader(ruleset, trace)
            kept = True
            for title, text in zip(rows[::2], rows[1::2], strict=True):
                holds = read(text)(0)
                if title.endswith(": it occurs in a trace if"):
                    claim = claims[title.split()[2].rstrip(":")]
                    assert holds == claim_holds(claim, ruleset, trace, untimed), (text, ruleset.source.text)
                    occurring += holds
                else:
                    kept = kept and holds
            assert kept == (not violations(ruleset, trace, untimed)), (rows, ruleset.source.text)
            satisfied += kept
            violated += not kept
    assert satisfied > 50
    assert violated > 50
    assert occurring > 10
