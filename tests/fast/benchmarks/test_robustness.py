"""The simulation of the evaluation tells right from wrong executions."""

from __future__ import annotations

import logging
import random

import pytest

from benchmarks.evaluation.robustness import SCENARIOS, run
from benchmarks.evaluation.rule_changes import RULES
from benchmarks.evaluation.simulation import Execution, Simulation, split
from benchmarks.evaluation.situations import GroundTruth, Situation
from sleec_runtime.language import parse
from sleec_runtime.ros.faults import Faults
from tests.support.paths import ROOT

RULESET = parse((ROOT / RULES).read_text(encoding="utf-8"))
BY_NAME = {scenario.name: scenario for scenario in SCENARIOS}


@pytest.fixture(autouse=True)
def quiet(caplog: pytest.LogCaptureFixture) -> None:
    caplog.set_level(logging.CRITICAL, "sleec_runtime.ros")


def test_hand_written_code_follows_a_second_context_manager_and_nodes_do_not() -> None:
    ours, theirs = (run(BY_NAME["two Context Managers"], variant, RULESET, 2) for variant in ("CO-SLEEC", "CS-libs"))
    assert ours.triggers == theirs.triggers
    assert (ours.wrong, ours.repeated) == (0, 0)
    assert ours.executed > 0
    assert ours.refused > 0
    assert theirs.wrong > 0


def test_a_message_that_arrives_twice_triggers_once() -> None:
    ours, theirs = (run(BY_NAME["20 % duplicated"], variant, RULESET, 1) for variant in ("CO-SLEEC", "CS-libs-CM"))
    assert ours.repeated == 0
    assert theirs.repeated > 0


def test_an_execution_is_wrong_unless_a_recent_situation_obliges_it() -> None:
    world = Situation("household", {"UserUndressed": True, "UserDistressed": False})
    robot = Simulation("CO-SLEEC", RULESET, world, Faults(), random.Random(0), skew=False)
    robot.occur("CurtainOpenRequest")
    robot.change("UserUndressed", False)
    robot.advance(5)
    truth = GroundTruth(RULESET)
    assert [one.actions for one in robot.executions] == [("RefuseRequest", "ExplainWhy")]
    assert robot.wrong(truth) == []
    late = Execution(robot.clock.now(), "CurtainOpenRequest", ("RefuseRequest", "ExplainWhy"))
    robot.executions.append(late)
    assert robot.wrong(truth) == [late]
    assert robot.repeated() == 1


def test_what_a_task_does_at_once_is_split_by_trigger() -> None:
    actions = ["WarnUser", "OpenCurtains", "OpenCurtains", "RobotStop"]
    assert split(RULESET, "CurtainOpenRequest", actions) == [
        ("WarnUser", "OpenCurtains"),
        ("OpenCurtains",),
        ("RobotStop",),
    ]
