"""Files are small enough to be read in one sitting."""

from __future__ import annotations

from statistics import median

from tests.support.paths import ROOT

FOLDERS = ("sleec_runtime", "sleec_verify", "tests")
MEDIAN, MOST, MAXIMUM = 120, 250, 400
"""Lines: the median, the bound of nine files in ten, and the bound of all."""


def test_files_are_small() -> None:
    paths = sorted(path for folder in FOLDERS for path in (ROOT / folder).rglob("*.py"))
    lines = {path.relative_to(ROOT).as_posix(): path.read_text(encoding="utf-8").count("\n") for path in paths}
    assert {name: count for name, count in lines.items() if count > MAXIMUM} == {}
    assert sum(count < MOST for count in lines.values()) >= 0.9 * len(lines)
    assert median(count for count in lines.values() if count) <= MEDIAN
