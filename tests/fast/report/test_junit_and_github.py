"""JUnit and the annotations of GitHub."""

from __future__ import annotations

import xml.etree.ElementTree as ET

from sleec_runtime.language import parse
from sleec_runtime.model import Span
from sleec_verify.checks import run_checks
from sleec_verify.report.outcome import CheckedRuleset
from sleec_verify.results.finding import CheckResult, Finding, Refuted
from tests.support.cli import Cli
from tests.support.formats import BROKEN, CLASH, CLEAN, checked_text, commands_in, give_up, shown


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
