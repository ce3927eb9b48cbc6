"""Compare one propagation for all entailed obligations of a context with one solver call for one obligation.

A propagation may take at most three times as long as a call. The formulas are those of the paper's rules and of 1,000
rules. The context triggers every rule.
"""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable

from benchmarks.random_rules import random_rules
from sleec_runtime.language import parse
from sleec_runtime.model import Context, Obligation
from sleec_verify.entailment.definition1 import Definition1

BOUND = 3
TURNS = 200


def median(action: Callable[[], object]) -> float:
    times = []
    for _ in range(TURNS):
        started = time.perf_counter()
        action()
        times.append(time.perf_counter() - started)
    return statistics.median(times)


def compare(count: int) -> tuple[float, float]:
    """Median seconds for all obligations, and for one."""
    ruleset = parse(random_rules(count))
    definition = Definition1(ruleset)
    context = Context(ruleset.triggers, dict.fromkeys(ruleset.measures, 5))
    one = Obligation(min(ruleset.obligations))
    return median(lambda: definition.entailed(context)), median(lambda: definition.entails(context, one))


def main() -> None:
    for count in (8, 1_000):
        every, single = compare(count)
        print(
            f"{count:>6,} rules: all obligations {every * 1e6:8.1f} µs, one obligation {single * 1e6:8.1f} µs,"
            f" ratio {every / single:.2f} (at most {BOUND})"
        )


if __name__ == "__main__":
    main()
