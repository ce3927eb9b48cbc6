"""Rules of different triggers at once: each two of them, and every situation that is known to conflict."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations

from sleec_runtime.model import Context
from sleec_verify.checks import run_checks
from sleec_verify.conformance.exhaustive import first_contexts, tried
from sleec_verify.conformance.feasible_contexts import Assumptions
from sleec_verify.conformance.oracle import Oracle
from sleec_verify.conformance.subject import Bench

CLAUSES = 3
"""Situations a rule: the default, and what else comes first."""

MOST = 400


def check_simultaneous_triggers(bench: Bench) -> int:
    """Raises Nonconformance for the first situation in which two triggers together are not answered rightly. Returns
    how many were tried."""
    oracle = bench.oracle()
    count = 0
    with bench.running() as running:
        for context in _situations(oracle):
            failure = tried(running, context)
            if failure is not None:
                with bench.running() as fresh:
                    raise tried(fresh, context) or failure.after(["other situations, on the same instance"])
            count += 1
    return count


def _situations(oracle: Oracle) -> Iterator[Context]:
    (result,) = run_checks(oracle.ruleset, ["conflict"], oracle.domain)
    yield from (finding.witness.context() for finding in result.findings if finding.witness is not None)
    assumptions = Assumptions(oracle.ruleset)
    of_each = [[context for context, _ in found] for found in first_contexts(oracle, assumptions, CLAUSES)]
    mixed = (
        Context(one.triggers | other.triggers, {**other.conditions, **one.conditions})
        for first, second in combinations(of_each, 2)
        for one in first
        for other in second
        if all(other.conditions.get(name, value) == value for name, value in one.conditions.items())
    )
    for _, context in zip(range(MOST), mixed):
        nearest = assumptions.nearest(context, context.triggers)
        if nearest is not None:
            yield nearest
