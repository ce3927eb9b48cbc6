"""The studies: `check` finds exactly what `rulesets/studies/expected.toml` lists, and their page says so."""

from __future__ import annotations

import re
from collections import Counter
from pathlib import Path

import pytest

from sleec_runtime.errors import SleecError
from sleec_runtime.language import load, print_ruleset
from sleec_verify.checks import CHECKS
from sleec_verify.files.toml import read_toml
from sleec_verify.results.finding import Finding, Proved, Refuted
from tests.support.studies import OWN, checked

FILES = sorted(OWN.glob("*.sleec"))
EXPECTED = read_toml(OWN / "expected.toml", "expected.toml", SleecError)
LANGUAGES = {"legos": "LEGOS-SLEEC", "sleec-tk": "SLEEC-TK", None: "English"}
each_study = pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)


def subject(finding: Finding) -> tuple[str, ...]:
    """What a finding is about, whatever its witness is."""
    layers = tuple(f"{rule}.hc{clause}" if clause else rule for rule, clause in finding.clauses)
    if finding.check in ("concern", "purpose", "stray-event"):
        return finding.obligations
    if finding.check == "conflict":
        return layers + tuple(rule for rule in finding.rules if rule not in {clause.rule for clause in finding.clauses})
    if finding.check in ("dead-hedge", "redundant-hedge", "empty-hedge"):
        return layers
    return finding.rules[:1] or finding.obligations


@each_study
def test_check_finds_exactly_what_is_expected(path: Path) -> None:
    ruleset, results = checked(path)
    found: dict[str, list[str]] = {}
    for result in results.values():
        assert isinstance(result.verdict, Refuted if result.findings else Proved), result
        for finding in result.findings:
            line = ruleset.source.place(finding.span).line
            found.setdefault(finding.code, []).append(" ".join([str(line), *subject(finding)]))
    assert {code: sorted(entries) for code, entries in found.items()} == {
        code: sorted(entries) for code, entries in EXPECTED[path.name].items()
    }


def test_expectations_are_of_these_files() -> None:
    assert list(EXPECTED) == [path.name for path in FILES]


def test_most_findings_of_rules_are_in_some_study() -> None:
    """Those about the code of a robot, and about look-alike letters, are not about rules."""
    kinds = {kind.code for check in CHECKS.values() for kind in check.kinds if check.name != "confusable"}
    assert kinds - {code for codes in EXPECTED.values() for code in codes} == {
        "SLEEC103",  # a ruleset with contradictory assumptions has no other finding
        "SLEEC106",  # only with --realizable
        "SLEEC108",  # no study requires an event that it declares as the environment's
    }


@each_study
def test_is_in_the_usual_layout(path: Path) -> None:
    assert print_ruleset(load(path)) == path.read_text(encoding="utf-8")


def test_the_page_has_each_study_with_its_size_and_findings() -> None:
    text = (OWN / "README.md").read_text(encoding="utf-8")
    rows = {}
    for row in re.findall(r"^\| \[([\w.-]+)\]\(\1\) \|(.*)\|$", text, re.MULTILINE):
        _, language, rules, exceptions, _, *counts = (cell.strip() for cell in row[1].split("|"))
        rows[row[0]] = (language, int(rules), int(exceptions), *map(int, counts))
    assert rows == {path.name: measured(path) for path in FILES}


def measured(path: Path) -> tuple[str | int, ...]:
    ruleset, results = checked(path)
    clauses = sum(1 for rule in ruleset.rules for _ in rule.clauses())
    severities = Counter(finding.severity for result in results.values() for finding in result.findings)
    counts = (severities[severity] for severity in ("error", "warning", "note"))
    return (LANGUAGES[ruleset.dialect], len(ruleset.rules), clauses - len(ruleset.rules), *counts)
