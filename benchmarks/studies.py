"""The five questions on the ten published files that LEGOS-SLEEC was timed on (two a study), whole processes included.

The files are not part of this project: ``python -m benchmarks.studies FOLDER`` is told where they are. LEGOS-SLEEC
takes about 225 s for the same on a machine of two cores, one question at a time; a hundredth of that is asked for.
"""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path
from time import perf_counter

FILES = (
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


def main(folder: Path = Path("../shared/case-studies")) -> None:
    if not folder.is_dir():
        print(f"the files are not in {folder}")
        return
    total = 0.0
    for name in FILES:
        started = perf_counter()
        check = [sys.executable, "-m", "sleec_verify", "check", "--no-cache", "--format", "json", str(folder / name)]
        subprocess.run(check, stdout=subprocess.DEVNULL, check=False)
        seconds = perf_counter() - started
        total += seconds
        print(f"{seconds:6.2f} s  {name}", flush=True)
    print(f"{total:6.2f} s in all: one {LEGOS / total:.0f}th of LEGOS-SLEEC (at most one {BOUND}th)")


if __name__ == "__main__":
    main(*map(Path, sys.argv[1:]))
