"""The pages on rules with time show what the tool says."""

from __future__ import annotations

import re

from sleec_runtime.language import parse
from sleec_verify.checks import run_checks
from sleec_verify.report.full import finding_lines
from sleec_verify.report.palette import PLAIN
from sleec_verify.results.finding import Proved
from tests.support.paths import ROOT

DOCS = ROOT / "docs"


def blocks(page, language):
    return re.findall(rf"```{language}\n(.*?)```", (DOCS / page).read_text(encoding="utf-8"), re.DOTALL)


def conflicts(text):
    ruleset = parse(text)
    (result,) = run_checks(ruleset, ["conflict"])
    return ruleset, result.findings


ROW = re.compile(r"^\| (`A then .*?`|`P then .*?`) \| (none|R\d(?: R\d)*) \|", re.MULTILINE)


def test_the_examples_of_the_definition_have_the_conflicts_of_the_page():
    rows = ROW.findall((DOCS / "times.md").read_text(encoding="utf-8"))
    assert len(rows) == 7
    for rules, expected in rows:
        numbered = [f"R{n} when {rule}" for n, rule in enumerate(re.findall(r"`(.*?)`", rules), 1)]
        events = [f"event {event}" for event in "ABDPTXY"]
        text = "\n".join(["def_start", *events, "def_end", "rule_start", *numbered, "rule_end"])
        found = [set(finding.rules) for finding in conflicts(text)[1]]
        assert found == ([] if expected == "none" else [set(expected.split())]), rules


def is_in(shown, ruleset, finding):
    lines = "\n".join(finding_lines(finding, ruleset.source, PLAIN))
    return re.sub(r"(?m)^ +", "", shown) in re.sub(r"(?m)^ +", "", lines)


def test_the_timeline_of_the_page_is_the_one_that_is_shown():
    text, _ = blocks("times.md", "dsl")
    shown, _ = blocks("times.md", "text")
    ruleset, (finding,) = conflicts(text)
    assert is_in(shown, ruleset, finding)


def test_the_strategy_of_the_page_is_the_one_that_is_shown():
    _, text = blocks("times.md", "dsl")
    _, shown = blocks("times.md", "text")
    ruleset = parse(text)
    (one,) = run_checks(ruleset, (), realizable=1)
    assert isinstance(one.verdict, Proved)
    (two,) = run_checks(ruleset, (), realizable=2)
    (finding,) = two.findings
    assert is_in(shown, ruleset, finding)


def test_the_files_to_try_differ_as_the_page_says():
    (by_relation,) = blocks("from-other-tools.md", "dsl")
    assert {finding.rules for finding in conflicts(by_relation)[1]} == {("R1", "R2")}
