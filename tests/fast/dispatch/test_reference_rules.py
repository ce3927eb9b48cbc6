"""The paper's eight rules over all their contexts, against if-else written by hand; and its experiment E1."""

from __future__ import annotations

import random
from collections.abc import Callable
from itertools import product
from typing import Any

import pytest

import sleec_runtime
from sleec_runtime import Sleec
from sleec_runtime.model import Reading
from tests.support.robots import Log, listing_2

RULESETS = "rulesets"
MENDED, AS_EVALUATED = f"{RULESETS}/care-robot.sleec", f"{RULESETS}/as-evaluated.sleec"


def chain(reading: Reading, default: list[str], *hedges: tuple[bool, list[str]]) -> list[str]:
    """What a chain obliges, straight from semantics: no code of the product."""
    chosen = default
    for held, response in hedges:
        if held:
            chosen = response
        elif reading == "cascade":
            break
    return chosen


Expected = Callable[[Reading, dict[str, Any]], list[str]]

EXPECTED: dict[str, Expected] = {
    "AddressUserName": lambda reading, c: chain(
        reading,
        ["UsePreferredName"],
        (c["UserNameUnknown"], ["AddressSirOrMadam"]),
        (c["UserDirectsOtherwise"], ["UseUserChosenName"]),
    ),
    "InstructionFail": lambda _, c: (
        ["CallSupport"] if c["InstructionRepeat"] >= 3 or c["TimeElapsed"] > 20 else ["RepeatInstruction"]
    ),
    "PreparingExamination": lambda _, c: ["AskLegalPresence"] if c["UserAge"] < 18 else ["EnsurePrivateSpace"],
    "CurtainOpenRequest": lambda reading, c: chain(
        reading,
        ["OpenCurtains"],
        (c["UserUndressed"], ["RefuseRequest", "ExplainWhy"]),
        (c["UserDistressed"], ["WarnUser", "OpenCurtains"]),
    ),
    "DressingStarted": lambda _, c: ["DoNothing"] if c["MedicalEmergency"] or c["UserAdvices"] else ["CloseDoor"],
    "UserSaysStop": lambda _, c: ["AskToFinishFirst"] if c["RiskLevel"] != "r_low" else ["RobotStop"],
    "HumanOnFloor": lambda reading, c: chain(
        reading,
        ["CallEmergencyServices"],
        (c["UserResponsive"], ["AskForUserStatus"]),
        (c["UserWithCompanion"], ["AskCompanionToCheck"]),
    ),
    "MonitorMealTime": lambda _, c: ["RemindLater"] if c["UserOccupied"] else ["InformUser"],
}
HOSPITAL = {"AddressUserName", "InstructionFail", "PreparingExamination"}
HOUSEHOLD = {"CurtainOpenRequest", "DressingStarted", "UserSaysStop"}

BOTH = (False, True)
VALUES: dict[str, tuple[Any, ...]] = {
    "UserNameUnknown": BOTH,
    "UserDirectsOtherwise": BOTH,
    "InstructionRepeat": (2, 3, 4),
    "TimeElapsed": (19.9, 20, 20.000001),
    "UserAge": (17, 18, 19),
    "UserUndressed": BOTH,
    "UserDistressed": BOTH,
    "MedicalEmergency": BOTH,
    "UserAdvices": BOTH,
    "RiskLevel": ("r_low", "r_moderate", "r_severe"),
    "UserResponsive": BOTH,
    "UserWithCompanion": BOTH,
    "UserOccupied": BOTH,
}
CONDITIONS_OF = {
    "AddressUserName": ("UserNameUnknown", "UserDirectsOtherwise"),
    "InstructionFail": ("InstructionRepeat", "TimeElapsed"),
    "PreparingExamination": ("UserAge",),
    "CurtainOpenRequest": ("UserUndressed", "UserDistressed"),
    "DressingStarted": ("MedicalEmergency", "UserAdvices"),
    "UserSaysStop": ("RiskLevel",),
    "HumanOnFloor": ("UserResponsive", "UserWithCompanion"),
    "MonitorMealTime": ("UserOccupied",),
}


def loaded(path: str = MENDED, **options) -> tuple[Sleec, Log]:
    sleec = sleec_runtime.load(path, **options)
    return sleec, listing_2(sleec)


@pytest.mark.parametrize("reading", ["cascade", "priority"])
@pytest.mark.parametrize("trigger", EXPECTED)
def test_a_rule_over_all_contexts_of_its_own(trigger: str, reading: Reading) -> None:
    sleec, robot = loaded(reading=reading)
    names = CONDITIONS_OF[trigger]
    for values in product(*(VALUES[name] for name in names)):
        context = dict(zip(names, values, strict=True))
        sleec.update(context)
        done = sleec.trigger(trigger)
        assert robot.taken() == list(done.obligations) == EXPECTED[trigger](reading, context)


def test_every_trigger_over_all_boolean_contexts_of_all_rules() -> None:
    """2^9 contexts of the Boolean conditions, 8 triggers each: other rules' conditions change nothing."""
    sleec, robot = loaded()
    booleans = [name for name, values in VALUES.items() if values == BOTH]
    measures = {name: values[-1] for name, values in VALUES.items() if values != BOTH}
    count = 0
    for values in product(BOTH, repeat=len(booleans)):
        context = {**measures, **dict(zip(booleans, values, strict=True))}
        sleec.update(context)
        for trigger, expected in EXPECTED.items():
            sleec.trigger(trigger)
            assert robot.taken() == expected("cascade", context)
            count += 1
    assert count == 2**9 * 8 == 4096


@pytest.mark.parametrize(
    ("trigger", "second", "cascade", "priority"),
    [
        ("AddressUserName", "UserDirectsOtherwise", ("UsePreferredName",), ("UseUserChosenName",)),
        ("CurtainOpenRequest", "UserDistressed", ("OpenCurtains",), ("WarnUser", "OpenCurtains")),
        ("HumanOnFloor", "UserWithCompanion", ("CallEmergencyServices",), ("AskCompanionToCheck",)),
    ],
)
def test_the_three_points_that_tell_the_readings_apart(
    trigger: str, second: str, cascade: tuple[str, ...], priority: tuple[str, ...]
) -> None:
    for reading, expected in (("cascade", cascade), ("priority", priority)):
        sleec = sleec_runtime.load(MENDED, reading=reading)  # type: ignore[arg-type]
        sleec.update({second: True})
        assert sleec.due(trigger).obligations == expected


def test_the_hedge_that_the_evaluation_has_is_dead() -> None:
    sleec, robot = loaded(AS_EVALUATED)
    for risk in VALUES["RiskLevel"]:
        sleec.update({"RiskLevel": risk})
        sleec.trigger("UserSaysStop")
        assert robot.taken() == ["RobotStop"]


def test_the_domain_scopes_the_rules() -> None:
    sleec, robot = loaded(domain="hospital")
    assert {rule.trigger for rule in sleec.ruleset.rules} == HOSPITAL | {"HumanOnFloor", "MonitorMealTime"}
    sleec.update({"UserUndressed": True})
    assert sleec.trigger("CurtainOpenRequest").obligations == ()
    assert robot.taken() == []


def test_100_cases_by_8_rules_as_in_experiment_e1() -> None:
    """Random conditions and domain, every trigger: 800 dispatches, as in the paper's Section 5."""
    random_case = random.Random(20260101)
    whole = sleec_runtime.load(MENDED)
    robots = {domain: loaded(domain=domain) for domain in ("hospital", "household")}
    dispatches = 0
    for _ in range(100):
        domain = random_case.choice(sorted(robots))
        context = {name: random_case.choice(values) for name, values in VALUES.items()}
        sleec, robot = robots[domain]
        sleec.update(context)
        for trigger, expected in EXPECTED.items():
            sleec.trigger(trigger)
            elsewhere = HOUSEHOLD if domain == "hospital" else HOSPITAL
            assert robot.taken() == ([] if trigger in elsewhere else expected("cascade", context))
            dispatches += 1
    assert dispatches == 800
    assert len(whole.ruleset.rules) == 8
    assert sum(len(rule.hedges) for rule in whole.ruleset.rules) == 11
    assert sum(len(list(rule.clauses())) for rule in whole.ruleset.rules) == 19
