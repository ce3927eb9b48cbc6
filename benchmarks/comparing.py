"""Compare `diff` with reading: 10,000 random rules with three hedges, with one changed rule.

A diff may take at most 1.5 times as long as reading both texts. Times are processor times, measured alternately, and
the medians count.
"""

from __future__ import annotations

import statistics
from time import process_time

from benchmarks.random_rules import random_rules
from sleec_runtime.language import parse
from sleec_verify.changes.compare import compare

COUNT = 10_000
BOUND = 1.5
TURNS = 5


def edited(text: str, label: str) -> str:
    """The rules with another first hedge in the rule with this label."""
    at = text.index("UNLESS", text.index(f"RULE {label}\n"))
    return f"{text[:at]}UNLESS SomethingNew OR{text[at + len('UNLESS') :]}"


def measure(count: int = COUNT, turns: int = TURNS) -> tuple[float, float]:
    """Median seconds of reading both versions, and of reading and comparing them."""
    old = random_rules(count)
    new = edited(old, f"r{count // 2}")
    reading, whole = [], []
    for _ in range(turns):
        started = process_time()
        before, after = parse(old), parse(new)
        read = process_time()
        found = compare(before, after)
        reading.append(read - started)
        whole.append(process_time() - started)
        assert {change.rules for change in found.changes} == {(f"r{count // 2}",)}
    return statistics.median(reading), statistics.median(whole)


def main() -> None:
    reading, whole = measure()
    print(f"reading {COUNT:,} rules twice     {reading:6.2f} s")
    print(f"diff with one rule changed    {whole:6.2f} s   {whole / reading:.2f} times (at most {BOUND})")


if __name__ == "__main__":
    main()
