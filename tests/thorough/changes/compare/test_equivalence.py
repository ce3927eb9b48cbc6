"""Edits that change nothing are equivalent."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sleec_runtime.errors import Unsayable
from sleec_runtime.language import load
from sleec_verify.changes.compare import Difference, compare
from sleec_verify.checks import run_checks
from sleec_verify.exchange.conversion import convert
from sleec_verify.exchange.conversion.readings import with_reading
from tests.support.differences import CURTAINS, differ, edit
from tests.support.paths import ROOT
from tests.support.small_rulesets import small_rulesets
from tests.support.studies import each_study

RULESETS = ROOT / "rulesets"


@pytest.mark.parametrize("path", sorted(RULESETS.glob("*.sleec")), ids=lambda path: path.stem)
def test_a_ruleset_is_equivalent_to_itself(path: Path) -> None:
    found = compare(load(path), load(path))
    assert found.relation == "equivalent"
    assert found.same == len(found.new.rules)
    assert found == Difference(found.old, found.new, same=found.same)


@pytest.mark.slow
@each_study
def test_a_study_is_equivalent_to_itself_and_stricter_than_without_a_rule(path: Path) -> None:
    study = load(path)
    assert compare(study, study).relation == "equivalent"
    named = {
        r for result in run_checks(study, ["conflict", "redundant-rule"]) for f in result.findings for r in f.rules
    }
    rule = next((rule for rule in study.rules if rule.label not in named), study.rules[-1])
    without = replace(study, statements=tuple(s for s in study.statements if s is not rule))
    for old, new, expected in ((study, without, "laxer"), (without, study, "stricter")):
        found = compare(old, new)
        # Without a rule that is part of a conflict, this conflict is gone.
        assert found.relation == ("incomparable" if found.all_conflicts else expected)
        assert rule.label in named or not found.all_conflicts
        assert (found.more, found.less) == (expected == "stricter", expected == "laxer")


def test_renamed_reordered_and_rewritten_rules_are_told_and_equivalent() -> None:
    old = CURTAINS + "RULE b\nWHEN t THEN o UNLESS NOT (c AND d) IN WHICH CASE p\nRULE z\nWHEN u THEN q\n"
    new = "RULE z\nWHEN u THEN q\nRULE b\nWHEN t THEN o UNLESS NOT c OR NOT d IN WHICH CASE p\n" + CURTAINS.replace(
        "dress_assist", "curtains"
    )
    found = differ(old, new)
    assert found.relation == "equivalent"
    assert found.renamed == (("dress_assist", "curtains"),)
    assert found.rewritten == (("b",),)
    assert found.reordered


@pytest.mark.parametrize("path", sorted(RULESETS.glob("*.sleec")), ids=lambda path: path.stem)
@pytest.mark.parametrize("reading", ["cascade", "priority"])
def test_between_readings(path: Path, reading: str) -> None:
    ruleset = load(path)
    found = compare(ruleset, with_reading(ruleset, "cascade" if reading == "cascade" else "priority"))
    assert found.relation == "equivalent"


@settings(max_examples=50)
@given(small_rulesets(rules=3), st.sampled_from(("cascade", "priority")))
def test_between_readings_of_random_rules(ruleset, reading) -> None:
    assert compare(ruleset, with_reading(ruleset, reading)).relation in ("equivalent", "unknown")


@settings(max_examples=50)
@given(small_rulesets(constraints=False, assumptions=False, measures=True))
def test_between_syntaxes(ruleset) -> None:
    try:
        converted = convert(ruleset, "legos").ruleset
    except Unsayable:
        return
    found = compare(ruleset, converted)
    assert found.relation == "equivalent"
    assert not found.undecided


def test_what_changes_only_where_the_assumptions_forbid_it_is_equivalent() -> None:
    old = "ASSUME NOT (UserUndressed AND UserDistressed)\n" + CURTAINS
    assert edit(old, "WarnUser AND OpenCurtains", "CallNurse").relation == "equivalent"
    assert edit(CURTAINS, "WarnUser AND OpenCurtains", "CallNurse").relation == "incomparable"


def test_what_another_rule_obliges_anyway_is_no_loss() -> None:
    old = "RULE a\nWHEN t THEN o\nRULE b\nWHEN t AND c THEN o AND p\n"
    assert edit(old, "THEN o AND p", "THEN p").relation == "equivalent"
