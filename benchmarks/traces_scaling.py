"""How `check` grows where what is done triggers rules: time and memory of random rulesets of the DSL without times,
each in a process of its own, all checks included.

LEGOS-SLEEC takes 4, 10 and 44 seconds for rulesets of 25, 50 and 100 rules, and does not answer for 200 in 120 seconds.
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
