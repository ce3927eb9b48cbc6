"""The effect line of each repair names all that the repair takes away and adds, by brute force."""

from __future__ import annotations

from pathlib import Path
from random import Random

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sleec_runtime.language import load, parse, print_ruleset
from sleec_runtime.model import Ruleset
from sleec_verify.checks import run_checks
from sleec_verify.repairs.numbering import numbered_repairs
from sleec_verify.repairs.search import RepairSearch
from sleec_verify.report.repair_phrases import effect_in_words
from tests.support.effects import changed, said, sampled
from tests.support.paths import ROOT
from tests.support.small_rulesets import small_rulesets
from tests.support.studies import OWN

SMALL = [ROOT / "rulesets" / f"{name}.sleec" for name in ("medication-round", "night-watch", "hospital", "household")]
STUDIES = [OWN / f"{name}.sleec" for name in ("library-porter", "lone-companion", "school-helper", "parcel-drone")]


def assert_effects(ruleset: Ruleset, codes: tuple[str, ...] | None = None) -> int:
    """The number of repairs whose effect line says what the evaluation of all situations shows."""
    results = run_checks(ruleset)
    search = RepairSearch(ruleset, results)
    number = 0
    for finding in (finding for result in results for finding in result.findings):
        if codes is None or finding.code in codes:
            for repair in search.repairs(finding):
                effect = effect_in_words(repair)
                assert "unknown" not in effect, effect
                assert said(effect) == changed(ruleset, repair.repaired), (repair.candidate.title, effect)
                assert repair.effect.keeps_meaning == (not any(changed(ruleset, repair.repaired)))
                number += 1
    return number


@settings(max_examples=150, deadline=None)
@given(
    small_rulesets(rules=3, hedges=2, nested=False),
    st.sampled_from(("SLEEC101", "SLEEC101", "SLEEC102", "SLEEC202", "SLEEC301", "SLEEC302", "SLEEC401", "SLEEC503")),
)
def test_effects_of_random_rules(ruleset: Ruleset, code: str) -> None:
    assert_effects(parse(print_ruleset(ruleset)), (code,))


@pytest.mark.slow
@pytest.mark.parametrize("path", [*SMALL, *STUDIES], ids=lambda path: path.stem)
def test_effects_of_rules_that_people_write(path: Path) -> None:
    """Of rules with time, those literals count of which no other window remains. The repairs are those that users see,
    within the budget of the file."""
    ruleset = load(path)
    results = run_checks(ruleset)
    search = RepairSearch(ruleset, results)
    random = Random(path.stem)
    findings = [finding for result in results for finding in result.findings]
    for found in numbered_repairs(findings, search):
        for repair in (one.repair for one in found.repairs):
            effect = effect_in_words(repair)
            names = said(effect)
            lost, gained = sampled(ruleset, repair.repaired, random, 40)
            assert lost <= names.lost, (repair.candidate.title, effect)
            assert gained <= names.gained, (repair.candidate.title, effect)
