"""Compare a report of 200 rules with a check of them, each in its own process, without the cache.

The bounds are three times the check, and 5 MB for the page. Runs alternate, and the medians of the processor times
count.
"""

from __future__ import annotations

import os
import statistics
import subprocess
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

from benchmarks.random_rules import random_rules

BOUND = 3
MOST_BYTES = 5_000_000
TURNS = 5


def measure(turns: int = TURNS) -> tuple[float, float, int]:
    """Median seconds of the check and of the report, and the size of the page."""
    check: list[float] = []
    report: list[float] = []
    with TemporaryDirectory() as folder:
        rules, page = Path(folder) / "rules.sleec", Path(folder) / "report.html"
        rules.write_text(random_rules(200), "utf-8")
        for _ in range(turns):
            for command, times in (("check", check), ("report", report)):
                times.append(_seconds(command, str(rules), "--no-cache", "-o", str(page)))
        return statistics.median(check), statistics.median(report), page.stat().st_size


def _seconds(*arguments: str) -> float:
    program = str(Path(sys.executable).with_name("sleec-verify"))
    before = os.times()
    subprocess.run([program, *arguments], check=False, stderr=subprocess.DEVNULL)
    after = os.times()
    return after.children_user + after.children_system - before.children_user - before.children_system


def main() -> None:
    check, report, size = measure()
    print(f"check of 200 rules   {check * 1000:7.0f} ms")
    print(f"report of 200 rules  {report * 1000:7.0f} ms   {report / check:.1f} times (at most {BOUND})")
    print(f"size of the page     {size / 1e6:7.1f} MB  (at most {MOST_BYTES / 1e6:.0f} MB)")
