"""The published case studies against what LEGOS-SLEEC answers for them, and every difference with its reason.

The files are read where they are and skipped where they are not.
"""

from __future__ import annotations

import json
from functools import cache

import pytest

from sleec_runtime.language import parse
from sleec_verify.checks import run_checks
from sleec_verify.query.ruleset_index import RulesetIndex
from sleec_verify.replay.situations import replays
from sleec_verify.results.finding import Unknown
from tests.support.paths import ROOT

STUDIES = ROOT.parent / "shared" / "case-studies"
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


@cache
def study(name, variant):
    path = STUDIES / FILES[name, variant]
    if not path.is_file():
        pytest.skip(f"the case studies are not at {STUDIES}")
    ruleset = parse(path.read_text(encoding="utf-8"))
    return ruleset, {result.name: result for result in run_checks(ruleset)}


def of_legos(name, variant, check):
    """The rules, concerns or purposes that LEGOS-SLEEC finds."""
    verdicts = json.loads((STUDIES / "verdicts-of-legos.json").read_text(encoding="utf-8"))
    (found,) = (set(v["found"]) for v in verdicts if (v["case"], v["variant"], v["check"]) == (name, variant, check))
    return found


@pytest.mark.parametrize("check", CHECKS)
@pytest.mark.parametrize(("name", "variant"), FILES)
def test_every_answer_is_that_of_legos(name, variant, check):
    _, results = study(name, variant)
    assert not isinstance(results[check].verdict, Unknown)
    findings = results[check].findings
    ours = {f.obligations[0] if check in ("concern", "purpose") else f.rules[0] for f in findings}
    assert ours == of_legos(name, variant, check)


@pytest.mark.parametrize(("name", "variant"), FILES)
def test_every_conflict_of_legos_is_found_or_a_listed_difference(name, variant):
    """LEGOS-SLEEC names one rule of each conflict, which is one of those that are named here."""
    _, results = study(name, variant)
    result = results["conflict"]
    assert not isinstance(result.verdict, Unknown)
    theirs = of_legos(name, variant, "conflict")
    ours = {label for finding in result.findings for label in finding.rules}
    assert theirs - ours == {rule for n, v, rule in NOT_FOUND if (n, v) == (name, variant)}
    assert all(theirs.intersection(finding.rules) for finding in result.findings)


@pytest.mark.parametrize(("name", "variant"), FILES)
def test_every_timeline_is_replayed(name, variant):
    ruleset, results = study(name, variant)
    for check in ("conflict", "concern"):
        for finding in results[check].findings:
            assert replays(RulesetIndex(ruleset), finding)


OF_SLEEC_TK = (
    "ALMI",
    "ASPEN",
    "CAREBOT-integrated",
    "CSICobot",
    "firefighter-initial",
    "firefighter-valid",
    "jss_running_example",
)


@cache
def of_sleec_tk(name):
    path = STUDIES / "sleec-tk" / f"{name}.sleec"
    if not path.is_file():
        pytest.skip(f"the case studies are not at {STUDIES}")
    return parse(path.read_text(encoding="utf-8"))


@pytest.mark.parametrize("name", OF_SLEEC_TK)
def test_every_question_about_the_files_of_sleec_tk_is_answered(name):
    (result,) = run_checks(of_sleec_tk(name), ["conflict"])
    assert not isinstance(result.verdict, Unknown), result.verdict


def test_what_others_do_not_report():
    autocar = study("Autocar", "corrected")[1]
    assert {("R8", 3), ("R13", 1), ("R14", 1)} <= {f.clauses[0] for f in autocar["dead-hedge"].findings}
    aspen = study("ASPEN", "corrected")[1]
    assert "SLEEC507" in {f.code for f in aspen["defect"].findings}
    dressing = study("dressingAssist", "corrected")[1]
    assert "SLEEC506" in {f.code for f in dressing["defect"].findings}
