"""Compare all checks of our studies, in whole processes, with empty Python processes; measure the published studies.

The published files are not part of this project: give their folder with ``python -m benchmarks.studies FOLDER``.
LEGOS-SLEEC takes about 225 s for five questions on ten of them (two for each study), on a machine with two cores, one
question at a time. We must take at most a hundredth of that.
"""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Iterable
from pathlib import Path
from time import perf_counter

OWN = Path(__file__).parents[1] / "rulesets" / "studies"
PUBLISHED = (
    "ALMI/ALMI.sleec",
    "ALMI/ALMI-Corrected.sleec",
    "ASPEN/aspen.sleec",
    "ASPEN/aspen-corrected.sleec",
    "Autocar/Autocar.sleec",
    "Autocar/Autocar-corrected.sleec",
    "CSI/CSI.sleec",
    "CSI/CSI-corrected.sleec",
    "dressingAssist/DRESSASSIST.sleec",
    "dressingAssist/DRESSASSIST-corrected.sleec",
)
LEGOS = 225.0
"""Seconds."""

BOUND = 100


def seconds(*arguments: str) -> float:
    started = perf_counter()
    subprocess.run([sys.executable, *arguments], stdout=subprocess.DEVNULL, check=False)
    return perf_counter() - started


def total(paths: Iterable[Path]) -> tuple[float, float]:
    """The seconds of checks of all files, each in its own process, and of as many empty processes, in turns.

    Prints each check.
    """
    spent = empty = 0.0
    for path in paths:
        empty += seconds("-c", "pass")
        one = seconds("-m", "sleec_verify", "check", "--no-cache", "--format", "json", str(path))
        spent += one
        print(f"{one:6.2f} s  {path.name}", flush=True)
    return spent, empty


def main(folder: Path = Path("../shared/case-studies")) -> None:
    spent, empty = total(sorted(OWN.glob("*.sleec")))
    print(f"{spent:6.2f} s for our studies: {spent / empty:.0f} times as many empty processes")
    if not folder.is_dir():
        print(f"the published case studies are not in {folder}")
        return
    spent, _ = total(folder / name for name in PUBLISHED)
    print(f"{spent:6.2f} s for the published ones: one {LEGOS / spent:.0f}th of LEGOS-SLEEC (at most one {BOUND}th)")


if __name__ == "__main__":
    main(*map(Path, sys.argv[1:]))
