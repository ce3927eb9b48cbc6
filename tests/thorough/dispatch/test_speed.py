"""The bounds of the benchmark, in a short run of it. Ratios of medians taken in turns, so a busy machine does not
matter. In a process of its own: the measurement of coverage slows this project's code and not ContextPy3's."""

from __future__ import annotations

import os
import subprocess
import sys

import pytest

from tests.support.paths import ROOT

RUN = """
import sys
from benchmarks import runtime_dispatch
_, bounds = getattr(runtime_dispatch, sys.argv[1])(int(sys.argv[2]))
assert bounds
sys.exit("\\n".join(str(bound) for bound in bounds if not bound.kept) or 0)
"""


@pytest.mark.speed
@pytest.mark.parametrize(
    ("part", "rounds"),
    [("by_size", 60), ("against_global_activation", 60), ("changes", 80), ("change_and_dispatch", 60)],
)
def test_the_bounds_are_kept(part: str, rounds: int) -> None:
    # Other tests run beside it, and may take the processor just then: what is too slow is so three times.
    for _ in range(3):
        run = subprocess.run(
            [sys.executable, "-c", RUN, part, str(rounds)],
            cwd=ROOT,
            env={name: value for name, value in os.environ.items() if not name.startswith("COVERAGE")},
            capture_output=True,
            text=True,
            check=False,
        )
        if run.returncode == 0:
            break
    assert (run.returncode, run.stderr) == (0, "")
