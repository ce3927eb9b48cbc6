"""What a history can leave pending, for responses with several windows."""

from __future__ import annotations

from itertools import combinations

import pytest

from sleec_runtime.language import parse
from sleec_verify.checks import run_checks
from sleec_verify.query.ruleset_index import RulesetIndex
from sleec_verify.results.finding import Unknown
from sleec_verify.traces.index import trace_index_of
from sleec_verify.traces.pending_demands import pending_of
from tests.support.explicit.conflicts import Explicit


def _dsl(*rules: str) -> str:
    labelled = "\n".join(f"R{number} when {rule}" for number, rule in enumerate(rules, 1))
    return f"def_start\nevent B\nevent C\nevent D\nmeasure a: boolean\ndef_end\nrule_start\n{labelled}\nrule_end\n"


def test_windows_that_open_at_the_trigger_and_at_the_end_stay_apart() -> None:
    text = _dsl("D then not C", "B then not C otherwise {C within 2 seconds unless {a} then C within [2,2] seconds}")
    pending = [one.demand for one in pending_of(trace_index_of(RulesetIndex(parse(text)))) if one.rule.label == "R2"]
    assert len(pending) == 2
    (result,) = run_checks(parse(text), ["conflict"])
    assert [set(finding.rules) for finding in result.findings] == [{"R1", "R2"}]


WINDOWS = [(start, end) for start in range(3) for end in range(start, 3)]


@pytest.mark.parametrize(("first", "second"), list(combinations(WINDOWS, 2)))
@pytest.mark.parametrize("other", ["D then not C", "D then C"])
@pytest.mark.parametrize("default", ["not C otherwise {", "C otherwise {"])
def test_conflicts_with_two_windows_are_those_of_the_automaton(
    first: tuple[int, int], second: tuple[int, int], other: str, default: str
) -> None:
    negated = "not " if other == "D then C" else ""
    one, two = (f"{negated}C within [{start},{end}] seconds" for start, end in (first, second))
    ruleset = parse(_dsl(other, f"B then {default}{one} unless {{a}} then {two}}}"))
    (result,) = run_checks(ruleset, ["conflict"])
    assert not isinstance(result.verdict, Unknown), result.verdict.why
    found = {frozenset(finding.rules) for finding in result.findings}
    every = Explicit(ruleset).conflicts()
    least = {rules for rules in every if not any(fewer < rules for fewer in every)}
    assert least <= found <= every
