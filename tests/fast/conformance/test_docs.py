"""The examples of docs/conformance-tests.md and docs/cases.md are what the pages say they are."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from sleec_verify.conformance import Nonconformance, check_conformance, conformance_test
from sleec_verify.conformance.cases.reader import read_cases
from sleec_verify.conformance.oracle import Oracle
from sleec_verify.conformance.suite import PARTS

GUIDE = Path("docs/conformance-tests.md").read_text(encoding="utf-8")
CASES = Path("docs/cases.md").read_text(encoding="utf-8")


def blocks(language: str, page: str = GUIDE) -> list[str]:
    return re.findall(rf"^```{language}\n(.*?)^```$", page, re.MULTILINE | re.DOTALL)


def test_the_program_runs_and_its_robot_passes() -> None:
    program: dict[str, object] = {}
    for block in blocks("python"):
        exec(compile(block, "docs/conformance-tests.md", "exec"), program)
    make = program["make_sleec"]
    assert callable(make)
    check_conformance(make, examples=10)
    nurse = program["make_nurse"]
    assert callable(nurse)
    check_conformance(nurse, examples=10)


def test_the_report_is_what_is_printed() -> None:
    (source,) = (block for block in blocks("python") if "def make_sleec" in block)
    program: dict[str, object] = {}
    exec(source.replace("self.refuse_request(); self.explain_why()", "self.refuse_request()"), program)
    make = program["make_sleec"]
    assert callable(make)
    with pytest.raises(Nonconformance) as caught:
        check_conformance(make)
    assert str(caught.value) + "\n" in blocks("text")


def test_the_report_about_time_is_what_is_printed() -> None:
    (source,) = (block for block in blocks("python") if "def make_nurse" in block)
    early = source.replace('print("calling the nurse")', "self.call_ambulance()").replace('print("', '("')
    program: dict[str, object] = {"conformance_test": conformance_test}
    exec(early, program)
    make = program["make_nurse"]
    assert callable(make)
    with pytest.raises(Nonconformance) as caught:
        check_conformance(make)
    assert str(caught.value) + "\n" in blocks("text")


def test_every_part_is_told_of() -> None:
    assert re.findall(r"^\| `([a-z-]+)` \| ", GUIDE, re.MULTILINE)[: len(PARTS)] == list(PARTS)


def test_the_cases_are_due(tmp_path: Path) -> None:
    path = tmp_path / "household.cases.toml"
    path.write_text(blocks("toml", CASES)[0], encoding="utf-8")
    (tmp_path / "household.sleec").write_bytes(Path("rulesets/household.sleec").read_bytes())
    found = read_cases(path)
    ruleset = found.ruleset
    for case in found.situations:
        assert set(Oracle(ruleset).expected(case.context()).due) == set(case.obligations)
