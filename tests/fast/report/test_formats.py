"""The formats that other programs read: complete, the same on standard output and in a file, and no unknown
verdict is fine in any of them. `test_json` has the JSON."""

from __future__ import annotations

import json
import re
import xml.etree.ElementTree as ET
from pathlib import Path

import pytest

from sleec_verify.report import FORMATS
from tests.support.cli import Cli
from tests.support.formats import BROKEN, CLASH, CLEAN, VALIDATOR, give_up, is_complete
from tests.support.paths import ROOT

ENDS = {0: CLEAN, 1: CLASH, 2: BROKEN, 3: CLEAN}


@pytest.mark.parametrize("code", ENDS)
@pytest.mark.parametrize("form", FORMATS)
def test_exit_codes(form: str, code: int, cli: Cli, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    if code == 3:
        monkeypatch.setattr("sleec_verify.checks.run_checks", give_up)
    ran = cli("check", "a.sleec", "--format", form, files={"a.sleec": ENDS[code]})
    assert ran.code == code
    is_complete(form, ran.out, code)
    filed = cli("check", "a.sleec", "--format", form, "--output", "report")
    assert (filed.code, filed.out) == (code, "")
    assert "report: 1 ruleset: " in filed.err

    def timeless(text: str) -> str:
        return re.sub(r'(time="|"seconds": )[\d.e-]+', "", text)

    assert timeless((tmp_path / "report").read_text(encoding="utf-8")) == timeless(ran.out)


@pytest.mark.parametrize("form", FORMATS)
def test_exit_codes_of_conform(form: str, cli: Cli, monkeypatch: pytest.MonkeyPatch) -> None:
    robot = (ROOT / "examples" / "household_robot.py").read_text(encoding="utf-8")
    rules = (ROOT / "rulesets" / "household.sleec").read_text(encoding="utf-8")
    files = {"robot.py": robot, "rulesets/household.sleec": rules, "empty.py": "x = 1\n", "bad.py": "def\n"}
    line = ("--ruleset", "rulesets/household.sleec", "--format", form)
    assert cli("conform", "robot.py", *line, files=files).code == 0
    refuted = cli("conform", "empty.py", *line)
    assert refuted.code == 1
    if form == "sarif":
        VALIDATOR.validate(json.loads(refuted.out))
    assert cli("conform", "bad.py", *line).code == 2
    dark = "import sleec_runtime\nsleec = sleec_runtime.load('rulesets/household.sleec')\nsleec.implement(table())\n"
    unknown = cli("conform", "dark.py", *line, files={"dark.py": dark})
    assert unknown.code == 3
    if form == "sarif":
        log = json.loads(unknown.out)
        VALIDATOR.validate(log)
        assert not log["runs"][0]["invocations"][0]["executionSuccessful"]
    elif form == "junit":
        assert ET.fromstring(unknown.out).get("errors") == "1"
