"""The clauses that cases reach, by the evaluator of the runtime: what a robot that follows the rules does."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from sleec_runtime.evaluation.hedge_chain import decide
from sleec_runtime.model import Context, Ruleset
from sleec_verify.conformance.cases.case import Case
from sleec_verify.conformance.scenarios.expectations import trace_of
from sleec_verify.conformance.scenarios.scenario import Scenario


def reached_clauses(ruleset: Ruleset, cases: Iterable[Case | Scenario]) -> set[tuple[str, int]]:
    """The label and number of each clause that decides in some case."""
    reached = set()
    for case in cases:
        part = ruleset if case.domain is None else ruleset.in_domain(case.domain)
        for context in _contexts(case):
            for rule in part.rules:
                decision = decide(rule, context, ruleset.reading, ruleset.measures)
                if decision is not None:
                    reached.add((rule.label, decision.clause))
    return reached


def _contexts(case: Case | Scenario) -> Iterator[Context]:
    """The situation of a case, or that of each instant of a scenario."""
    if isinstance(case, Case):
        yield case.context()
        return
    for instant in trace_of(case):
        yield Context(instant.events, instant.conditions)
