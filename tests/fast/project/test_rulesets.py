"""The shipped rulesets do what their stories tell."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from sleec_runtime.language import load, parse, print_ruleset
from sleec_runtime.model import Comparison, Context, Ruleset, Value, formulas_of, leaves
from sleec_verify.checks import run_checks
from sleec_verify.entailment.entailment import entail
from sleec_verify.results.finding import Finding, Unknown
from tests.support.paths import ROOT

FOLDER = ROOT / "rulesets"
FILES = sorted(FOLDER.glob("*.sleec"))


def ruleset(name: str) -> Ruleset:
    return load(FOLDER / f"{name}.sleec")


def findings(rules: Ruleset) -> list[Finding]:
    results = run_checks(rules)
    assert not any(isinstance(result.verdict, Unknown) for result in results)
    return [finding for result in results for finding in result.findings]


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_is_in_the_usual_layout(path: Path) -> None:
    assert print_ruleset(load(path)) == path.read_text(encoding="utf-8")


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_states_its_reading(path: Path) -> None:
    assert load(path).reading_stated


def test_every_file_is_listed() -> None:
    listed = re.findall(
        r"^\| \[[\w.-]+\]\(([\w.-]+)\)", (FOLDER / "README.md").read_text(encoding="utf-8"), re.MULTILINE
    )
    assert sorted(listed) == [path.name for path in FILES]


# The paper's eight rules


def test_domains_are_split_as_in_the_paper() -> None:
    rules = ruleset("care-robot")
    assert [len(rules.in_domain(domain).rules) for domain in ("hospital", "household")] == [5, 5]
    assert sum(rule.domains is None for rule in rules.rules) == 2
    assert sum(1 for rule in rules.rules for _ in rule.clauses()) == 19


@pytest.mark.parametrize("domain", ["hospital", "household"])
def test_each_domain_has_its_own_file(domain: str) -> None:
    assert ruleset(domain).rules == ruleset("care-robot").in_domain(domain).rules


def test_one_rule_differs_from_the_evaluation() -> None:
    mended, evaluated = ruleset("care-robot"), ruleset("as-evaluated")
    different = [a.label for a, b in zip(mended.rules, evaluated.rules) if a != b]
    assert different == ["dressing_stop"]
    (comparison,) = leaves(next(formulas_of(evaluated.by_label["dressing_stop"])))
    assert isinstance(comparison, Comparison)
    assert comparison.operator == "<"


def test_the_evaluations_hedge_is_dead() -> None:
    dead = [f for f in findings(ruleset("as-evaluated")) if f.check == "dead-hedge"]
    assert [(f.clauses[0].rule, f.clauses[0].clause) for f in dead] == [("dressing_stop", 1)]
    assert findings(ruleset("care-robot")) == []


ANSWERS: list[tuple[str, dict[str, Value], str]] = [
    ("AddressUserName", {}, "UsePreferredName"),
    ("AddressUserName", {"UserNameUnknown": True}, "AddressSirOrMadam"),
    ("AddressUserName", {"UserNameUnknown": True, "UserDirectsOtherwise": True}, "UseUserChosenName"),
    ("AddressUserName", {"UserDirectsOtherwise": True}, "UsePreferredName"),
    ("InstructionFail", {"InstructionRepeat": 2, "TimeElapsed": 20}, "RepeatInstruction"),
    ("InstructionFail", {"InstructionRepeat": 3, "TimeElapsed": 0}, "CallSupport"),
    ("InstructionFail", {"InstructionRepeat": 0, "TimeElapsed": 21}, "CallSupport"),
    ("PreparingExamination", {"UserAge": 18}, "EnsurePrivateSpace"),
    ("PreparingExamination", {"UserAge": 17}, "AskLegalPresence"),
    ("CurtainOpenRequest", {}, "OpenCurtains"),
    ("CurtainOpenRequest", {"UserUndressed": True}, "ExplainWhy RefuseRequest"),
    ("CurtainOpenRequest", {"UserUndressed": True, "UserDistressed": True}, "OpenCurtains WarnUser"),
    ("CurtainOpenRequest", {"UserDistressed": True}, "OpenCurtains"),
    ("DressingStarted", {}, "CloseDoor"),
    ("DressingStarted", {"MedicalEmergency": True}, "DoNothing"),
    ("DressingStarted", {"UserAdvices": True}, "DoNothing"),
    ("UserSaysStop", {"RiskLevel": "r_low"}, "RobotStop"),
    ("UserSaysStop", {"RiskLevel": "r_severe"}, "AskToFinishFirst"),
    ("HumanOnFloor", {}, "CallEmergencyServices"),
    ("HumanOnFloor", {"UserResponsive": True}, "AskForUserStatus"),
    ("HumanOnFloor", {"UserResponsive": True, "UserWithCompanion": True}, "AskCompanionToCheck"),
    ("HumanOnFloor", {"UserWithCompanion": True}, "CallEmergencyServices"),
    ("MonitorMealTime", {}, "InformUser"),
    ("MonitorMealTime", {"UserOccupied": True}, "RemindLater"),
]


@pytest.mark.parametrize(("trigger", "conditions", "due"), ANSWERS)
def test_answers_of_the_eight_rules(trigger: str, conditions: dict[str, Value], due: str) -> None:
    answer = entail(ruleset("care-robot"), Context(frozenset({trigger}), conditions))
    assert " ".join(answer.obligations) == due


# Our own


def test_night_watch_clashes_in_a_pair_and_in_a_three() -> None:
    found = findings(ruleset("night-watch"))
    assert {finding.check for finding in found} == {"conflict"}
    assert [finding.rules for finding in found] == [
        ("fall_alarm", "dark_rooms"),
        ("supper", "doorway", "unsteady_walk"),
    ]


def test_night_watch_mended_as_told_has_no_findings() -> None:
    text = (FOLDER / "night-watch.sleec").read_text(encoding="utf-8")
    story, told = text.split("// dark_rooms and doorway:\n")
    kept = re.sub(r"RULE (dark_rooms|doorway)\n(.+\n)+", "", story)
    mended = parse(kept + re.sub(r"^// ?", "", told, flags=re.MULTILINE))
    assert len(mended.rules) == 5
    assert findings(mended) == []


def test_one_rule_of_the_medication_round_depends_on_the_reading() -> None:
    rules = ruleset("medication-round")
    assert findings(rules) == []
    (reading,) = run_checks(rules, ["reading"])
    assert [finding.rules for finding in reading.findings] == [("offer_medication",)]
    context = Context(frozenset({"MedicationDue"}), {"LacksCapacity": True})
    assert entail(rules.read_as("cascade"), context).obligations == ("OfferMedication",)
    assert entail(rules.read_as("priority"), context).obligations == ("CallNurse",)


def test_two_spellings_say_what_the_engineers_said() -> None:
    rules = ruleset("medication-round")
    for pill, due in (("PainkillerDue", "OfferPainkiller"), ("SleepingPillDue", "CallNurse")):
        context = Context(frozenset({pill}), {"LacksCapacity": True})
        assert entail(rules, context).obligations == (due,)


def test_ward_has_no_findings() -> None:
    rules = ruleset("hospital-ward")
    assert len(rules.rules) >= 25
    assert findings(rules) == []


@pytest.mark.parametrize(
    ("careful", "careless", "check"),
    [
        ("FallRisk >= moderate OR Halted", "FallRisk >= moderate", "conflict"),
        ("AND (PatientInNeed OR Halted) IN", "AND Halted IN", "conflict"),
        ("PatientAsleep AND NOT PatientInNeed", "PatientAsleep", "conflict"),
        ("ASSUME QuietHours OR NOT NightRound\n", "", "conflict"),
        ("written AND NOT PersonalCareOngoing", "written", "conflict"),
        ("OutsideVisitingHours AND PatientDying AND NOT", "PatientDying AND NOT", "reading"),
        ("PainScore >= SeverePain IN", "PainScore >= 11 AND PainScore < 10 IN", "dead-hedge"),
        ("TRIGGER FireAlarm,", "TRIGGER FireAlarm, FloodAlarm,", "unused-name"),
    ],
)
def test_carelessness_on_the_ward_is_found(careful: str, careless: str, check: str) -> None:
    text = (FOLDER / "hospital-ward.sleec").read_text(encoding="utf-8")
    assert careful in text
    (result,) = run_checks(parse(text.replace(careful, careless)), [check])
    assert result.findings
