"""The pages on rules with time show what the tool says."""

from __future__ import annotations

import re
from pathlib import Path

from sleec_runtime.language import parse
from sleec_verify.checks import run_checks
from sleec_verify.report.full import finding_lines
from sleec_verify.report.palette import PLAIN

DOCS = Path(__file__).parents[2] / "docs"


def blocks(page, language):
    return re.findall(rf"```{language}\n(.*?)```", (DOCS / page).read_text(encoding="utf-8"), re.DOTALL)


def conflicts(text):
    ruleset = parse(text)
    (result,) = run_checks(ruleset, ["conflict"])
    return ruleset, result.findings


def test_the_timeline_of_the_page_is_the_one_that_is_shown():
    (text,) = blocks("times.md", "dsl")
    (shown,) = blocks("times.md", "text")
    ruleset, (finding,) = conflicts(text)
    lines = "\n".join(finding_lines(finding, ruleset.source, PLAIN))
    assert re.sub(r"(?m)^ +", "", shown) in re.sub(r"(?m)^ +", "", lines)


def test_the_files_to_try_differ_as_the_page_says():
    by_chain, by_relation = blocks("from-other-tools.md", "dsl")
    assert "R1" in {finding.rules[0] for finding in conflicts(by_chain)[1]}
    assert {finding.rules[0] for finding in conflicts(by_relation)[1]} == {"R1", "R2"}
