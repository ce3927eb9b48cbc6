"""The short version of the evaluation of the paper runs, and what it claims holds."""

from __future__ import annotations

import csv
import subprocess
import sys
from pathlib import Path

import pytest

from benchmarks.evaluation.variants.systems import LISTING_2, VARIANTS
from tests.support.dds import require_dds
from tests.support.paths import ROOT

require_dds()
for name in ("scipy", "matplotlib"):
    pytest.importorskip(name, reason=f"`make evaluation` installs {name} (requirements/evaluation.lock)")


def rows(path: Path) -> list[dict[str, str]]:
    with path.open(newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def test_the_short_version_holds(tmp_path: Path) -> None:
    process = subprocess.run(
        [sys.executable, "-m", "benchmarks.evaluation", "--quick", "--output", str(tmp_path)],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=False,
    )
    assert process.returncode == 0, process.stdout + process.stderr
    correctness = rows(tmp_path / "e1-correctness.csv")
    assert {row["system"] for row in correctness} == {*VARIANTS, LISTING_2}
    assert all(row["triggers"] == row["matches"] for row in correctness)
    delays = rows(tmp_path / "e2-delays.csv")
    assert {row["system"] for row in delays} == {*VARIANTS, LISTING_2}
    assert all(float(row["milliseconds"]) > 0 for row in delays)
    changes = {(row["change"], row["variant"]): row for row in rows(tmp_path / "e3-changes.csv")}
    assert changes["add-rule", "CO-SLEEC"]["python"] == "0"
    assert int(changes["add-rule", "CS-libs"]["python"]) > 10
    robustness = [row for row in rows(tmp_path / "robustness.csv") if row["system"] == "CO-SLEEC"]
    assert robustness
    assert {(row["wrong"], row["repeated"]) for row in robustness} == {("0", "0")}
    report = (tmp_path / "report.md").read_text(encoding="utf-8")
    assert all(f"({path.name})" in report for path in tmp_path.glob("*.svg"))
