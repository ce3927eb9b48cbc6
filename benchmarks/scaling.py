"""Measure how `check` grows: time and memory for 1,000, 10,000 and 100,000 random rules with three hedges.

Each size runs in its own process, with all checks. Further rulesets of up to 10,000 rules have an assumption for every
third rule. Growth must be almost linear: 100,000 rules take at most 13 times as much as 10,000.

This takes some minutes. ``python -m benchmarks.scaling 1000 5000`` measures other sizes.
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path

from benchmarks.random_rules import assuming_rules, random_rules

SIZES = (1_000, 10_000, 100_000)
MOST_ASSUMING = 10_000
BOUND = 1.3
"""How much more than in proportion the largest step may cost."""

# Runs the command and then prints its resource usage, as the operating system reports it.
MEASURE = """
import resource, subprocess, sys
check = [sys.executable, "-m", "sleec_verify", "check", "--no-cache", "--format", "json", sys.argv[1]]
subprocess.run(check, stdout=subprocess.DEVNULL)
used = resource.getrusage(resource.RUSAGE_CHILDREN)
print(used.ru_utime + used.ru_stime, used.ru_maxrss / 1024)
"""


def cost(count: int, rules: Callable[[int], str] = random_rules) -> tuple[float, float]:
    """Processor seconds and peak MiB of a check of `count` rules."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "rules.sleec"
        path.write_text(rules(count), encoding="utf-8")
        output = subprocess.run(
            [sys.executable, "-c", MEASURE, str(path)], check=True, capture_output=True, text=True
        ).stdout
    seconds, memory = map(float, output.split())
    return seconds, memory


def main(sizes: tuple[int, ...] = SIZES) -> None:
    print(f"last step: {report(sizes, random_rules):.2f} of proportional (at most {BOUND})")
    print("with assumptions:")
    last = report(tuple(size for size in sizes if size <= MOST_ASSUMING), assuming_rules)
    print(f"last step: {last:.2f} of proportional (at most {BOUND})")


def report(sizes: tuple[int, ...], rules: Callable[[int], str]) -> float:
    """Print the cost of rulesets of these sizes, and return the growth of the last step relative to linear growth."""
    before: tuple[int, float, float] | None = None
    worst = 0.0
    for count in sizes:
        seconds, memory = cost(count, rules)
        line = f"{count:>8,} rules: {seconds:8.2f} s {memory:8.0f} MiB"
        if before is not None:
            smaller, time, space = before
            worst = seconds / time / (count / smaller)
            line += f"   {seconds / time:5.1f} times the time and {memory / space:5.1f} times the memory"
            line += f" for {count / smaller:g} times the rules"
        print(line, flush=True)
        before = count, seconds, memory
    return worst


if __name__ == "__main__":
    main(tuple(map(int, sys.argv[1:])) or SIZES)
