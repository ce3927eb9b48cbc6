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
from tests.support.source_mutants import SourceMutant

EVALUATOR = "sleec_runtime.evaluation.trace_violations"
WINDOWS = "sleec_verify.encoding.response_windows"
OF_THE_EVALUATOR = [
    SourceMutant(EVALUATOR, "_TraceEvaluation._own", "first = due + (", "first = due + 1 + ("),
    SourceMutant(
        EVALUATOR,
        "_TraceEvaluation._own",
        "else due + _seconds(window.end, instant)",
        "else due + _seconds(window.end, instant) + 1",
    ),
    SourceMutant(
        EVALUATOR,
        "_TraceEvaluation._own",
        "else due + _seconds(window.end, instant)",
        "else due + _seconds(window.end, instant) - 1",
    ),
    SourceMutant(EVALUATOR, "_TraceEvaluation._own", 'self.untimed == "at"', 'self.untimed != "at"'),
    SourceMutant(EVALUATOR, "Due.covers", "time <= self.last", "time < self.last"),
    SourceMutant(EVALUATOR, "Due.covers", "self.first <= time", "self.first < time"),
    SourceMutant(EVALUATOR, "_in_place", "if timing.otherwise is not None:", "if False:"),
    SourceMutant(EVALUATOR, "_in_place", "if timing.instead is not None:", "if False:"),
    SourceMutant(EVALUATOR, "_in_place", "due if timing.window is None or own.last is None else own.last", "due"),
    SourceMutant(EVALUATOR, "_TraceEvaluation._active", "return decision.obligations", "return clause.obligations"),
]
OF_WINDOWS = [
    SourceMutant(WINDOWS, "ResponseWindows._obligation", "start += ceil(", "start += 1 + ceil("),
    SourceMutant(WINDOWS, "ResponseWindows._obligation", "start += ceil(", "start += 0 * ceil("),
    SourceMutant(WINDOWS, "ResponseWindows._obligation", "since.time + floor(", "since.time + 1 + floor("),
    SourceMutant(WINDOWS, "ResponseWindows._obligation", "since.time + floor(", "since.time - 1 + floor("),
    SourceMutant(WINDOWS, "ResponseWindows._obligation", "since.time + floor(", "floor("),
    SourceMutant(WINDOWS, "ResponseWindows._obligation", 'self._untimed == "at"', 'self._untimed != "at"'),
    SourceMutant(WINDOWS, "ResponseWindows._obligation", "if timing.otherwise is not None:", "if False:"),
    SourceMutant(WINDOWS, "ResponseWindows._obligation", "if timing.instead is not None:", "if False:"),
    SourceMutant(WINDOWS, "ResponseWindows._obligation", "window is None or end is None", "True"),
    SourceMutant(WINDOWS, "ResponseWindows._deciding", "if not clause.hedges:", "if True:"),
]


def outcome(found: Callable[[], Iterable[Broken | Violation]]) -> object:
    try:
        return [(one.statement, one.time) for one in found()]
    except SleecError as error:
        return type(error), str(error)


def compare(*seeds: int) -> dict[str, int]:
    """How many traces each outcome has. Fails where the two differ."""
    counts = {"kept": 0, "broken": 0, "refused": 0}
    for ruleset, untimed, _, traces in (case for seed in seeds for case in random_cases(seed, 60)):
        laws = Lawfulness(ruleset, untimed)
        for trace in traces:
            same = [TraceInstant(one.time, one.events, one.conditions) for one in trace.instants]
            expected = outcome(partial(violations, ruleset, trace, untimed))
            assert outcome(partial(laws.broken, same)) == expected
            counts["refused" if isinstance(expected, tuple) else "broken" if expected else "kept"] += 1
    return counts


@pytest.mark.parametrize("seed", range(4))
def test_both_break_the_same_statements(seed: int) -> None:
    counts = compare(seed)
    assert counts["kept"] > 10
    assert counts["broken"] > 10


@pytest.mark.parametrize("mutant", [*OF_THE_EVALUATOR, *OF_WINDOWS], ids=str)
def test_a_mutant_of_either_side_is_found(mutant: SourceMutant, monkeypatch: pytest.MonkeyPatch) -> None:
    mutant.apply(monkeypatch)
    with pytest.raises(AssertionError):
        compare(*range(12))


def test_a_length_without_a_value_is_refused() -> None:
    laws = Lawfulness(parse("MEASURE patience: integer\nRULE r WHEN A THEN B WITHIN patience seconds"))
    with pytest.raises(WrongType, match=r"patience is the length of a window, a number of at most .*; got None"):
        laws.due([TraceInstant(0, frozenset({"A"}), {})])
