"""An internal error on one file: it is reported with the file's name, the others go on, and the exit code is 2."""

from __future__ import annotations

import json
import subprocess
from collections.abc import Callable
from functools import wraps
from pathlib import Path
from typing import Any
from xml.etree.ElementTree import fromstring

import pytest

from sleec_runtime.model import Ruleset, Source
from sleec_verify.report import FORMATS
from tests.support.cli import Cli
from tests.support.schemas import validator

GOOD = "WHEN A THEN B\n"
BETTER = "WHEN A THEN C\n"
FILES = {"bad.sleec": GOOD, "good.sleec": GOOD}

PARSING = "sleec_runtime.language.parse_english"
CHECKING = "sleec_verify.checks.run_checks"


def _path(argument: object) -> str:
    if isinstance(argument, Ruleset):
        argument = argument.source
    return argument.path if isinstance(argument, Source) else ""


@pytest.fixture
def fail_in(monkeypatch: pytest.MonkeyPatch) -> Callable[[str], None]:
    """Makes a function fail where it is given the ruleset, or the text, of a file whose name has `bad` in it."""

    def patch(target: str) -> None:
        module, _, name = target.rpartition(".")
        function = getattr(__import__(module, fromlist=[name]), name)

        @wraps(function)
        def failing(*arguments: Any, **others: Any) -> Any:
            if any("bad" in _path(argument) for argument in arguments):
                raise ZeroDivisionError("the mistake")
            return function(*arguments, **others)

        monkeypatch.setattr(target, failing)

    return patch


def validate(schema: str, text: str) -> Any:
    found = json.loads(text)
    validator(schema).validate(found)
    return found


@pytest.mark.parametrize("target", [PARSING, CHECKING])
@pytest.mark.parametrize("form", FORMATS)
def test_check_reports_the_other_files(form: str, target: str, cli: Cli, fail_in: Callable[[str], None]) -> None:
    fail_in(target)
    ran = cli("check", ".", "--format", form, files=FILES)
    assert ran.code == 2
    assert "internal error in ./bad.sleec: ZeroDivisionError: the mistake" in ran.err
    assert "fault in sleec-verify" in ran.err
    if form == "json":
        bad, good = validate("check", ran.out)["rulesets"]
        assert bad["path"] == "./bad.sleec"
        assert "ZeroDivisionError" in bad["error"]["message"]
        assert good["checks"]
    elif form == "junit":
        bad, good = fromstring(ran.out)
        assert (bad.get("name"), bad.get("errors"), good.get("errors")) == ("bad.sleec", "1", "0")
    else:
        assert "internal error" in ran.out
        assert "bad.sleec" in ran.out


def test_check_writes_the_report_to_a_file(cli: Cli, tmp_path: Path, fail_in: Callable[[str], None]) -> None:
    fail_in(CHECKING)
    assert cli("check", ".", "--format", "json", "-o", "report.json", files=FILES).code == 2
    assert len(validate("check", (tmp_path / "report.json").read_text(encoding="utf-8"))["rulesets"]) == 2


@pytest.mark.parametrize("mode", ["--check", "--diff", "--write"])
@pytest.mark.parametrize("target", [PARSING, "sleec_verify.cli.fmt.print_ruleset"])
def test_fmt_lays_out_the_other_files(
    mode: str, target: str, cli: Cli, tmp_path: Path, fail_in: Callable[[str], None]
) -> None:
    fail_in(target)
    untidy = "WHEN A   THEN B\n"
    ran = cli("fmt", mode, ".", files=dict.fromkeys(FILES, untidy))
    assert ran.code == 2
    assert "internal error in ./bad.sleec" in ran.err
    assert "1 unusable" in ran.err
    assert (tmp_path / "bad.sleec").read_text(encoding="utf-8") == untidy
    assert ((tmp_path / "good.sleec").read_text(encoding="utf-8") != untidy) == (mode == "--write")


def test_fmt_lays_out_the_other_files_where_one_cannot_be_written(
    cli: Cli, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    replace = __import__("os").replace

    def refuse(source: str, target: str) -> None:
        if "bad" in target:
            raise PermissionError(13, "Permission denied")
        replace(source, target)

    monkeypatch.setattr("os.replace", refuse)
    ran = cli("fmt", "--write", ".", files=dict.fromkeys(FILES, "WHEN A   THEN B\n"))
    assert ran.code == 2
    assert "bad.sleec cannot be written" in ran.err
    assert (tmp_path / "good.sleec").read_text(encoding="utf-8") == GOOD


@pytest.mark.parametrize("target", [PARSING, "sleec_verify.changes.compare.compare"])
@pytest.mark.parametrize("form", ["full", "concise", "json"])
def test_diff_compares_the_other_files(form: str, target: str, cli: Cli, fail_in: Callable[[str], None]) -> None:
    fail_in(target)
    files = {f"{side}/{name}": text for side, text in (("old", GOOD), ("new", BETTER)) for name in FILES}
    ran = cli("diff", "old", "new", "--format", form, "--assert", "never B when A", files=files)
    assert ran.code == 2
    assert "bad.sleec: ZeroDivisionError" in ran.err
    assert "internal error in" in ran.err
    if form == "json":
        bad, good = validate("diff", ran.out)["rulesets"]
        assert (bad["path"], good["path"]) == ("bad.sleec", "good.sleec")
        assert bad["errors"]
        assert good["relation"] == "incomparable"
    else:
        assert "good.sleec" in ran.out


def test_diff_asks_the_other_files(cli: Cli, fail_in: Callable[[str], None]) -> None:
    fail_in("sleec_verify.changes.assertions.verification.verify")
    files = {f"{side}/{name}": GOOD for side in ("old", "new") for name in FILES}
    ran = cli("diff", "old", "new", "--format", "json", "--assert", "never B when A", files=files)
    assert ran.code == 2
    found = validate("diff", ran.out)
    assert [one["ruleset"] for one in found["assertions"]] == ["new/good.sleec"]
    assert "errors" in found["rulesets"][0]


@pytest.fixture
def repository(tmp_path: Path) -> None:
    (tmp_path / "sleec-verify.toml").write_text('rulesets = ["."]\nbase = "HEAD"\n', encoding="utf-8")
    for name in FILES:
        (tmp_path / name).write_text(GOOD, encoding="utf-8")
    for command in (["init", "-q"], ["add", "."], ["commit", "-qm", "base"]):
        identity = ["-c", "user.name=a", "-c", "user.email=a@b"]
        subprocess.run(["git", *identity, *command], cwd=tmp_path, check=True)


@pytest.mark.usefixtures("repository")
@pytest.mark.parametrize(
    "target",
    [
        PARSING,
        CHECKING,
        "sleec_verify.changes.gate.examination.compare",
        "sleec_verify.changes.assertions.verification.verify",
    ],
)
@pytest.mark.parametrize("form", FORMATS)
def test_gate_judges_the_other_files(form: str, target: str, cli: Cli, fail_in: Callable[[str], None]) -> None:
    fail_in(target)
    ran = cli("gate", "--format", form, "--assert", "never B when A", files=dict.fromkeys(FILES, BETTER))
    assert ran.code == 2
    assert "internal error in bad.sleec: ZeroDivisionError" in ran.err
    if form == "json":
        bad, good = validate("gate", ran.out)["rulesets"]
        assert len(bad["errors"]) == 1
        assert good["errors"] == []
        assert good["relation"] == "incomparable"
    else:
        assert "bad.sleec" in ran.out


@pytest.mark.usefixtures("repository")
def test_a_baseline_is_not_written_and_the_file_named(cli: Cli, tmp_path: Path, fail_in: Callable[[str], None]) -> None:
    fail_in(CHECKING)
    ran = cli("gate", "--write-baseline", "--baseline", "known.txt")
    assert ran.code == 2
    assert "internal error in bad.sleec: ZeroDivisionError" in ran.err
    assert not (tmp_path / "known.txt").exists()


ROBOT = """
import sleec_runtime

sleec = sleec_runtime.load("good.sleec")
sleec.implement({"B": print})
"""


@pytest.mark.parametrize("form", FORMATS)
@pytest.mark.parametrize(
    "target",
    [
        PARSING,
        "sleec_verify.conformance.structure.target._source",
        "sleec_verify.conformance.structure.check.findings_on",
    ],
)
def test_conform_writes_a_report(form: str, target: str, cli: Cli, monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(*_: object) -> None:
        raise ZeroDivisionError("the mistake")

    monkeypatch.setattr(target, fail)
    ran = cli("conform", "robot.py", "--ruleset", "good.sleec", "--format", form, files={**FILES, "robot.py": ROBOT})
    name = "good.sleec" if target == PARSING else "robot.py"
    assert ran.code == 2
    assert f"internal error in {name}: ZeroDivisionError: the mistake" in ran.err
    if form == "json":
        (one,) = validate("check", ran.out)["rulesets"]
        assert one["path"] == name
    elif form == "junit":
        assert fromstring(ran.out).get("errors") == "1"
    assert name in ran.out


@pytest.mark.parametrize(
    "command", ["convert --to english", "compile --to json", "cases", "entail --when A", "explain"]
)
def test_commands_on_one_file_name_it(command: str, cli: Cli, fail_in: Callable[[str], None]) -> None:
    fail_in(PARSING)
    name, *options = command.split()
    ran = cli(name, "bad.sleec", *options, files=FILES)
    assert (ran.code, ran.out) == (2, "")
    assert "internal error in bad.sleec: ZeroDivisionError: the mistake" in ran.err


def test_the_traceback_is_shown_on_demand(cli: Cli, fail_in: Callable[[str], None]) -> None:
    fail_in(CHECKING)
    ran = cli("--traceback", "check", ".", "--format", "json", files=FILES)
    assert ran.code == 2
    assert "Traceback" in ran.err
    assert len(json.loads(ran.out)["rulesets"]) == 2
