"""What is slow to import is imported where it is used, so that a check feels instant."""

from __future__ import annotations

import subprocess
import sys

import pytest

from tests.support.paths import ROOT

SLOW = ("sympy", "rich", "hypothesis", "importlib.metadata", "logging", "argparse", "unittest", "json")


@pytest.mark.parametrize(
    "command", [["check", "rulesets/care-robot.sleec"], ["entail", "rulesets/household.sleec"], ["--version"]]
)
def test_nothing_slow_is_imported(command: list[str]) -> None:
    code = (
        "import sys\n"
        "before = set(sys.modules)\n"
        "from sleec_verify.cli import run\n"
        f"run({command!r})\n"
        f"print(*[name for name in {SLOW!r} if name in sys.modules.keys() - before], file=sys.stderr)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True, cwd=ROOT)
    assert done.stderr.split() == []
