"""Files are small enough to be read in one sitting."""

from __future__ import annotations

from tests.support.paths import ROOT

FOLDERS = ("sleec_runtime", "sleec_verify", "tests")
MAXIMUM = 600
"""Lines. A file is about one topic, and what is always read together is one file. So there is no bound below."""


def test_files_are_read_in_one_sitting() -> None:
    paths = sorted(path for folder in FOLDERS for path in (ROOT / folder).rglob("*.py"))
    lines = {path.relative_to(ROOT).as_posix(): path.read_text(encoding="utf-8").count("\n") for path in paths}
    assert {name: count for name, count in lines.items() if count > MAXIMUM} == {}
