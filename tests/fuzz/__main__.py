"""``python -m tests.fuzz [--seconds N] [TARGET …]``: fuzz each target for its part of the time (docs/development.md).

New inputs are kept in ``.fuzz/TARGET``, where the next run begins; inputs that fail are in ``.fuzz/failures``.
"""

from __future__ import annotations

import re
import subprocess
import sys
from argparse import ArgumentParser
from pathlib import Path

from tests.fuzz.targets import TARGETS
from tests.support.paths import ROOT

WORK = ROOT / ".fuzz"
FAILURES = WORK / "failures"
OPTIONS = (
    "-timeout=120",  # A backstop where Python cannot interrupt: each input has a limit of CPU time.
    "-rss_limit_mb=1024",
    "-print_final_stats=1",
    "-verbosity=0",
)


def main() -> int:
    parser = ArgumentParser(prog="make fuzz")
    parser.add_argument("--seconds", type=int, default=60, help="for all targets together")
    parser.add_argument("targets", nargs="*", metavar="TARGET", help=f"one of {', '.join(TARGETS)}; all by default")
    arguments = parser.parse_args()
    unknown = set(arguments.targets) - TARGETS.keys()
    if unknown:
        parser.error(f"there is no target {', '.join(sorted(unknown))}; there are {', '.join(TARGETS)}")
    chosen = arguments.targets or list(TARGETS)
    FAILURES.mkdir(parents=True, exist_ok=True)
    failed = [name for name in chosen if not fuzz(name, max(1, arguments.seconds // len(chosen)))]
    return 1 if failed else 0


def fuzz(name: str, seconds: int) -> bool:
    """Fuzz one target in a process of its own. Whether nothing failed."""
    inputs = WORK / name
    inputs.mkdir(exist_ok=True)
    command = [sys.executable, "-m", "tests.fuzz.fuzzer", name, str(inputs), *OPTIONS]
    command += [f"-max_total_time={seconds}", f"-artifact_prefix={FAILURES}/{name}-"]
    before = len(list(inputs.iterdir()))
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, errors="replace", check=False)
    output = done.stdout + done.stderr
    if done.returncode == 0:
        runs = re.search(r"stat::number_of_executed_units:\s*([0-9]+)", output)
        new = len(list(inputs.iterdir())) - before
        print(f"{name}: {runs.group(1) if runs else 0} inputs, {new} of them new coverage, no failure", flush=True)
        return True
    told = "\n".join(line for line in output.splitlines() if not line.startswith(("INFO:", "WARNING:", "stat::")))
    print(f"{name}: failure\n{told}", flush=True)
    written = re.search(r"Test unit written to (.+)", output)
    if written is not None:
        shown = Path(written.group(1)).relative_to(ROOT)
        print(
            f"The input is in {shown}. To repeat it:\n.venv/bin/python -m tests.fuzz.replay {name} {shown}", flush=True
        )
    return False


if __name__ == "__main__":
    sys.exit(main())
