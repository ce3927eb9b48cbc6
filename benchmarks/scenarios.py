"""Compare `cases` with `check` on 100 random rules with time, without a cache.

Both are whole processes, measured by their processor time. In the first ruleset, every response has a window. In the
second, some have none, some open later, and some have an alternative that triggers nothing. `cases` may take at most
ten times as long as `check`.
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
from pathlib import Path

from benchmarks.random_dsl import random_dsl

RULES = 100
BOUND = 10
WINDOWS = {
    "a window for every response": (
        " within 5 minutes",
        " within 30 seconds",
        " within 1 hour",
        " within 2 minutes",
        " within 10 minutes",
    ),
    "windows and alternatives": (
        "",
        " within 5 minutes",
        " within 30 seconds otherwise F1 within 2 minutes",
        " within 1 hour",
        " within [10,60] seconds",
    ),
}

# Runs a command and then prints its resource usage, as the operating system reports it.
MEASURE = """
import resource, subprocess, sys
subprocess.run([sys.executable, "-m", "sleec_verify", *sys.argv[1:]], stdout=subprocess.DEVNULL)
used = resource.getrusage(resource.RUSAGE_CHILDREN)
print(used.ru_utime + used.ru_stime)
"""


def seconds(*arguments: str) -> float:
    """Processor seconds of a command."""
    done = subprocess.run([sys.executable, "-c", MEASURE, *arguments], check=True, capture_output=True, text=True)
    return float(done.stdout)


def main() -> None:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "rules.sleec"
        for number, (what, windows) in enumerate(WINDOWS.items()):
            path.write_text(random_dsl(RULES, seed=1 - number, windows=windows), encoding="utf-8")
            check = seconds("check", "--no-cache", str(path))
            cases = seconds("cases", str(path))
            print(
                f"{RULES} rules, {what}: check {check:.1f} s, cases {cases:.1f} s, "
                f"ratio {cases / check:.1f} (at most {BOUND})"
            )


if __name__ == "__main__":
    main()
