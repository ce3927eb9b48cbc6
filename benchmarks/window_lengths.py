"""Measure all checks of three rules whose windows one measure gives, for ranges of different sizes.

With a range of 30 values, they may take at most a second.
"""

from __future__ import annotations

import sys
from time import perf_counter

from sleec_runtime.language import parse
from sleec_verify.checks import run_checks
from sleec_verify.results.finding import Unknown

VALUES = (30, 100, 300)
BOUND = 1.0
"""Seconds for 30 values."""

RULES = """
MEASURE patience: integer
ASSUME patience >= 1 AND patience <= {}
RULE R1 WHEN Smoke THEN Call WITHIN patience minutes
RULE R2 WHEN Fall THEN NOT Call WITHIN patience minutes
RULE R3 WHEN Night THEN Fall WITHIN patience minutes
"""


def main(values: tuple[int, ...] = VALUES) -> None:
    for count in values:
        ruleset = parse(RULES.format(count))
        started = perf_counter()
        results = run_checks(ruleset)
        seconds = perf_counter() - started
        unknown = sum(isinstance(result.verdict, Unknown) for result in results)
        bound = f" (at most {BOUND:.0f} s)" if count == VALUES[0] else ""
        print(f"{count:5,} values  {seconds:6.2f} s{bound}; {unknown} checks unknown", flush=True)


if __name__ == "__main__":
    main(tuple(map(int, sys.argv[1:])) or VALUES)
