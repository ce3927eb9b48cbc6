"""The Python of a robot, as `conform` reads it."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

from sleec_runtime.language import load, parse
from sleec_verify.conformance.structure import check_structure
from sleec_verify.conformance.structure.target import python_files
from sleec_verify.report import renderer
from sleec_verify.report.outcome import CheckedRuleset
from sleec_verify.report.palette import PLAIN
from tests.fuzz.property import unless_refused
from tests.support import timed_robot
from tests.support.paths import ROOT

RULESETS = (load(ROOT / "rulesets" / "household.sleec"), parse(timed_robot.RULES))


def python(data: bytes, folder: Path) -> None:
    """Whatever the code is, there is a verdict, and every finding is in the text."""
    path = folder / "robot.py"
    path.write_bytes(data)
    files = unless_refused(python_files, str(path))
    if files is None:
        return
    for ruleset in RULESETS:
        result = check_structure(ruleset, files)
        assert "".join(renderer("full")([CheckedRuleset(ruleset, (result,))], PLAIN))


def seeds() -> Iterator[bytes]:
    """The robots of the tests: each document of them holds files, some of them Python."""
    yield timed_robot.ROBOT.encode()
    for path in sorted((ROOT / "tests" / "fast" / "conformance" / "structure" / "documents").glob("*/*.txt")):
        text = path.read_text(encoding="utf-8")
        yield from (found.encode() for found in re.findall(r"^=== file \S+\.py\n(.*?)(?=^===|\Z)", text, re.M | re.S))
