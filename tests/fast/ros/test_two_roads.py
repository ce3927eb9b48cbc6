"""What tasks execute is what the solver road entails, in random contexts and domains, and under faults."""

from __future__ import annotations

from random import Random

import pytest

from sleec_runtime import language
from sleec_runtime.model import Context, Value
from sleec_runtime.ros.faults import Faults
from sleec_verify.entailment.entailment import entail
from tests.support.faulty_mission import FaultyMission
from tests.support.paths import ROOT
from tests.support.random_contexts import random_changes
from tests.support.robot_nodes import Robot

FILES = ("household", "hospital", "care-robot")


@pytest.mark.parametrize("file", FILES)
def test_what_tasks_execute_is_what_definition_1_entails(file: str) -> None:
    ruleset = language.load(ROOT / f"rulesets/{file}.sleec")
    random = Random(7)
    robot = Robot(ruleset)
    # Two tasks share the rules.
    labels = sorted(ruleset.by_label)
    robot.task("one", rules=labels[::2])
    robot.task("other", rules=labels[1::2])
    vocabulary = robot.sleec().vocabulary
    known: dict[str, Value] = {}
    domain = None
    for _ in range(20):
        if random.random() < 0.3:
            domain = random.choice((None, *ruleset.domains))
            robot.enter(domain)
        changes = random_changes(vocabulary, random)
        robot.report(changes)
        known = {name: value for name, value in {**known, **changes}.items() if value is not None}
        for trigger in sorted(ruleset.triggers):
            executed = robot.trigger(trigger)
            expected = entail(ruleset, Context(frozenset([trigger]), known), domain)
            assert sorted(executed) == sorted(expected.obligations), (trigger, known, domain)
    assert robot.problems == []


@pytest.mark.parametrize(
    "faults",
    [Faults(drop=0.3), Faults(duplicate=0.5), Faults(delay=0.5), Faults(reorder=0.5), Faults(0.2, 0.2, 0.2, 0.2, 5)],
    ids=["drop", "duplicate", "delay", "reorder", "all"],
)
def test_nothing_is_executed_that_no_true_context_justifies(faults: Faults) -> None:
    mission = FaultyMission(language.load(ROOT / "rulesets/care-robot.sleec"), faults, seed=11)
    mission.run(250)
    assert mission.outcomes["executed"] > 10
    assert mission.outcomes["refused"] > 0
    assert sum(mission.faults.values()) > 50
