"""Fault injection: if an implementation raises, the exception comes out, other rules are executed, and no state
remains."""

from __future__ import annotations

from dataclasses import replace

from sleec_runtime.errors import VariantsFailed
from sleec_runtime.model import Context
from sleec_verify.conformance.exhaustive import first_contexts, tried
from sleec_verify.conformance.failure import Nonconformance
from sleec_verify.conformance.feasible_contexts import Assumptions
from sleec_verify.conformance.oracle import Expectation
from sleec_verify.conformance.other_threads import Provoked
from sleec_verify.conformance.subject import Bench, Running

MOST = 8
"""The maximal number of contexts for each group of rules: one for each set of active clauses."""


class InjectedFault(Provoked):
    """The exception that the test raises in an implementation."""


def inject_exceptions(bench: Bench) -> int:
    """Lets each execution in turn raise. Raises Nonconformance where the exception is swallowed, where what it should
    not stop is not done, or where the next trigger suffers. Returns the number of dispatches that raised."""
    oracle = bench.oracle()
    count = 0
    with bench.running() as running:
        for found in first_contexts(oracle, Assumptions(oracle.ruleset), MOST):
            for context, expected in found:
                for place in range(len(expected.due)):
                    _provoke(running, context, expected, place)
                    count += 1
    return count


def _provoke(running: Running, context: Context, expected: Expectation, place: int) -> None:
    provoked = InjectedFault(f"raised by the conformance test in {expected.due[place]}")
    begun = 0

    def on_execution(name: str) -> None:
        nonlocal begun
        begun += 1
        if begun == place + 1:
            raise provoked

    running.enter(context)
    observed = running.observe(context.triggers, on_execution)
    due = _still_due(expected, place)
    what = None
    if not _came_out(provoked, observed.error):
        what = f"swallowed an exception of {expected.due[place]}, or raised another: {observed.error!r}"
    elif observed.executed != due:
        what = f"after {expected.due[place]} raised, did not execute exactly the remaining obligations"
    if what is not None:
        raise Nonconformance(context, replace(expected, due=due), observed, what)
    failure = tried(running, context, expected)
    if failure is not None:
        raise failure.after([f"the same, but {expected.due[place]} raises an exception"])


def _came_out(provoked: InjectedFault, error: BaseException | None) -> bool:
    if isinstance(error, VariantsFailed):
        return any(each is provoked for _, each in error.errors)
    return error is provoked


def _still_due(expected: Expectation, place: int) -> tuple[str, ...]:
    """What is executed if the execution at `place` raises: all other rules, but not the rest of its own rule."""
    due: list[str] = []
    position = 0
    for active in expected.active:
        names = [o.name for o in active.obligations if not o.negated]
        due += names[: place - position + 1] if position <= place < position + len(names) else names
        position += len(names)
    return tuple(due)
