"""Compare a check of the paper's eight rules with an empty Python process, and measure the cache.

The bounds are ten times ``python3 -c pass`` without the cache, and 1.1 times that while the cache is filled. Runs
alternate, and the medians count, so that a load on the machine affects all of them. Modules are compiled first, as pip
does when it installs a package.
"""

from __future__ import annotations

import compileall
import os
import statistics
import subprocess
import sys
import time
from pathlib import Path
from tempfile import TemporaryDirectory

import click

import sleec_runtime
import sleec_verify

RULES = Path(__file__).parents[1] / "rulesets" / "care-robot.sleec"
BOUND = 10
CACHE_BOUND = 1.1
TURNS = 31


def seconds(command: list[str], cache: str) -> float:
    environment = {**os.environ, "SLEEC_VERIFY_CACHE": cache}
    start = time.perf_counter()
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL, env=environment)
    return time.perf_counter() - start


def measure(turns: int = TURNS) -> tuple[float, float, float, float]:
    """Median seconds of an empty process, of the check, of a check that fills the cache, and of one that uses it."""
    command = [str(Path(sys.executable).with_name("sleec-verify")), "check", str(RULES)]
    empty, check, first, second = [], [], [], []
    for _ in range(turns):
        with TemporaryDirectory() as folder:
            cache = os.path.join(folder, "cache")
            empty.append(seconds([sys.executable, "-c", "pass"], "off"))
            check.append(seconds([*command, "--no-cache"], "off"))
            first.append(seconds(command, cache))
            second.append(seconds(command, cache))
    return statistics.median(empty), statistics.median(check), statistics.median(first), statistics.median(second)


def main() -> None:
    for package in (sleec_runtime, sleec_verify, click):
        compileall.compile_dir(Path(str(package.__file__)).parent, quiet=1)
    empty, check, first, second = measure()
    print(f"python -c pass              {empty * 1000:7.1f} ms")
    print(f"sleec-verify check, 8 rules {check * 1000:7.1f} ms   {check / empty:.1f} times (at most {BOUND})")
    print(f"  that fills the cache      {first * 1000:7.1f} ms   {first / check:.2f} times (at most {CACHE_BOUND})")
    print(f"  that finds it filled      {second * 1000:7.1f} ms   {second / check:.2f} times")
