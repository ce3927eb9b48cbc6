"""Threads: each clause in another thread than the main one, and many threads with one changing context, where each
trigger must execute what is due in some complete context."""

from __future__ import annotations

import sys
import threading
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from itertools import islice

from sleec_runtime.model import Context
from sleec_verify.conformance.atomicity import justified_by_one
from sleec_verify.conformance.distinguishing_pairs import ContextPair, pairs
from sleec_verify.conformance.exhaustive import SAMPLED, groups, situations, tried
from sleec_verify.conformance.failure import Nonconformance
from sleec_verify.conformance.feasible_contexts import Assumptions
from sleec_verify.conformance.oracle import Expectation, Oracle
from sleec_verify.conformance.subject import Bench, Observation, Running

THREADS = 4
DISPATCHES = 300
PAIRS = 3
"""The maximal number of pairs of contexts for competing threads, those with a distinguishing mixture first."""


def in_threads(bench: Bench) -> int:
    """Raises `Nonconformance` if a thread executes what is due in no complete context, or does not see the context
    of another thread. Returns the number of dispatches."""
    oracle = bench.oracle()
    assumptions = Assumptions(oracle.ruleset)
    clauses = 0
    with bench.running() as running:
        for context, expected in each_clause(oracle, assumptions):
            _handed_over(running, context, expected)
            clauses += 1
    found = pairs(oracle, assumptions)[:PAIRS]
    for pair in found:
        with bench.running() as running, _hasty_threads():
            for context in (pair.before, pair.after):
                _handed_over(running, context, oracle.expected(context))
            _fought_over(running, pair)
    return clauses + len(found) * THREADS * DISPATCHES


def each_clause(oracle: Oracle, assumptions: Assumptions) -> Iterator[tuple[Context, Expectation]]:
    """A situation for each clause of each rule in which it is active, and no more of them than that takes."""
    for group in groups(oracle, unreported=False):
        clauses = {(rule.label, number) for rule in group.rules for number, _ in enumerate(rule.clauses())}
        for context, expected in islice(situations(group, oracle, assumptions), 4 * SAMPLED):
            new = clauses & {(one.rule, one.clause) for one in expected.active}
            if new and not expected.conflict:
                clauses -= new
                yield context, expected
            if not clauses:
                break


def _handed_over(running: Running, context: Context, expected: Expectation) -> None:
    """One thread reports the context, and another one triggers. `expected` is computed before, because the solver
    belongs to this thread."""
    running.enter(context)
    failures: list[Nonconformance] = []

    def work() -> None:
        failure = tried(running, context, expected)
        if failure is not None:
            failures.append(failure.after(["the context was reported by another thread"]))

    _all_run([threading.Thread(target=work)])
    for failure in failures:
        raise failure


def _fought_over(running: Running, pair: ContextPair) -> None:
    unjustified: list[Observation] = []
    finished = threading.Event()
    running.enter(pair.before)

    def work() -> None:
        for _ in range(DISPATCHES):
            if unjustified:
                return
            observed = running.observe(pair.triggers)
            if observed.executed not in pair.due or observed.error is not None:
                unjustified.append(observed)

    def change() -> None:
        while not finished.is_set():
            running.enter(pair.after)
            running.enter(pair.before)

    changer = threading.Thread(target=change)
    changer.start()
    _all_run([threading.Thread(target=work) for _ in range(THREADS)])
    finished.set()
    changer.join()
    for observed in unjustified:
        justified_by_one(pair, observed, running, "while another thread changed the context repeatedly")


def _all_run(threads: Sequence[threading.Thread]) -> None:
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()


@contextmanager
def _hasty_threads() -> Iterator[Callable[[], float]]:
    """Threads switch every few microseconds instead of milliseconds."""
    interval = sys.getswitchinterval()
    sys.setswitchinterval(1e-6)
    try:
        yield sys.getswitchinterval
    finally:
        sys.setswitchinterval(interval)
