"""Removal of what has no effect, and of what a repair makes superfluous."""

from __future__ import annotations

import pytest

from sleec_runtime.language import parse
from sleec_verify.checks import run_checks
from sleec_verify.repairs.edit import edited
from sleec_verify.repairs.search import RepairSearch

USED = "WHEN T THEN A // first\n\n// second\nWHEN S AND c THEN B\n"
REMOVED = {
    "SLEEC501": [
        ("TRIGGER T, S\n", "TRIGGER T, S, U\n", ""),
        ("TRIGGER T, S\n", "TRIGGER U, T, S\n", ""),
        ("", "MEASURE level: number\n", ""),
        ("TRIGGER T, S\n", "TRIGGER T, S\nTRIGGER U // unused\n", ""),
    ],
    "SLEEC202": [("", "", "UNLESS NOT c IN WHICH CASE C\n")],
    "SLEEC301": [("", "", "RULE again // the same\nWHEN S AND c AND d THEN B\n")],
    "SLEEC302": [("", "", "UNLESS d IN WHICH CASE B\n")],
}


@pytest.mark.parametrize(
    ("code", "kept", "head", "tail"), [(code, *case) for code, cases in REMOVED.items() for case in cases]
)
def test_everything_else_stays_to_the_byte(code: str, kept: str, head: str, tail: str) -> None:
    text = head + USED + tail
    ruleset = parse(text)
    results = run_checks(ruleset)
    (finding,) = (finding for result in results for finding in result.findings if finding.code == code)
    (repair,) = RepairSearch(ruleset, results).repairs(finding)
    assert edited(text, repair.candidate.edits) == kept + USED
    assert repair.effect.keeps_meaning


def test_names_that_nothing_uses_any_more_go_with_a_rule() -> None:
    text = "CONDITION c, d\nRULE a\nWHEN T AND d THEN A\nRULE b\nWHEN T AND c THEN NOT A\nRULE e\nWHEN S AND d THEN B\n"
    ruleset = parse(text)
    results = run_checks(ruleset)
    (finding,) = (finding for result in results for finding in result.findings)
    titles = [repair.candidate.title for repair in RepairSearch(ruleset, results).repairs(finding)]
    assert "remove rule `b`; then remove the declaration of `c`" in titles


def test_the_removal_of_a_rule_for_every_trigger_names_its_statement() -> None:
    ruleset = parse("ALWAYS greet\nRULE a\nWHEN T THEN NOT greet\nRULE b\nWHEN S THEN B\n")
    results = run_checks(ruleset)
    (finding,) = (f for result in results for f in result.findings if f.code == "SLEEC101")
    titles = [repair.candidate.title for repair in RepairSearch(ruleset, results).repairs(finding)]
    assert "remove `ALWAYS greet`" in titles


def test_removed_declarations_are_one_step() -> None:
    text = "CONDITION c, d\nRULE a\nWHEN T THEN A\nRULE b\nWHEN T AND c AND d THEN NOT A\nRULE e\nWHEN S THEN B\n"
    ruleset = parse(text)
    results = run_checks(ruleset)
    (finding,) = (f for result in results for f in result.findings if f.code == "SLEEC101")
    titles = [repair.candidate.title for repair in RepairSearch(ruleset, results).repairs(finding)]
    assert "remove rule `b`; then remove the declarations of `c` and `d`" in titles
