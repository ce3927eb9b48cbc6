"""Measure how `check` grows if responses trigger rules: random rulesets of the DSL without windows.

Each size runs in its own process, with all checks. LEGOS-SLEEC takes 4, 10 and 44 seconds for rulesets of 25, 50 and
100 rules, and does not answer within 120 seconds for 200 rules.
"""

from __future__ import annotations

import sys

from benchmarks.random_dsl import random_dsl
from benchmarks.scaling import report

SIZES = (25, 50, 100, 200, 1_000, 10_000)


def main(sizes: tuple[int, ...] = SIZES) -> None:
    report(sizes, random_dsl)


if __name__ == "__main__":
    main(tuple(map(int, sys.argv[1:])) or SIZES)
