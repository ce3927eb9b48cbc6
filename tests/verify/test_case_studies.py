"""The published case studies against what LEGOS-SLEEC answers for them, and every difference with its reason and a
second method that confirms it. The files are read where they are and skipped where they are not."""

from __future__ import annotations

import json
from functools import cache
from pathlib import Path

import pytest

from sleec_runtime.language import parse
from sleec_runtime.trace import broken, broken_so_far
from sleec_verify.checks import run_checks
from sleec_verify.finding import Unknown
from sleec_verify.timed.replay import as_trace
from tests import timed_oracle as oracle

STUDIES = Path(__file__).parents[3] / "shared" / "case-studies"
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
CHECKS = ("redundant-rule", "vacuous-conflict", "conflict", "concern", "purpose")

CHAIN = "a response triggers a rule that clashes with what happens now: LEGOS does not follow chains into conflicts"
BROKEN = "the history that LEGOS shows breaks the rule already; in no other one is it in conflict"

DIFFERENCES = {
    # (study, variant, check, rule): (found here, the reason, the rules that suffice for the second method)
    ("ASPEN", "initial", "conflict", "R2"): (True, CHAIN, None),
    ("ASPEN", "corrected", "conflict", "R2"): (True, CHAIN, None),
    ("Autocar", "corrected", "conflict", "R4"): (True, CHAIN, ("R4", "R27VIII")),
    ("Autocar", "corrected", "conflict", "R12"): (True, CHAIN, ("R12", "R27IX")),
    ("Autocar", "corrected", "conflict", "R14"): (True, CHAIN, ("R14", "R27VII")),
    ("Autocar", "corrected", "conflict", "R15"): (True, CHAIN, ("R15", "R25")),
    ("Autocar", "corrected", "conflict", "R16"): (True, CHAIN, ("R16", "R27VII")),
    ("Autocar", "corrected", "conflict", "R1b"): (False, BROKEN, ("R1", "R1bb", "R1b", "R10", "R10_1", "R26")),
    ("CSI", "corrected", "conflict", "R3"): (True, CHAIN, None),
    ("CSI", "corrected", "conflict", "R4"): (True, CHAIN, None),
    ("CSI", "corrected", "conflict", "R10_1"): (True, CHAIN, None),
    ("CSI", "corrected", "conflict", "R18"): (True, CHAIN, None),
    ("CSI", "corrected", "conflict", "R21"): (True, CHAIN, None),
}


@cache
def study(name, variant):
    path = STUDIES / FILES[name, variant]
    if not path.is_file():
        pytest.skip(f"the case studies are not at {STUDIES}")
    ruleset = parse(path.read_text(encoding="utf-8"))
    return ruleset, {result.name: result for result in run_checks(ruleset)}


def found(results, check):
    """The rules, concerns or purposes that a check finds, as LEGOS lists them."""
    findings = results[check].findings
    return {f.obligations[0] if check in ("concern", "purpose") else f.rules[0] for f in findings}


@pytest.mark.parametrize("check", CHECKS)
@pytest.mark.parametrize(("name", "variant"), FILES)
def test_every_answer_is_that_of_legos_or_a_listed_difference(name, variant, check):
    _, results = study(name, variant)
    verdicts = json.loads((STUDIES / "verdicts-of-legos.json").read_text(encoding="utf-8"))
    (theirs,) = (set(v["found"]) for v in verdicts if (v["case"], v["variant"], v["check"]) == (name, variant, check))
    assert not isinstance(results[check].verdict, Unknown)
    listed = {key[3]: value[0] for key, value in DIFFERENCES.items() if key[:3] == (name, variant, check)}
    ours = found(results, check)
    assert ours - theirs == {rule for rule, here in listed.items() if here}
    assert theirs - ours == {rule for rule, here in listed.items() if not here}


@pytest.mark.parametrize("difference", DIFFERENCES, ids=lambda key: "-".join(key))
def test_every_difference_is_confirmed_by_the_second_method(difference):
    name, variant, _, label = difference
    here, _, rules = DIFFERENCES[difference]
    ruleset, _ = study(name, variant)
    if rules is not None:
        # With fewer rules there are more ways to go on, so that a conflict of theirs is one of all.
        kept = [s for s in ruleset.statements if not hasattr(s, "hedges") or s.label in rules]
        ruleset = type(ruleset)(tuple(kept), ruleset.reading, ruleset.syntax, ruleset.inferred)
    assert oracle.conflict(ruleset, label, past=0 if here else 1, later=1, longest=1).found == here


@pytest.mark.parametrize(("name", "variant"), FILES)
def test_every_timeline_is_replayed(name, variant):
    ruleset, results = study(name, variant)
    for check in ("conflict", "concern"):
        for finding in results[check].findings:
            trace = as_trace(finding.timeline)
            assert (broken_so_far if check == "conflict" else broken)(ruleset, trace) == ()


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


@pytest.mark.slow
@pytest.mark.parametrize("label", ["Rule2", "Rule9"])
def test_rules_that_four_deadlines_from_before_concern_are_in_no_conflict(label):
    ruleset = of_sleec_tk("firefighter-initial")
    (result,) = run_checks(ruleset, ["conflict"])
    assert label not in {finding.rules[0] for finding in result.findings}
    concerned = {"CameraStart", "BatteryCritical", "SoundAlarm"}
    kept = [s for s in ruleset.statements if not hasattr(s, "hedges") or s.trigger in concerned]
    fewer = type(ruleset)(tuple(kept), ruleset.reading, ruleset.syntax, ruleset.inferred)
    assert not oracle.conflict(fewer, label, past=3, later=2, longest=4).found


def test_what_others_do_not_report():
    autocar = study("Autocar", "corrected")[1]
    assert {("R8", 3), ("R13", 1), ("R14", 1)} <= {f.clauses[0] for f in autocar["dead-hedge"].findings}
    aspen = study("ASPEN", "corrected")[1]
    assert "SLEEC507" in {f.code for f in aspen["defect"].findings}
    dressing = study("dressingAssist", "corrected")[1]
    assert "SLEEC506" in {f.code for f in dressing["defect"].findings}
