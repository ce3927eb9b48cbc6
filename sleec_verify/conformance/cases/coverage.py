"""The clauses that cases reach, by the evaluator of the runtime: what a robot that follows the rules does."""

from __future__ import annotations

from collections.abc import Iterable

from sleec_runtime.evaluation.hedge_chain import decide
from sleec_runtime.model import Ruleset
from sleec_verify.conformance.cases.case import Case


def reached_clauses(ruleset: Ruleset, cases: Iterable[Case]) -> set[tuple[str, int]]:
    """The label and number of each clause that decides in some case."""
    reached = set()
    for case in cases:
        part = ruleset if case.domain is None else ruleset.in_domain(case.domain)
        for rule in part.rules:
            decision = decide(rule, case.context(), ruleset.reading, ruleset.measures)
            if decision is not None:
                reached.add((rule.label, decision.clause))
    return reached
