"""SARIF, held against the schema of the standard."""

from __future__ import annotations

import json
import shlex
import xml.etree.ElementTree as ET
from pathlib import Path
from typing import Any

import pytest

from sleec_runtime.language import load, parse
from sleec_runtime.model import Span
from sleec_verify.checks import CHECKS, run_checks
from sleec_verify.report import FORMATS
from sleec_verify.report.flow import steps
from sleec_verify.report.outcome import CheckedRuleset
from sleec_verify.results.finding import SEVERITIES, CheckResult, Finding, Refuted, Witness
from tests.fast.cli import test_documents as documents
from tests.support.cli import Cli
from tests.support.formats import CLASH, CLEAN, VALIDATOR, checked_text, sarif
from tests.support.paths import ROOT

RULESETS = sorted((ROOT / "rulesets").glob("*.sleec"))
TIMED = "WHEN Rung THEN Open WITHIN 5 minutes\nRULE late\nWHEN Rung AND Night THEN NOT Open WITHIN 10 minutes\n"


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
