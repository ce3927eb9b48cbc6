"""What a search of repairs costs: steps of the budget, which are the same on every machine, and memory."""

from __future__ import annotations

import gc
from collections.abc import Callable, Iterator
from contextlib import contextmanager

import pytest

from sleec_runtime.language import load, parse
from sleec_verify.checks import run_checks
from sleec_verify.encoding.budget import Budget, limited, steps_for
from sleec_verify.encoding.solver import MiniSat
from sleec_verify.repairs.numbering import numbered_repairs
from sleec_verify.repairs.search import RepairSearch
from sleec_verify.report.outcome import CheckedRuleset
from tests.support.studies import OWN

MOST_CHECKS = 30
"""The checks that all repairs of a study may cost, in steps, if each change has a budget of its own."""


@pytest.mark.slow
def test_the_repairs_of_a_study_cost_few_checks() -> None:
    ruleset = load(OWN / "museum-guide.sleec")
    with counted_steps() as of_check:
        results = run_checks(ruleset)
    search = RepairSearch(ruleset, results)
    with counted_steps() as of_repairs:
        number = sum(len(search.repairs(finding)) for result in results for finding in result.findings)
    assert number >= 25
    assert of_repairs() <= MOST_CHECKS * of_check()


@pytest.mark.slow
@pytest.mark.parametrize("name", ["museum-guide", "packing-cobot-revised"])
def test_the_search_of_a_report_has_the_budget_of_a_file(name: str) -> None:
    """The findings that the budget does not reach say so, and every search ends within it."""
    ruleset = load(OWN / f"{name}.sleec")
    results = run_checks(ruleset)
    findings = CheckedRuleset(ruleset, results).deduplicated
    with counted_steps() as spent:
        found = list(numbered_repairs(findings, RepairSearch(ruleset, results)))
    assert len(found) == len(findings)
    assert spent() <= 1.1 * steps_for(len(ruleset.source.text))
    for one in found:
        assert one.repairs or one.undecided or one.reason


def test_a_timeout_limits_the_search() -> None:
    ruleset = load(OWN / "museum-guide.sleec")
    results = run_checks(ruleset, ["conflict"])
    findings = CheckedRuleset(ruleset, results).deduplicated
    with limited(0.05):
        found = list(numbered_repairs(findings, RepairSearch(ruleset, results)))
    assert len(found) == len(findings)
    assert "the timeout of 0.05 seconds has passed" in (found[-1].undecided or "")


@contextmanager
def counted_steps() -> Iterator[Callable[[], float]]:
    """Counts the steps of all budgets in the block."""
    total = 0.0
    counted = Budget.spend

    def spend(self: Budget, steps: float) -> None:
        nonlocal total
        total += steps
        counted(self, steps)

    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(Budget, "spend", spend)
        yield lambda: total


def test_a_search_leaves_no_solver_behind() -> None:
    """Questions about traces refer to themselves, so their solvers would stay until a garbage collection."""
    ruleset = parse(
        "RULE a\nWHEN it rings THEN open the door WITHIN 2 minutes\n"
        "RULE b\nWHEN it rings AND it is late THEN NOT open the door WITHIN 5 minutes\n"
    )
    results = run_checks(ruleset)
    (finding,) = (f for result in results for f in result.findings if f.code == "SLEEC101")
    gc.collect()
    gc.disable()
    try:
        before = _open_solvers()
        assert RepairSearch(ruleset, results).repairs(finding)
        assert _open_solvers() == before
    finally:
        gc.enable()


def _open_solvers() -> int:
    return sum(isinstance(one, MiniSat) and one._solver is not None for one in gc.get_objects())
