"""`-o FILE`: written atomically, and refused before any work is done if it cannot be written."""

from __future__ import annotations

import json
import os
import stat
import subprocess
import sys
from pathlib import Path

import pytest

from tests.support.cli import Cli

CLASH = "WHEN Rung THEN Open\nWHEN Storm THEN NOT Open\n"
LINE = ("check", "a.sleec", "--format", "sarif", "-o", "report.sarif")


def test_a_file_of_that_name_is_replaced(cli: Cli, tmp_path: Path) -> None:
    (tmp_path / "report.sarif").write_text("old")
    (tmp_path / "report.sarif").chmod(0o640)
    ran = cli(*LINE, files={"a.sleec": CLASH})
    assert (ran.code, ran.out) == (1, "")
    assert ran.err == "report.sarif: 1 ruleset: 1 error, no warnings, no notes\n"
    assert json.loads((tmp_path / "report.sarif").read_text())["version"] == "2.1.0"
    assert stat.S_IMODE((tmp_path / "report.sarif").stat().st_mode) == 0o640
    assert sorted(os.listdir(tmp_path)) == ["a.sleec", "report.sarif"]


def test_a_new_file_has_the_usual_rights(cli: Cli, tmp_path: Path) -> None:
    before = os.umask(0o027)
    try:
        cli(*LINE, files={"a.sleec": CLASH})
    finally:
        os.umask(before)
    assert stat.S_IMODE((tmp_path / "report.sarif").stat().st_mode) == 0o640


@pytest.mark.parametrize("old", ["old", None])
def test_what_fails_leaves_all_as_it_was(
    old: str | None, cli: Cli, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    if old is not None:
        (tmp_path / "report.sarif").write_text(old)

    def fail(*_: object, **__: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("os.replace", fail)
    ran = cli(*LINE, files={"a.sleec": CLASH})
    assert ran.code == 2
    assert "report.sarif cannot be written: No space left on device" in ran.err
    assert "the file was not changed" in ran.err
    assert sorted(os.listdir(tmp_path)) == (["a.sleec"] if old is None else ["a.sleec", "report.sarif"])
    assert old is None or (tmp_path / "report.sarif").read_text() == old


def test_an_interruption_writes_nothing(cli: Cli, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "report.sarif").write_text("old")

    def interrupt(*_: object, **__: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("sleec_verify.checks.run_checks", interrupt)
    assert cli(*LINE, files={"a.sleec": CLASH}).code == 130
    assert (tmp_path / "report.sarif").read_text() == "old"
    assert sorted(os.listdir(tmp_path)) == ["a.sleec", "report.sarif"]


def test_a_link_stays_one(cli: Cli, tmp_path: Path) -> None:
    (tmp_path / "reports").mkdir()
    (tmp_path / "report.sarif").symlink_to("reports/latest.sarif")
    cli(*LINE, files={"a.sleec": CLASH})
    assert (tmp_path / "report.sarif").is_symlink()
    assert (tmp_path / "reports" / "latest.sarif").read_text().startswith("{")


def test_what_is_no_file_is_written_to(tmp_path: Path) -> None:
    (tmp_path / "a.sleec").write_text(CLASH)
    line = [sys.executable, "-m", "sleec_verify", "check", "a.sleec", "--format", "json", "-o", "/dev/stdout"]
    done = subprocess.run(line, cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 1
    assert json.loads(done.stdout)["summary"]["errors"] == 1
    assert os.path.exists("/dev/stdout")


@pytest.mark.parametrize(
    ("output", "message"),
    [
        ("a.sleec", "a.sleec is an input; name another file for the output"),
        ("rules/b.sleec", "rules/b.sleec is an input; name another file for the output"),
        ("./rules/../a.sleec", "./rules/../a.sleec is an input"),
        ("rules", "rules is a folder; name a file"),
        ("there/report.sarif", "the folder there for report.sarif does not exist"),
    ],
)
def test_what_the_output_may_not_be(
    output: str, message: str, cli: Cli, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("sleec_verify.checks.run_checks", lambda *_, **__: pytest.fail("this is told before any work"))
    ran = cli("check", "a.sleec", "rules", "-o", output, files={"a.sleec": CLASH, "rules/b.sleec": CLASH})
    assert ran.code == 2
    assert message in ran.err
    assert (tmp_path / "a.sleec").read_text() == (tmp_path / "rules/b.sleec").read_text() == CLASH


@pytest.mark.parametrize("output", ["robot.py", "a.sleec"])
def test_conform_overwrites_neither_code_nor_rules(output: str, cli: Cli, tmp_path: Path) -> None:
    files = {"robot.py": "x = 1\n", "a.sleec": CLASH}
    ran = cli("conform", "robot.py", "--ruleset", "a.sleec", "-o", output, files=files)
    assert ran.code == 2
    assert f"{output} is an input" in ran.err
    assert (tmp_path / output).read_text() == files[output]


def test_what_cannot_be_used_is_in_the_file_as_well(cli: Cli, tmp_path: Path) -> None:
    ran = cli(*LINE, files={"a.sleec": "WHEN"})
    assert ran.code == 2
    assert "report.sarif: 1 ruleset: no errors, no warnings, no notes, 1 unusable" in ran.err
    run = json.loads((tmp_path / "report.sarif").read_text())["runs"][0]
    assert not run["invocations"][0]["executionSuccessful"]
