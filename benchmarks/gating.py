"""Compare `gate` on 50 rulesets of 20 random rules, one of them changed, with `check` of the changed file.

Both are whole processes without a cache, in a git repository, measured alternately. The median ratio may be at most
1.5.
"""

from __future__ import annotations

import os
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from benchmarks.comparing import edited
from benchmarks.random_rules import random_rules

RULESETS, RULES = 50, 20
BOUND = 1.5
TURNS = 11


def prepare(folder: Path) -> Path:
    """Create a repository with committed rulesets, and change one rule of one of them."""
    git = ["git", "-C", str(folder), "-c", "user.name=Nobody", "-c", "user.email=nobody@example.org"]
    for number in range(RULESETS):
        (folder / f"rules{number}.sleec").write_text(random_rules(RULES, seed=number), encoding="utf-8")
    for arguments in (["init", "-q", "-b", "main"], ["add", "-A"], ["commit", "-q", "-m", "rules"]):
        subprocess.run([*git, *arguments], check=True)
    changed = folder / "rules7.sleec"
    changed.write_text(edited(changed.read_text(encoding="utf-8"), f"r{RULES // 2}"), encoding="utf-8")
    return changed


def seconds(arguments: list[str], folder: Path) -> float:
    """The seconds of one process. Its findings do not matter here."""
    command = [sys.executable, "-m", "sleec_verify", *arguments]
    environment = {
        **os.environ,
        "SLEEC_VERIFY_CACHE": "off",
        "PYTHONPATH": os.pathsep.join(filter(None, [os.getcwd(), os.environ.get("PYTHONPATH")])),
    }
    start = time.perf_counter()
    done = subprocess.run(command, stdout=subprocess.DEVNULL, cwd=folder, env=environment, check=False)
    assert done.returncode in (0, 1), done
    return time.perf_counter() - start


def measure(turns: int = TURNS) -> tuple[float, float]:
    """Median seconds of the check, and of the gate."""
    check, gate = [], []
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        changed = prepare(folder)
        for _ in range(turns + 1):
            check.append(seconds(["check", changed.name], folder))
            gate.append(seconds(["gate", "--base", "main"], folder))
    return statistics.median(check[1:]), statistics.median(gate[1:])


def main() -> None:
    check, gate = measure()
    print(f"check of the changed file          {check * 1000:7.1f} ms")
    print(
        f"gate on {RULESETS} rulesets, one changed  {gate * 1000:7.1f} ms   {gate / check:.2f} times (at most {BOUND})"
    )


if __name__ == "__main__":
    main()
