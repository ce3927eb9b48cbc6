"""`gate` in every format of `check`: the same verdicts and exit codes, and whatever blocks is in each report."""

from __future__ import annotations

import json
import os
import re
import shutil
import signal
import subprocess
import sys
import time
import xml.etree.ElementTree as ET
from pathlib import Path
from typing import Any

import pytest

from sleec_verify.report import FORMATS
from tests.support.cli import Cli
from tests.support.formats import VALIDATOR, commands_in
from tests.support.gates import BOTH, CLASH, DEAD, LOST, OLD, TIMED, TIMED_ELSE, config, with_fingerprints
from tests.support.paths import ROOT
from tests.support.repository import Repository

pytestmark = pytest.mark.skipif(shutil.which("git") is None, reason="git is not installed")
PROGRAMS = ("sarif", "junit", "github", "gitlab")


@pytest.fixture
def repository(tmp_path: Path) -> Repository:
    made = Repository(tmp_path)
    made.commit(a_sleec=OLD)
    return made


def told(form: str, text: str) -> list[tuple[str, str, str]]:
    """What a report says is wrong, each as what it is called, its path and its message. What must hold of the format
    is checked besides."""
    if form == "sarif":
        log = json.loads(text)
        VALIDATOR.validate(log)
        (run,) = log["runs"]
        results = run["results"]
        rules = run["tool"]["driver"]["rules"]
        assert all(rules[result["ruleIndex"]]["id"] == result["ruleId"] for result in results)
        assert len({rule["id"] for rule in rules}) == len(rules)
        found = [(r["ruleId"], r["locations"][0]["physicalLocation"], r["message"]["text"]) for r in results]
        for notification in run["invocations"][0]["toolExecutionNotifications"]:
            if "is unknown" not in notification["message"]["text"]:
                found.append(("", notification["locations"][0]["physicalLocation"], notification["message"]["text"]))
        return [(code, place["artifactLocation"]["uri"], message) for code, place, message in found]
    if form == "junit":
        cases = ET.fromstring(text).iter("testcase")
        return [
            (str(case.get("name")), str(case.get("classname")), f"{wrong.get('message')} {wrong.text}")
            for case in cases
            for wrong in case
            if wrong.tag in ("failure", "error")
        ]
    if form == "github":
        return [(said["title"], said["file"], message) for _, said, message in commands_in(text)]
    issues = json.loads(text)
    return [(one["check_name"], one["location"]["path"], one["description"]) for one in issues]


def one_report(cli: Cli, form: str, code: int, *arguments: str) -> list[tuple[str, str, str]]:
    ran = cli("gate", "--base", "main", "--format", form, *arguments)
    assert ran.code == code, ran
    return told(form, ran.out)


POLICIES: dict[str, tuple[str | None, str, str]] = {
    "new-conflicts": (CLASH, "findings = 'never'", "a and b now contradict each other about o"),
    "lost-obligations": (LOST, "lost-obligations = ['p']", "rule `a` no longer requires `p`"),
    "lost-obligations of a file that is gone": (None, "lost-obligations = ['p']", "rule `a` no longer requires `p`"),
    "SLEEC202": (DEAD, "dead-hedges = true", "the exception `UNLESS NOT c` of rule `a`"),
    "SLEEC101": (CLASH, "new-conflicts = false", "contradict each other"),
    "clause-coverage": (LOST, "clause-coverage = 50", "the cases cover 0 of 1 clauses"),
    "certificates": (LOST, "certificates = true", "the certificate a.certificate is missing"),
    "suppressions": ("# sleec: allow SLEEC101\n" + OLD, "", "a suppression needs a reason"),
    "unused-suppressions": (
        "# sleec: allow SLEEC101 because of history\n" + OLD,
        "unused-suppressions = true",
        "there is no such finding",
    ),
}


@pytest.mark.parametrize("form", PROGRAMS)
@pytest.mark.parametrize("policy", POLICIES)
def test_whatever_blocks_is_told(form: str, policy: str, cli: Cli, repository: Repository) -> None:
    text, block, message = POLICIES[policy]
    repository.write(a_sleec=text)
    config(repository, block=block)
    found = one_report(cli, form, 1)
    code = policy.partition(" ")[0]
    called = [one for one in found if code in one[0] or (code.startswith("SLEEC") and code in one[2])]
    assert {path for _, path, _ in called} == {"a.sleec"}
    assert any(message in words for _, _, words in called), found


REASONS: dict[str, tuple[str | None, str]] = {
    "a conflict": (CLASH, ""),
    "a dead hedge, which is redundant, too": (DEAD, "findings = 'note'"),
    "a dead rule, which is redundant, too": (OLD + "RULE b\nWHEN u AND d AND NOT d THEN o\n", "findings = 'note'"),
    "several": (CLASH + "UNLESS false IN WHICH CASE q\n", "findings = 'note'\nlost-obligations = ['*']"),
    "a file that is gone": (None, "lost-obligations = ['*']"),
    "suppressions that are unused": (
        "# sleec: allow SLEEC101, SLEEC501 because of history\n" + OLD,
        "unused-suppressions = true\nfindings = 'note'",
    ),
}


@pytest.mark.parametrize("name", REASONS)
def test_as_many_reasons_are_counted_as_are_shown(name: str, cli: Cli, repository: Repository) -> None:
    text, block = REASONS[name]
    repository.write(a_sleec=text)
    config(repository, block=block)

    def gate(form: str, *arguments: str) -> str:
        ran = cli("gate", "--base", "main", "--format", form, "--summary", "out.md", *arguments)
        assert ran.code == 1, ran
        return ran.err or ran.out

    full = gate("full")
    reasons = full.count("\nblocks: ") + full.startswith("blocks: ")
    assert reasons >= 1
    word = "1 reason to block" if reasons == 1 else f"{reasons} reasons to block"
    for said in (full, gate("concise"), gate("github"), gate("sarif", "-o", "report")):
        assert said.splitlines()[-1].endswith(f"; {word}")
    summary = (repository.folder / "out.md").read_text(encoding="utf-8")
    assert f"; {word}." in summary
    assert summary.partition("### Reasons to block")[2].partition("|")[0].count("\n- **") == reasons
    assert len(re.findall(r"^a\.sleec:\d+:\d+: ", gate("concise"), re.M)) == reasons
    assert len(commands_in(gate("github"))) == reasons
    assert len(json.loads(gate("json"))["blocks"]) == reasons


@pytest.mark.parametrize("form", FORMATS)
@pytest.mark.parametrize("policy", POLICIES)
def test_no_title_says_a_name_twice(form: str, policy: str, cli: Cli, repository: Repository) -> None:
    text, block, _ = POLICIES[policy]
    repository.write(a_sleec=text)
    config(repository, block=block)
    ran = cli("gate", "--base", "main", "--format", form, "--summary", "out.md")
    assert ran.code == 1
    for said in (ran.out, (repository.folder / "out.md").read_text(encoding="utf-8")):
        assert not re.findall(r"\b([\w-]{4,}) \1\b", said)


@pytest.mark.parametrize("form", PROGRAMS)
def test_assertions_are_told(form: str, cli: Cli, repository: Repository) -> None:
    found = one_report(cli, form, 1, "--assert", "never p")
    assert [(path, "never p does not hold" in words) for _, path, words in found] == [("a.sleec", True)]
    assert "assertions" in found[0][0]


@pytest.mark.parametrize("form", PROGRAMS)
def test_what_is_not_decided_is_told(form: str, cli: Cli, repository: Repository) -> None:
    repository.commit(a_sleec=TIMED)
    repository.write(a_sleec=TIMED_ELSE)
    config(repository, block="findings = 'never'")
    found = one_report(cli, form, 3)
    assert any("inconclusive" in words and "nothing bounds a measure" in words for _, _, words in found)


@pytest.mark.parametrize("form", PROGRAMS)
@pytest.mark.parametrize("side", ["now", "before"])
def test_what_cannot_be_read_is_told(form: str, side: str, cli: Cli, repository: Repository) -> None:
    if side == "before":
        repository.commit(a_sleec="WHEN")
    repository.write(a_sleec="WHEN" if side == "now" else OLD)
    found = one_report(cli, form, 2)
    assert [path for _, path, _ in found] == ["a.sleec"]
    assert "trigger" in found[0][2] or "no ruleset" in found[0][2]


@pytest.mark.parametrize("form", PROGRAMS)
def test_what_passes_and_what_is_set_aside_is_not_told(form: str, cli: Cli, repository: Repository) -> None:
    config(repository, 'baseline = "known.json"', block="clause-coverage = 100")
    repository.write(a_sleec=CLASH, a_cases_toml=BOTH)
    assert cli("gate", "--write-baseline").code == 0
    repository.keep("known.json")
    kept = with_fingerprints(CLASH + "# sleec: allow SLEEC202@? because x\nRULE c\nWHEN u THEN x\nUNLESS false\n")
    repository.commit(a_sleec=kept)
    repository.write(a_sleec=kept + "# more\n")
    ran = cli("gate", "--base", "main", "--format", form)
    assert not [one for one in told(form, ran.out) if "SLEEC101" in str(one) or "SLEEC202" in str(one)]


@pytest.mark.parametrize("form", PROGRAMS)
def test_the_code_of_targets_is_told(form: str, cli: Cli, repository: Repository) -> None:
    robot = (ROOT / "examples" / "household_robot.py").read_text(encoding="utf-8")
    rules = (ROOT / "rulesets" / "household.sleec").read_text(encoding="utf-8")
    repository.put("rules/household.sleec", rules)
    repository.put("robot.py", robot)
    repository.commit()
    config(repository, '[[tool.sleec-verify.targets]]\ncode = "robot.py"\nrules = "rules/household.sleec"')
    assert one_report(cli, form, 0) == []
    repository.put("robot.py", robot.replace("self.refuse_request()", "self.open_curtains()", 1))
    found = one_report(cli, form, 1)
    assert found
    if form != "junit":  # its suites are called as the rules are
        assert {path for _, path, _ in found} == {"robot.py"}
    repository.put("robot.py", None)
    assert [path for _, path, _ in one_report(cli, form, 2)] == ["robot.py"]


ENDS: dict[int, tuple[str, str]] = {0: (OLD, OLD + "\n"), 1: (OLD, CLASH), 2: (OLD, "WHEN"), 3: (TIMED, TIMED_ELSE)}


@pytest.mark.parametrize("code", ENDS)
@pytest.mark.parametrize("form", FORMATS)
def test_a_file_holds_what_would_be_printed(form: str, code: int, cli: Cli, repository: Repository) -> None:
    before, now = ENDS[code]
    repository.commit(a_sleec=before)
    repository.write(a_sleec=now)
    config(repository, block="findings = 'never'")
    ran = cli("gate", "--base", "main", "--format", form)
    filed = cli("gate", "--base", "main", "--format", form, "--output", "report")
    assert (ran.code, filed.code, filed.out) == (code, code, "")
    assert "report: " in filed.err
    written = (repository.folder / "report").read_text(encoding="utf-8")
    times = re.compile(r'(time="|"seconds": )[\d.e-]+')
    assert times.sub("", written) == times.sub("", ran.out)
    if form in ("concise", "github"):
        assert written.splitlines()[-1].startswith(("passed", "blocked", "invalid input", "inconclusive"))


# Whole or not at all --------------------------------------------------------------------------------------


@pytest.mark.parametrize("command", ["gate", "check"])
@pytest.mark.parametrize("form", ["sarif", "junit"])
def test_where_a_report_cannot_be_written_nothing_is(
    command: str, form: str, cli: Cli, repository: Repository, monkeypatch: pytest.MonkeyPatch
) -> None:
    repository.write(a_sleec=CLASH)
    line = ["gate", "--base", "main"] if command == "gate" else ["check", "a.sleec"]
    ran = cli(*line, "--format", form, "-o", "nowhere/report")
    assert (ran.code, ran.out) == (2, "")
    assert "the folder nowhere" in ran.err
    ran = cli(*line, "--format", form, "-o", "a.sleec")
    assert (ran.code, ran.out) == (2, "")
    assert (repository.folder / "a.sleec").read_text() == CLASH
    (repository.folder / "report").write_text("of before")

    def refuse(*_: object) -> None:
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr("os.replace", refuse)
    ran = cli(*line, "--format", form, "-o", "report")
    assert (ran.code, ran.out) == (2, "")
    assert "report cannot be written: Permission denied" in ran.err
    assert (repository.folder / "report").read_text() == "of before"
    assert [path.name for path in repository.folder.iterdir() if path.name.endswith(".tmp")] == []


@pytest.mark.skipif(os.name != "posix", reason="signals are those of POSIX")
@pytest.mark.parametrize("command", ["gate", "check"])
def test_who_is_killed_leaves_no_half_report(command: str, repository: Repository) -> None:
    """At moments throughout the run: what was there before stays, or the new one is there whole."""
    rules = "".join(f"RULE r{i}\nWHEN t{i} THEN o{i}\nUNLESS c{i} IN WHICH CASE NOT o{i}\n" for i in range(30))
    repository.write(a_sleec=rules + "RULE x\nWHEN t1 THEN NOT o1\n")
    report = repository.folder / "report.sarif"
    line = ["gate", "--base", "main"] if command == "gate" else ["check", "a.sleec"]
    program = [sys.executable, "-m", "sleec_verify", *line, "--format", "sarif", "-o", "report.sarif"]
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}

    def run(after: float | None) -> bool:
        started = subprocess.Popen(
            program, cwd=repository.folder, env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
        )
        if after is not None:
            time.sleep(after)
            started.send_signal(signal.SIGKILL)
        return started.wait() == 1

    begun = time.perf_counter()
    assert run(None)
    whole = time.perf_counter() - begun
    for part in (0.3, 0.6, 0.8, 0.9, 1.0):
        report.write_text("of before")
        run(part * whole)
        text = report.read_text()
        if text != "of before":
            VALIDATOR.validate(json.loads(text))


def test_a_schema_of_sarif_knows_no_policy_twice(cli: Cli, repository: Repository) -> None:
    """A policy can block a ruleset and be undecided for another; it is described once."""
    repository.write(a_sleec=OLD + "UNLESS d IN WHICH CASE o\n", b_sleec="RULE b\nWHEN c THEN p\n")
    config(repository, block="findings = 'never'")
    log: dict[str, Any] = json.loads(
        cli("gate", "--base", "main", "--assert", "never p when c", "--format", "sarif").out
    )
    VALIDATOR.validate(log)
    identifiers = [rule["id"] for rule in log["runs"][0]["tool"]["driver"]["rules"]]
    assert identifiers.count("assertions") == 1
    assert {result["kind"] for result in log["runs"][0]["results"] if result["ruleId"] == "assertions"} == {
        "fail",
        "open",
    }
