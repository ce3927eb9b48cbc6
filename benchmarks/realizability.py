"""Measure how games grow: random rulesets with windows, and an environment that acts twice."""

from __future__ import annotations

import sys
from time import perf_counter

from benchmarks.random_dsl import random_dsl
from sleec_runtime.language import parse
from sleec_verify.checks import run_checks

SIZES = (100, 1_000, 10_000)
WINDOWS = ("", "", " within 5 minutes", " within 1 hours")


def main(sizes: tuple[int, ...] = SIZES) -> None:
    before = 0.0
    for size in sizes:
        ruleset = parse(random_dsl(size, windows=WINDOWS))
        started = perf_counter()
        (result,) = run_checks(ruleset, (), realizable=2)
        seconds = perf_counter() - started
        growth = f", {seconds / before:.1f} times the last" if before else ""
        print(f"{size:7,} rules  {seconds:7.2f} s{growth}; {len(result.findings)} found", flush=True)
        before = seconds


if __name__ == "__main__":
    main(tuple(map(int, sys.argv[1:])) or SIZES)
