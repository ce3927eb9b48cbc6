"""With tolerance 0, the auditor finds what the evaluator of traces finds."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from random import Random

import pytest

from sleec_runtime.audit.auditor import Auditor
from sleec_runtime.evaluation.instant_formulas import instant_formula
from sleec_runtime.evaluation.trace import Trace
from sleec_runtime.evaluation.trace_violations import violations
from sleec_runtime.model import EventRelation, Lasting, Rule, Ruleset, Value, names_of
from tests.support.missions import audit, complete, declared, observations
from tests.support.random_traces import Case, random_cases

BROKEN = ("missed", "prohibited", "constraint", "assumption", "open")


def changes(trace: Trace) -> dict[int, frozenset[str]]:
    """At each time, the events, and the conditions that have a new value."""
    found: dict[int, frozenset[str]] = {}
    before: Mapping[str, Value] = {}
    for instant in trace.instants:
        found[instant.time] = instant.events | {n for n, v in instant.conditions.items() if before.get(n) != v}
        before = instant.conditions
    return found


def expected(ruleset: Ruleset, trace: Trace, case: Case) -> set[tuple[object, int]]:
    """What the evaluator of traces finds, and the auditor is to report: a statement about one instant, when it changes;
    a relation about a time span, once."""
    changed = changes(trace)
    found: set[tuple[object, int]] = set()
    for statement, time in violations(ruleset, trace, case.untimed):
        if isinstance(statement, Rule) or (
            isinstance(statement, EventRelation) and statement.relation == "happenBefore"
        ):
            found.add((statement, time))
        elif isinstance(statement, Lasting):
            found.add((statement, 0))
        elif changed[time] & set(names_of(instant_formula(statement))):
            found.add((statement, time))
    return found


def found(ruleset: Ruleset, trace: Trace, case: Case) -> tuple[set[tuple[object, int]], set[object]]:
    """What the auditor finds, and the statements that it leaves undetermined."""
    auditor = Auditor(ruleset, tolerance=0, untimed=case.untimed)
    broken: set[tuple[object, int]] = set()
    undetermined: set[object] = set()
    for deviation in audit(auditor, observations(trace, Random(0))):
        if deviation.triggered is not None:
            assert deviation.rule is not None
            statement: object = ruleset.by_label[deviation.rule]
            time = deviation.triggered.time
        elif deviation.statement is not None:
            statement = deviation.statement
            time = 0 if isinstance(statement, Lasting) else deviation.time
        else:
            assert deviation.kind == "unrequired"
            continue
        if deviation.kind == "undetermined" or (deviation.kind == "open" and deviation.missing):
            undetermined.add(statement)
        else:
            assert deviation.kind in BROKEN
            broken.add((statement, int(time)))
    return broken, undetermined


@pytest.mark.parametrize("seed", range(4))
def test_both_find_the_same(seed: int) -> None:
    answers: Counter[object] = Counter()
    for case in random_cases(seed, 250):
        ruleset = declared(case.ruleset)
        for number, drawn in enumerate(case.traces):
            trace = complete(drawn, Random(number))
            broken, undetermined = found(ruleset, trace, case)
            # Only an alternative to a window of negative length.
            assert all("otherwise=Clause" in str(rule) for rule in undetermined)
            wanted = expected(ruleset, trace, case)
            assert {one for one in broken ^ wanted if one[0] not in undetermined} == set(), (case, trace)
            answers[bool(broken)] += 1
            answers["undetermined"] += bool(undetermined)
    assert min(answers[True], answers[False]) > 50 > answers["undetermined"]


@pytest.mark.parametrize("seed", range(4))
def test_with_unreported_values_every_completion_agrees(seed: int) -> None:
    """What is reported holds for all possible values; what is not reported and not undetermined, for none."""
    answers: Counter[tuple[bool, bool]] = Counter()
    for case in random_cases(seed, 150):
        ruleset = declared(case.ruleset)
        for trace in case.traces:
            broken, undetermined = found(ruleset, trace, case)
            answers[bool(broken), bool(undetermined)] += 1
            rules = {one for one in broken if isinstance(one[0], Rule)}
            for number in range(4):
                possible = set(violations(ruleset, complete(trace, Random(number)), case.untimed))
                assert rules <= possible
                assert {one for one in possible if isinstance(one[0], Rule) and one[0] not in undetermined} <= rules
    assert min(answers.values()) > 5
