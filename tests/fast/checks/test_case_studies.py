"""Our studies and the published ones: every question is answered, and every timeline is replayed. The published ones
against what LEGOS-SLEEC answers for them, and every difference with its reason."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from sleec_runtime.errors import LanguageError
from sleec_runtime.language import load
from sleec_verify.query.ruleset_index import RulesetIndex
from sleec_verify.replay.situations import replay_finding
from sleec_verify.results.finding import CheckResult, Unknown
from tests.support.studies import PUBLISHED, checked, each_study, is_refused, published_files, published_only

FILES = {
    ("ALMI", "initial"): "ALMI/ALMI.sleec",
    ("ALMI", "corrected"): "ALMI/ALMI-Corrected.sleec",
    ("ASPEN", "initial"): "ASPEN/aspen.sleec",
    ("ASPEN", "corrected"): "ASPEN/aspen-corrected.sleec",
    ("Autocar", "initial"): "Autocar/Autocar.sleec",
    ("Autocar", "corrected"): "Autocar/Autocar-corrected.sleec",
    ("CSI", "initial"): "CSI/CSI.sleec",
    ("CSI", "corrected"): "CSI/CSI-corrected.sleec",
    ("dressingAssist", "initial"): "dressingAssist/DRESSASSIST.sleec",
    ("dressingAssist", "corrected"): "dressingAssist/DRESSASSIST-corrected.sleec",
}
CHECKS = ("redundant-rule", "vacuous-conflict", "concern", "purpose")

BROKEN = "the history that LEGOS-SLEEC shows breaks the rule already; in no other one is it in conflict"

NOT_FOUND = {("Autocar", "corrected", "R1b"): BROKEN}
"""The conflicts that LEGOS-SLEEC reports and that are none by the definition, each with the reason."""


def published(name: str, variant: str) -> dict[str, CheckResult]:
    return checked(PUBLISHED / FILES[name, variant])[1]


def of_legos(name: str, variant: str, check: str) -> set[str]:
    """The rules, concerns or purposes that LEGOS-SLEEC finds."""
    verdicts = json.loads((PUBLISHED / "verdicts-of-legos.json").read_text(encoding="utf-8"))
    (found,) = (set(v["found"]) for v in verdicts if (v["case"], v["variant"], v["check"]) == (name, variant, check))
    return found


UNKNOWN: dict[str, set[str]] = {}
"""The checks that are not decided, by the files: there, responses lead back to their triggers."""


@each_study
def test_every_question_is_answered(path: Path) -> None:
    unknown = {name for name, result in checked(path)[1].items() if isinstance(result.verdict, Unknown)}
    assert unknown == UNKNOWN.get(path.stem, set())


@published_only
def test_files_in_other_dialects_are_refused_with_a_place() -> None:
    refused = [path for path in PUBLISHED.glob("*/*.sleec") if is_refused(path)]
    for path in refused:
        with pytest.raises(LanguageError, match=rf"{path.name}:\d+:\d+: "):
            load(path)
    assert len(refused) + len(published_files()) == len(list(PUBLISHED.glob("*/*.sleec"))) >= 17


@each_study
def test_every_timeline_is_replayed(path: Path) -> None:
    ruleset, results = checked(path)
    for check in {"conflict", "concern"} & set(results):
        for finding in results[check].findings:
            assert replay_finding(
                RulesetIndex(ruleset.in_domain(finding.domains[0]) if finding.domains else ruleset), finding
            )


@published_only
@pytest.mark.parametrize("check", CHECKS)
@pytest.mark.parametrize(("name", "variant"), FILES)
def test_every_answer_is_that_of_legos(name: str, variant: str, check: str) -> None:
    findings = published(name, variant)[check].findings
    ours = {f.obligations[0] if check in ("concern", "purpose") else f.rules[0] for f in findings}
    assert ours == of_legos(name, variant, check)


@published_only
@pytest.mark.parametrize(("name", "variant"), FILES)
def test_every_conflict_of_legos_is_found_or_a_listed_difference(name: str, variant: str) -> None:
    """LEGOS-SLEEC names one rule of each conflict, which is one of those that are named here."""
    findings = published(name, variant)["conflict"].findings
    theirs = of_legos(name, variant, "conflict")
    ours = {label for finding in findings for label in finding.rules}
    assert theirs - ours == {rule for n, v, rule in NOT_FOUND if (n, v) == (name, variant)}
    assert all(theirs.intersection(finding.rules) for finding in findings)


@published_only
def test_what_others_do_not_report() -> None:
    autocar = published("Autocar", "corrected")
    assert {("R8", 3), ("R13", 1), ("R14", 1)} <= {f.clauses[0] for f in autocar["dead-hedge"].findings}
    aspen = published("ASPEN", "corrected")
    assert "SLEEC507" in {f.code for f in aspen["defect"].findings}
    dressing = published("dressingAssist", "corrected")
    assert "SLEEC506" in {f.code for f in dressing["defect"].findings}
