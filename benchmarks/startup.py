"""What a check of the paper's eight rules costs as a whole process, beside an empty Python process.

The bound is ten times ``python3 -c pass``. The two are timed in turns and the medians compared, so that a
load on the machine meets both. The modules are compiled first, as pip does when it installs a package.
"""

from __future__ import annotations

import compileall
import statistics
import subprocess
import sys
import time
from pathlib import Path

import click

import sleec_runtime
import sleec_verify

RULES = Path(__file__).parents[1] / "rulesets" / "care-robot.sleec"
BOUND = 10
TURNS = 21


def seconds(command: list[str]) -> float:
    start = time.perf_counter()
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    return time.perf_counter() - start


def measure(turns: int = TURNS) -> tuple[float, float]:
    """Median seconds of an empty process and of the check."""
    empty, check = [], []
    for _ in range(turns):
        empty.append(seconds([sys.executable, "-c", "pass"]))
        check.append(seconds([str(Path(sys.executable).with_name("sleec-verify")), "check", str(RULES)]))
    return statistics.median(empty), statistics.median(check)


def main() -> None:
    for package in (sleec_runtime, sleec_verify, click):
        compileall.compile_dir(Path(str(package.__file__)).parent, quiet=1)
    empty, check = measure()
    print(f"python -c pass              {empty * 1000:7.1f} ms")
    print(f"sleec-verify check, 8 rules {check * 1000:7.1f} ms   {check / empty:.1f} times (at most {BOUND})")
