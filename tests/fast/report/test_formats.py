"""The formats that other programs read: valid, complete, the same on standard output and in a file, and no unknown
verdict is fine in any of them. What JSON looks like is in test_json."""

from __future__ import annotations

import json
import os
import re
import shlex
import xml.etree.ElementTree as ET
from collections.abc import Callable
from pathlib import Path
from typing import Any
from urllib.parse import unquote

import jsonschema
import pytest

from sleec_runtime.language import load, parse
from sleec_runtime.model import Ruleset, Span
from sleec_verify.checks import CHECKS, run_checks
from sleec_verify.report import FORMATS, renderer
from sleec_verify.report.flow import steps
from sleec_verify.report.outcome import CheckedRuleset
from sleec_verify.report.palette import PLAIN
from sleec_verify.results.finding import SEVERITIES, CheckResult, Finding, Proved, Refuted, Unknown, Witness
from tests.fast.cli import test_documents as documents
from tests.support.cli import Cli
from tests.support.paths import ROOT

RULESETS = sorted((ROOT / "rulesets").glob("*.sleec"))
CLEAN = "WHEN Rung THEN OpenDoor\nUNLESS Night IN WHICH CASE AskWho\n"
CLASH = """\
MEASURE Pain: number
RULE one
WHEN Rung THEN Open
UNLESS Night AND Pain > 0.5 IN WHICH CASE Ask
RULE two
WHEN Storm AND Awake THEN NOT Open
"""
BROKEN = "RULE one\nWHEN Rung THEN\n"
TIMED = "WHEN Rung THEN Open WITHIN 5 minutes\nRULE late\nWHEN Rung AND Night THEN NOT Open WITHIN 10 minutes\n"
COMMAND = re.compile(r"::(error|warning|notice) ([^:]*)::(.*)")

SARIF = json.loads((ROOT / "tests" / "support" / "standards" / "sarif-2.1.0.json").read_text(encoding="utf-8"))
VALIDATOR = jsonschema.validators.validator_for(SARIF)(SARIF)


def shown(form: str, *outcomes: Any) -> str:
    return "".join(renderer(form)(outcomes, PLAIN))


def checked_text(text: str, path: str = "a.sleec", realizable: int | None = None) -> CheckedRuleset:
    ruleset = parse(text, path)
    return CheckedRuleset(ruleset, run_checks(ruleset, realizable=realizable))


def sarif(*outcomes: Any) -> dict[str, Any]:
    """The run of a log, after it was held against the schema."""
    log = json.loads(shown("sarif", *outcomes))
    VALIDATOR.validate(log)
    (run,) = log["runs"]
    assert isinstance(run, dict)
    return run


def commands_in(text: str) -> list[tuple[str, dict[str, str], str]]:
    """The workflow commands as GitHub reads them: split at commas and colons first, unescaped then."""

    def unescaped(value: str) -> str:
        for code, character in (("%3A", ":"), ("%2C", ","), ("%0D", "\r"), ("%0A", "\n"), ("%25", "%")):
            value = value.replace(code, character)
        return value

    found = []
    for line in text.splitlines():
        match = COMMAND.fullmatch(line)
        if match:
            pairs = (pair.split("=", 1) for pair in match[2].split(","))
            found.append((match[1], {name: unescaped(value) for name, value in pairs}, unescaped(match[3])))
    return found


# The exit codes, one by one, in each format; and the same bytes in a file ----------------------------------


def give_up(ruleset: Ruleset, *_: object, **__: object) -> tuple[CheckResult, ...]:
    return (CheckResult("conflict", Unknown("the solver gave up"), 0.5), CheckResult("dead-rule", Proved(), 0.1))


ENDS = {0: CLEAN, 1: CLASH, 2: BROKEN, 3: CLEAN}


def is_complete(form: str, text: str, code: int) -> None:
    """What the format must hold for this exit code, and that it is of the format at all."""
    if form == "sarif":
        log = json.loads(text)
        VALIDATOR.validate(log)
        (run,) = log["runs"]
        kinds = [result["kind"] for result in run["results"]]
        assert ("fail" in kinds, "open" in kinds) == (code == 1, code == 3)
        (invocation,) = run["invocations"]
        assert invocation["executionSuccessful"] == (code in (0, 1))
        levels = [told["level"] for told in invocation["toolExecutionNotifications"]]
        assert levels == (["error"] if code in (2, 3) else [])
    elif form == "junit":
        root = ET.fromstring(text)
        assert (root.find(".//failure") is not None, root.find(".//error") is not None) == (code == 1, code in (2, 3))
        assert int(root.get("failures", "")) + int(root.get("errors", "")) == (0 if code == 0 else 1)
    elif form == "github":
        assert [kind for kind, _, _ in commands_in(text)] == ([] if code == 0 else ["error"])
    elif form == "gitlab":
        severities = [issue["severity"] for issue in json.loads(text)]
        assert severities == {0: [], 1: ["critical"], 2: ["blocker"], 3: ["critical"]}[code]
    elif form == "json":
        assert json.loads(text)["rulesets"]
    else:  # of what cannot be read, "full" tells on standard error only
        assert text.endswith("\n") or (form, code) == ("full", 2)


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


# SARIF -----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("path", RULESETS, ids=lambda path: path.stem)
def test_sarif_of_the_shipped_rulesets_is_valid(path: Path) -> None:
    ruleset = load(path)
    outcome = CheckedRuleset(ruleset, run_checks(ruleset))
    run = sarif(outcome)
    assert [r["ruleId"] for r in run["results"]] == [f.code for f in outcome.findings]
    for result in run["results"]:
        assert run["tool"]["driver"]["rules"][result["ruleIndex"]]["id"] == result["ruleId"]


BAD = {kind.code: kind.bad for check in CHECKS.values() for kind in check.kinds}


@pytest.mark.parametrize("code", BAD)
def test_sarif_of_every_bad_example_is_valid(code: str) -> None:
    outcome = checked_text(BAD[code], realizable=1)
    results = [result for result in sarif(outcome)["results"] if result["ruleId"] == code]
    assert results
    severities = {finding.severity for finding in outcome.findings if finding.code == code}
    assert {result["level"] for result in results} == severities <= set(SEVERITIES)


def words_at(text: str, location: dict[str, Any]) -> str:
    """What stands at a location, by its lines and columns."""
    region = location["physicalLocation"]["region"]
    lines = text.split("\n")[region["startLine"] - 1 : region["endLine"]]
    lines[-1] = lines[-1][: region["endColumn"] - 1]
    lines[0] = lines[0][region["startColumn"] - 1 :]
    return "\n".join(lines)


def test_code_flow_leads_from_the_situation_to_the_conflict() -> None:
    text = CLASH.replace("Open\n", "Open\nUNLESS Away IN WHICH CASE Wait\n", 1)
    (conflict,) = [r for r in sarif(checked_text(text))["results"] if r["ruleId"] == "SLEEC101"]
    ((flow,),) = (f["threadFlows"] for f in conflict["codeFlows"])
    way = [(step["location"]["message"]["text"], words_at(text, step["location"])) for step in flow["locations"]]
    assert way[:2] == [("`Rung` occurs", "Rung"), ("`Storm` occurs", "Storm")]
    assert set(way[2:-3]) >= {("`Away` is false", "Away"), ("`Awake` is true", "Awake")}
    assert way[-3:-1] == [
        ("rule `one`: `Open`", "WHEN Rung THEN Open"),
        ("rule `two`: `NOT Open`", "WHEN Storm AND Awake THEN NOT Open"),
    ]
    assert way[-1][0] == conflict["message"]["text"].split("\n")[0]
    assert flow["locations"][0]["state"] == {"Rung": {"text": "true"}}
    (related,) = conflict["relatedLocations"]
    assert words_at(text, related) == "WHEN Storm AND Awake THEN NOT Open"


@pytest.mark.parametrize("path", RULESETS, ids=lambda path: path.stem)
def test_every_witness_has_a_flow_that_names_all_of_it(path: Path) -> None:
    ruleset = load(path)
    for finding in CheckedRuleset(ruleset, run_checks(ruleset)).findings:
        way = steps(ruleset, finding)
        assert bool(way) == (finding.witness is not None)
        if finding.witness is not None:
            states = {name: value for step in way for name, value in step.state.items()}
            assert states == {**dict.fromkeys(finding.witness.triggers, True), **finding.witness.conditions}
            assert {(c.rule, c.clause) for c in finding.clauses} <= {
                (label, number)
                for label, rule in ruleset.by_label.items()
                for number, clause in enumerate(rule.clauses())
                if any(step.span == clause.span for step in way)
            }


def test_flow_of_a_course_of_events_follows_its_moments() -> None:
    outcome = checked_text(TIMED)
    conflict = next(r for r in sarif(outcome)["results"] if r["ruleId"] == "SLEEC101")
    ((flow,),) = (f["threadFlows"] for f in conflict["codeFlows"])
    orders = [step["executionOrder"] for step in flow["locations"]]
    assert orders == sorted(orders)
    told = [step["location"]["message"]["text"] for step in flow["locations"]]
    assert "at first, `Rung` occurs" in told
    assert "at first, `Night` is true" in told
    assert any("`late` forbids `Open" in text for text in told)


def test_a_name_that_only_a_constraint_knows_stands_there() -> None:
    text = "CONDITION Night\nNEVER Open AND Night\nWHEN Rung THEN Open\n"
    (conflict,) = [r for r in sarif(checked_text(text))["results"] if r["ruleId"] == "SLEEC101"]
    ((flow,),) = (f["threadFlows"] for f in conflict["codeFlows"])
    at = {step["location"]["message"]["text"]: words_at(text, step["location"]) for step in flow["locations"]}
    assert at["`Night` is true"] == "Night"


def test_a_name_that_stands_nowhere_is_told_at_the_finding() -> None:
    ruleset = parse(CLEAN, "a.sleec")
    witness = Witness(("Flood",), {"Night": True})
    finding = Finding("conflict", "SLEEC101", "error", "m", Span(0, 4), ("rule_1", "gone"), witness=witness)
    way = [(step.words, step.span) for step in steps(ruleset, finding)]
    night = CLEAN.index("Night")
    assert way == [
        ("`Flood` occurs", Span(0, 4)),
        ("`Night` is true", Span(night, night + 5)),
        ("m", Span(0, 4)),
    ]


def test_flow_from_a_clause_to_the_code_that_departs_from_it(cli: Cli) -> None:
    robot = (ROOT / "examples" / "household_robot.py").read_text(encoding="utf-8")
    assert "self.explain_why()" in robot
    rules = (ROOT / "rulesets" / "household.sleec").read_text(encoding="utf-8")
    files = {"robot.py": robot.replace("self.explain_why()", "pass"), "rulesets/household.sleec": rules}
    ran = cli("conform", "robot.py", "--ruleset", "rulesets/household.sleec", "--format", "sarif", files=files)
    log = json.loads(ran.out)
    VALIDATOR.validate(log)
    result = next(r for r in log["runs"][0]["results"] if "codeFlows" in r)
    first, *_, last = result["codeFlows"][0]["threadFlows"][0]["locations"]
    uris = [step["location"]["physicalLocation"]["artifactLocation"]["uri"] for step in (first, last)]
    assert uris == ["rulesets/household.sleec", "robot.py"]
    assert "dress_assist" in first["location"]["message"]["text"]


DOCUMENTS = sorted((ROOT / "tests").rglob("documents/**/*.txt"))


@pytest.mark.parametrize("path", DOCUMENTS, ids=lambda path: f"{path.parent.name}/{path.stem}")
def test_what_the_documents_show_can_be_said_in_every_format(path: Path, cli: Cli) -> None:
    _, files, given = documents.parse(path.read_text(encoding="utf-8"))
    commands = [shlex.split(step.command)[1:] for step in given]
    for step, command in zip(given, commands):
        if command[0] not in ("check", "conform") or (step.code == 2 and "--format" not in command):
            continue
        line = [word for word in command if word not in ("--format", *FORMATS)]
        for form in ("sarif", "junit", "github", "gitlab"):
            ran = cli(*line, "--format", form, files=files)
            assert ran.code == step.code
            if form == "sarif":
                VALIDATOR.validate(json.loads(ran.out))
            elif form == "junit":
                ET.fromstring(ran.out)
            elif form == "gitlab":
                assert all(issue["location"]["lines"]["begin"] >= 1 for issue in json.loads(ran.out))


def test_braces_are_doubled_in_sarif() -> None:
    ruleset = parse(CLEAN, "a.sleec")
    finding = Finding("conflict", "SLEEC101", "error", "at {0}", Span(0, 4))
    run = sarif(CheckedRuleset(ruleset, (CheckResult("conflict", Refuted((finding,)), 0.0),)))
    assert run["results"][0]["message"]["text"] == "at {{0}}"


# JUnit -----------------------------------------------------------------------------------------------------


def test_junit_has_a_suite_a_ruleset_and_a_case_a_check(cli: Cli) -> None:
    files = {"clash.sleec": CLASH, "clean.sleec": CLEAN, "broken.sleec": BROKEN}
    root = ET.fromstring(cli("check", ".", "--format", "junit", files=files).out)
    suites = {suite.get("name"): suite for suite in root}
    assert list(suites) == ["broken.sleec", "clash.sleec", "clean.sleec"]
    names = [case.get("name") for case in suites["clean.sleec"]]
    assert names == [result.name for result in run_checks(parse(CLEAN))]
    (case,) = (case for case in suites["clash.sleec"] if case.find("failure") is not None)
    failure = case.find("failure")
    assert failure is not None
    assert (case.get("name"), failure.get("type")) == ("conflict", "error")
    assert "situation: When `Rung` and `Storm` occur" in (failure.text or "")
    (error,) = suites["broken.sleec"].iter("error")
    assert error.get("type") == "unusable"
    assert "broken.sleec:2:" in (error.text or "")
    totals = [sum(int(suite.get(key, "")) for suite in root) for key in ("tests", "failures", "errors")]
    assert [int(root.get(key, "")) for key in ("tests", "failures", "errors")] == totals
    assert totals[1:] == [1, 1]


def test_a_warning_fails_its_case_too() -> None:
    dead = "WHEN Rung THEN Open\nUNLESS Night AND NOT Night IN WHICH CASE Ask\n"
    root = ET.fromstring(shown("junit", checked_text(dead)))
    types = {case.get("name"): case[0].get("type") for case in root.iter("testcase") if len(case)}
    assert types["dead-hedge"] == "warning"


def test_junit_holds_what_xml_cannot() -> None:
    ruleset = parse(CLEAN, 'a\x01\udcff<&">.sleec')
    finding = Finding("conflict", "SLEEC101", "error", 'a\x00b <&"> \ufffe \u00e4 窓', Span(0, 4))
    results = (CheckResult("conflict", Refuted((finding,)), 0.0), *give_up(ruleset))
    text = shown("junit", CheckedRuleset(ruleset, results))
    assert text.isascii()
    failure = ET.fromstring(text).find(".//failure")
    assert failure is not None
    assert failure.get("message") == 'a\\x00b <&"> \\ufffe ä 窓'


# GitHub ----------------------------------------------------------------------------------------------------


def test_annotations_name_file_line_and_columns() -> None:
    ((kind, where, message),) = commands_in(shown("github", checked_text(CLASH, "./rules/a.sleec")))
    assert kind == "error"
    assert where == {
        "file": "rules/a.sleec",
        "line": "3",
        "endLine": "3",
        "col": "1",
        "endColumn": "20",
        "title": "SLEEC101 conflict",
    }
    assert message.splitlines()[1].startswith("situation: When `Rung` and `Storm` occur")


def test_what_spans_lines_has_no_columns() -> None:
    text = shown("github", checked_text(CLASH.replace("Rung THEN Open", "Rung\n  THEN Open")))
    spans = [where for _, where, _ in commands_in(text) if where["line"] != where["endLine"]]
    assert spans
    assert not any("col" in where for where in spans)


def test_nothing_in_a_message_or_name_starts_a_command() -> None:
    evil = "a,line=1::b%0A\r\n::error::x:.sleec"
    ruleset = parse(CLEAN, evil)
    finding = Finding("conflict", "SLEEC101", "error", "100%\n::stop-commands::x\r%0A", Span(0, 4))
    text = shown(
        "github", CheckedRuleset(ruleset, (CheckResult("conflict", Refuted((finding,)), 0.0), *give_up(ruleset)))
    )
    assert sum(line.startswith("::") for line in text.splitlines()) == 2
    found, unknown = commands_in(text)
    assert found[1]["file"] == unknown[1]["file"] == evil
    assert found[2] == finding.message
    assert unknown[0] == "error"


# GitLab and fingerprints -----------------------------------------------------------------------------------


def fingerprints(text: str, path: str = "a.sleec") -> list[str]:
    outcome = checked_text(text, path)
    gitlab = [issue["fingerprint"] for issue in json.loads(shown("gitlab", outcome))]
    of_sarif = [result["partialFingerprints"]["sleecFinding/v1"] for result in sarif(outcome)["results"]]
    assert gitlab == of_sarif
    return gitlab


MANY = CLASH + "EXCLUSIVE Ask, Wave\nRULE three\nWHEN Rung THEN Wave\nUNLESS Calm AND NOT Calm IN WHICH CASE Sit\n"


def test_gitlab_issues_have_what_gitlab_reads() -> None:
    issues = json.loads(shown("gitlab", checked_text(MANY, "./a.sleec")))
    assert len(issues) > 2
    for issue in issues:
        assert set(issue) == {"description", "check_name", "fingerprint", "severity", "location"}
        assert issue["severity"] in ("info", "minor", "major", "critical", "blocker")
        assert issue["location"]["path"] == "a.sleec"
        assert issue["location"]["lines"]["begin"] >= 1


@pytest.mark.parametrize(
    "moved",
    [
        lambda text: "\n\n// a comment\n\n" + text,
        lambda text: text.replace("RULE two", "\n\nRULE two"),
        lambda text: "WHEN Knocked THEN Listen\n" + text,
        lambda text: text.replace("WHEN Rung THEN Open", "WHEN   Rung\n  THEN Open"),
    ],
)
def test_fingerprints_stay_where_lines_move(moved: Callable[[str], str]) -> None:
    assert set(fingerprints(MANY)) == set(fingerprints(moved(MANY)))


def test_fingerprints_stay_where_labels_are_numbers() -> None:
    unlabelled = "WHEN Rung THEN Open\nWHEN Storm THEN NOT Open\n"
    assert fingerprints(unlabelled) == fingerprints("WHEN Knocked THEN Listen\n" + unlabelled)


def test_fingerprints_differ_where_findings_do() -> None:
    found = fingerprints(MANY)
    assert len(set(found)) == len(found)
    assert set(found).isdisjoint(fingerprints(MANY, "b.sleec"))
    twice = "WHEN Rung THEN Open\nWHEN Storm THEN NOT Open\n"
    same = fingerprints(twice + "DOMAIN home\n" + twice)
    assert len(set(same)) == len(same)


# Paths -----------------------------------------------------------------------------------------------------


def test_paths_are_those_of_the_project(cli: Cli, tmp_path: Path) -> None:
    inside, outside = str(tmp_path / "rules" / "a b.sleec"), str(ROOT / "rulesets" / "night-watch.sleec")
    ran = cli("check", inside, outside, "--format", "sarif", files={"rules/a b.sleec": CLASH})
    VALIDATOR.validate(json.loads(ran.out))
    artifacts = [a["location"]["uri"] for a in json.loads(ran.out)["runs"][0]["artifacts"]]
    assert artifacts == ["rules/a%20b.sleec", f"file://{outside}"]
    issues = json.loads(cli("check", inside, "--format", "gitlab").out)
    assert {issue["location"]["path"] for issue in issues} == {"rules/a b.sleec"}


@pytest.mark.parametrize("form", FORMATS)
def test_a_name_that_is_no_text(form: str, cli: Cli, tmp_path: Path) -> None:
    try:
        (tmp_path / os.fsdecode(b"\xff.sleec")).write_text(CLASH)
    except OSError:
        pytest.skip("this file system has names in UTF-8 only")
    ran = cli("check", ".", "--format", form, "-o", "report")
    assert ran.code == 1
    written = (tmp_path / "report").read_bytes()
    if form == "sarif":
        log = json.loads(written)
        VALIDATOR.validate(log)
        uri = log["runs"][0]["artifacts"][0]["location"]["uri"]
        assert unquote(uri, errors="surrogateescape") == os.fsdecode(b"\xff.sleec")
    elif form == "junit":
        ET.fromstring(written)


def test_a_problem_without_a_place_is_told_in_every_format(cli: Cli) -> None:
    for form in FORMATS:
        ran = cli("check", "missing.sleec", "--format", form)
        assert ran.code == 2
        if form not in ("full", "concise"):
            assert "missing.sleec" in ran.out
            is_complete(form, ran.out, 2)
