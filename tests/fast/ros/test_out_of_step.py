"""A task that does not have the present context follows its policy, asks again, and names the reason."""

from __future__ import annotations

from dataclasses import replace
from hashlib import sha256

import pytest

from sleec_runtime import Sleec, VirtualClock, language
from sleec_runtime.errors import SleecError
from sleec_runtime.ros import ContextManagerNode, Network, TaskManagerNode
from sleec_runtime.ros.faults import Faults, FaultyTransport
from sleec_runtime.ros.in_process import InProcessPublisher, InProcessTransport
from sleec_runtime.ros.messages import LayersUpdate
from sleec_runtime.ros.problems import NoManager, OutOfStep, RulesDiffer, SecondManager
from sleec_runtime.ros.task_manager.policies import Policy
from sleec_runtime.ros.transport import Fields, Topic
from tests.support.robot_nodes import Robot

TEXT = """
RULE door WHEN Ring THEN OpenDoor UNLESS Night IN WHICH CASE Whisper UNLESS Alarm IN WHICH CASE CallForHelp
RULE light WHEN Ring AND Dark THEN LightOn
RULE tea WHEN Thirst THEN MakeTea UNLESS NOT KettleFull IN WHICH CASE FillKettle
"""
RULES = language.parse(TEXT)


class Partition:
    """A robot with one task, whose messages from the Context Manager can be lost."""

    def __init__(self, policy: Policy = "refuse") -> None:
        self.robot = Robot(RULES)
        self.link = FaultyTransport(self.robot.network.transport(), Faults(), 0, self.robot.clock)
        self.task = self.robot.task(policy=policy, transport=self.link)
        self.robot.report({"Night": True, "Dark": True})

    def lose(self, conditions: dict[str, bool]) -> None:
        """The context changes, and the task does not hear of it."""
        self.link.faults = Faults(drop=1)
        self.robot.report(conditions)
        self.link.faults = Faults()

    def problems(self) -> list[str]:
        return [str(problem) for problem in self.robot.problems]


def test_a_lost_update_is_noticed_by_the_next_one_and_asked_for() -> None:
    partition = Partition()
    partition.lose({"Night": False})
    partition.robot.report({"Dark": False})
    assert "update 2 of Context Manager" in partition.problems()[0]
    assert partition.robot.trigger("Ring") == ["OpenDoor"]
    assert partition.robot.executed[-1].number == 3


def test_a_lost_last_update_is_noticed_by_the_next_heartbeat() -> None:
    partition = Partition()
    partition.lose({"Night": False})
    assert partition.robot.trigger("Ring") == ["Whisper", "LightOn"]
    assert partition.robot.executed[-1].number == 1
    partition.robot.advance(1.5)
    assert partition.robot.trigger("Ring") == ["OpenDoor", "LightOn"]


def test_a_task_says_that_it_finds_no_context_manager() -> None:
    network, clock = Network(), VirtualClock()
    problems: list[SleecError] = []
    sleec = Sleec(RULES, clock=clock)
    sleec.implement({"MakeTea": print, "FillKettle": print})
    task = TaskManagerNode("tea", sleec, network.transport(), timeout=3, on_problem=problems.append)
    for seconds in (2, 2, 20):
        clock.advance(seconds)
        network.deliver()
        assert len(problems) == (clock.now() > 3)
    assert isinstance(problems[0], NoManager)
    manager = ContextManagerNode(Sleec(RULES, clock=clock), network.transport())
    network.deliver()
    assert task.layer_listener.in_step
    assert len(problems) == 1
    task.close()
    manager.close()


@pytest.mark.parametrize(
    ("policy", "now", "later"),
    [("refuse", [], []), ("default", ["MakeTea"], []), ("hold", [], ["FillKettle"])],
)
def test_a_silent_context_manager_is_noticed_and_the_policy_decides(
    policy: Policy, now: list[str], later: list[str]
) -> None:
    partition = Partition(policy)
    partition.link.faults = Faults(drop=1)
    partition.robot.advance(4)
    partition.link.faults = Faults()
    assert "is silent for more than 3 seconds" in partition.problems()[0]
    # The default of the rule is MakeTea, also where the context as the task knows it has another active clause.
    assert partition.robot.trigger("Thirst") == now
    report = partition.robot.executed[-1:]
    if policy != "hold":
        assert (report[0].policy, report[0].number, bool(report[0].refused)) == (policy, None, policy == "refuse")
    partition.robot.advance(1)
    assert partition.robot.log == now + later
    assert partition.robot.trigger("Thirst") == ["FillKettle"]


def test_a_trigger_is_not_held_forever_and_not_too_many_are() -> None:
    partition = Partition("hold")
    partition.link.faults = Faults(drop=1)
    partition.robot.advance(4)
    partition.robot.manager.close()
    partition.link.faults = Faults()
    for _ in range(102):
        partition.robot.trigger("Thirst")
    assert [bool(one.refused) for one in partition.robot.executed] == [True, True]
    partition.robot.advance(20)
    assert len(partition.robot.executed) == 102
    assert partition.robot.log == []


def test_a_default_with_a_guard_is_not_executed_without_a_context() -> None:
    partition = Partition("default")
    partition.robot.manager.close()
    partition.robot.advance(4)
    assert partition.robot.trigger("Ring") == []
    assert "rule `light` has a guard" in str(partition.robot.executed[-1].failed)


def test_clocks_of_nodes_may_differ() -> None:
    robot = Robot(RULES)
    late = VirtualClock(10**9)
    sleec = Sleec(RULES, clock=late)
    sleec.implement({name: lambda fields, name=name: robot.log.append(name) for name in RULES.obligations})
    TaskManagerNode("task", sleec, robot.network.transport(), on_problem=robot.problems.append)
    for _ in range(10):
        late.advance(1)
        robot.advance(1)
    assert robot.trigger("Ring") == ["OpenDoor"]
    assert robot.problems == []
    late.advance(4)
    assert robot.trigger("Ring") == []


def test_two_context_managers_are_noticed_by_all_nodes_until_one_stops() -> None:
    robot = Robot(RULES)
    robot.task()
    robot.advance(1.5)
    transport = robot.network.transport()
    second = robot.context_manager(transport=transport)
    robot.advance(1.5)
    assert [type(problem) for problem in robot.problems].count(SecondManager) == 3
    assert robot.trigger("Ring") == []
    robot.crash_manager()
    robot.advance(5)
    assert robot.trigger("Ring") == ["OpenDoor"]
    assert robot.executed[-1].manager == second.manager


def test_rules_that_differ_are_named_by_node_and_hash_on_both_sides() -> None:
    robot = Robot(RULES)
    other = Robot(language.parse(TEXT.replace("Whisper", "Shout")))
    sleec = other.sleec()
    sleec.implement({"MakeTea": lambda fields: robot.log.append("tea"), "FillKettle": lambda fields: None})
    TaskManagerNode("kettle", sleec, robot.network.transport(), on_problem=robot.problems.append)
    robot.deliver()
    assert robot.trigger("Thirst") == []
    by_manager, by_node = [str(problem) for problem in robot.problems if isinstance(problem, RulesDiffer)]
    hashes = [sha256(one.source.text.encode()).hexdigest()[:12] for one in (RULES, other.ruleset)]
    for text in (by_manager, by_node):
        assert "node `kettle`" in text
        assert all(one in text for one in hashes)


def test_the_same_rules_in_another_reading_differ() -> None:
    robot = Robot(RULES)
    sleec = Sleec(RULES, reading="priority", clock=robot.clock)
    sleec.implement({name: lambda fields: robot.log.append("done") for name in RULES.obligations})
    TaskManagerNode("task", sleec, robot.network.transport(), on_problem=robot.problems.append)
    robot.deliver()
    assert robot.trigger("Ring") == []
    assert "(priority)" in str(robot.problems[0])


def test_a_context_manager_that_starts_again_is_followed_when_the_old_one_is_silent() -> None:
    robot = Robot(RULES)
    robot.task()
    robot.report({"Night": True})
    robot.crash_manager()
    second = robot.context_manager()
    robot.deliver()
    assert robot.trigger("Ring") == []
    robot.advance(5)
    assert robot.trigger("Ring") == ["OpenDoor"], "the new one has not heard of the night"
    assert robot.executed[-1].manager == second.manager


def test_other_code_that_changes_the_context_of_a_task_is_noticed_and_corrected() -> None:
    robot = Robot(RULES)
    sleec = robot.sleec()
    sleec.implement({name: lambda fields, name=name: robot.log.append(name) for name in RULES.obligations})
    TaskManagerNode("task", sleec, robot.network.transport(), on_problem=robot.problems.append)
    robot.deliver()
    sleec.update({"Night": True})
    assert robot.trigger("Ring") == []
    robot.advance(1.5)
    assert "other code changed the context of node `task`" in str(robot.problems[0])
    assert robot.trigger("Ring") == ["OpenDoor"]


def test_an_update_with_other_layers_than_the_task_derives_puts_it_out_of_step() -> None:
    robot = Robot(RULES)
    robot.task()
    updates: list[LayersUpdate] = []
    robot.outside.subscribe(LayersUpdate.topic, lambda fields: updates.append(LayersUpdate.from_fields(fields)))
    robot.deliver()
    false = replace(updates[-1], number=1, full=False, activate=("door.hc2",))
    robot.outside.publisher(LayersUpdate.topic).publish(false.to_fields())
    robot.deliver()
    assert isinstance(robot.problems[0], OutOfStep)
    assert "update 1 names other layers than this node derives" in str(robot.problems[0])
    assert robot.trigger("Ring") == []


@pytest.mark.parametrize("strict", [False, True])
def test_nodes_of_which_one_is_strict_say_so(strict: bool) -> None:
    robot = Robot(RULES)
    robot.crash_manager()
    manager, task = (Sleec(RULES, strict=one, clock=robot.clock) for one in (strict, not strict))
    task.implement({name: lambda fields: None for name in RULES.obligations})
    ContextManagerNode(manager, robot.network.transport())
    TaskManagerNode("task", task, robot.network.transport(), on_problem=robot.problems.append)
    robot.deliver()
    assert "load the rules of all nodes with the same `strict`" in str(robot.problems[0])


def test_code_that_takes_long_is_a_possible_reason_for_silence() -> None:
    """The node cannot tell: its code runs in the thread that receives heartbeats."""
    robot = Robot(RULES)
    sleec = robot.sleec()
    sleec.implement({name: lambda fields: robot.clock.advance(4) for name in RULES.obligations})
    TaskManagerNode("task", sleec, robot.network.transport(), on_problem=robot.problems.append)
    robot.deliver()
    robot.trigger("Ring")
    assert "silent for more than 3 seconds, or code of this node took as long" in str(robot.problems[0])
    robot.advance(1)
    robot.trigger("Ring")
    assert [report.executed for report in robot.executed] == [("OpenDoor",), ("OpenDoor",)]


class Prompt(InProcessPublisher):
    """Other nodes answer before the sender continues, as their threads may."""

    def publish(self, fields: Fields) -> None:
        super().publish(fields)
        self._network.deliver()


class PromptTransport(InProcessTransport):
    """A transport whose messages are answered at once."""

    def publisher(self, topic: Topic) -> InProcessPublisher:
        return Prompt(self, self._network, topic)


def test_a_context_manager_may_answer_while_a_task_starts(caplog: pytest.LogCaptureFixture) -> None:
    robot = Robot(RULES)
    robot.report({"Night": True})
    node = robot.task(transport=PromptTransport(robot.network, threads=False))
    assert node.layer_listener.in_step
    assert robot.trigger("Ring") == ["Whisper"]
    assert caplog.messages == []
