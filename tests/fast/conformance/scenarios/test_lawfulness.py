"""What a trace breaks, by clauses and windows, is what the evaluator of the runtime says."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import partial

import pytest

from sleec_runtime.errors import SleecError, WrongType
from sleec_runtime.evaluation.trace_violations import Violation, violations
from sleec_runtime.language import parse
from sleec_verify.conformance.scenarios.lawfulness import Broken, Lawfulness
from sleec_verify.traces.trace import TraceInstant
from tests.support.random_traces import random_cases


def outcome(found: Callable[[], Iterable[Broken | Violation]]) -> object:
    try:
        return [(one.statement, one.time) for one in found()]
    except SleecError as error:
        return type(error), str(error)


@pytest.mark.parametrize("seed", range(4))
def test_both_break_the_same_statements(seed: int) -> None:
    counts = {"kept": 0, "broken": 0, "refused": 0}
    for ruleset, untimed, _, traces in random_cases(seed, 60):
        laws = Lawfulness(ruleset, untimed)
        for trace in traces:
            same = [TraceInstant(one.time, one.events, one.conditions) for one in trace.instants]
            expected = outcome(partial(violations, ruleset, trace, untimed))
            assert outcome(partial(laws.broken, same)) == expected
            counts["refused" if isinstance(expected, tuple) else "broken" if expected else "kept"] += 1
    assert counts["kept"] > 10
    assert counts["broken"] > 10


def test_a_length_without_a_value_is_refused() -> None:
    laws = Lawfulness(parse("MEASURE patience: integer\nRULE r WHEN A THEN B WITHIN patience seconds"))
    with pytest.raises(WrongType, match=r"patience is the length of a window, a number of at most .*; got None"):
        laws.due([TraceInstant(0, frozenset({"A"}), {})])
