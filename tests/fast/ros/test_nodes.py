"""Nodes: the context reaches the tasks, and triggers run the code of the active clauses."""

from __future__ import annotations

from collections.abc import Callable

import contextpy3 as cop
import pytest

from sleec_runtime import Sleec, language
from sleec_runtime.errors import NotBound, SleecError, SnapshotRefused, UnknownTrigger, WrongType
from sleec_runtime.ros import ContextManagerNode, Network, TaskManagerNode
from sleec_runtime.ros.faults import Faults, FaultyTransport
from sleec_runtime.ros.in_process import InProcessPublisher
from sleec_runtime.ros.messages import MissionEvent
from sleec_runtime.ros.transport import EMPTY, Fields, Topic
from tests.support.paths import ROOT
from tests.support.robot_nodes import Robot

CARE = language.load(ROOT / "rulesets/care-robot.sleec")
TWO_TASKS = language.parse("""
RULE door WHEN Ring THEN OpenDoor UNLESS Night IN WHICH CASE Whisper
RULE light WHEN Ring THEN LightOn UNLESS Night IN WHICH CASE DimLight
EXCLUSIVE OpenDoor, DimLight
""")


def test_listing_2_runs_in_the_layer_that_the_context_manager_announces() -> None:
    robot = Robot(CARE, "household")
    sleec = robot.sleec()
    log: list[str] = []

    class OpenCurtainNode(TaskManagerNode):
        def __init__(self) -> None:
            super().__init__("curtain_node", sleec, robot.network.transport())
            self.subscribe("/open_curtains_req", "CurtainOpenRequest")

        @sleec.rule("dress_assist")
        @cop.base
        def open_curtains_request(self, message: Fields) -> None:
            log.append("OpenCurtains")

        @cop.around(sleec.layers["dress_assist.hc1"])  # type: ignore[no-redef]
        def open_curtains_request(self, message: Fields) -> None:  # noqa: F811
            log.extend(["RefuseRequest", "ExplainWhy"])

        @cop.around(sleec.layers["dress_assist.hc2"])  # type: ignore[no-redef]
        def open_curtains_request(self, message: Fields) -> None:  # noqa: F811
            log.extend(["WarnUser", "OpenCurtains"])

    node = OpenCurtainNode()
    robot.deliver()
    request = robot.outside.publisher(Topic("/open_curtains_req", EMPTY))
    for conditions in ({}, {"UserUndressed": True}, {"UserDistressed": True}, {"UserUndressed": None}):
        robot.report(conditions)
        request.publish({})
        robot.deliver()
    assert log == ["OpenCurtains", "RefuseRequest", "ExplainWhy", "WarnUser", "OpenCurtains", "OpenCurtains"]
    assert [one.clauses for one in robot.executed] == [(("dress_assist", n),) for n in (0, 1, 2, 0)]
    assert [one.number for one in robot.executed] == [0, 1, 2, 3]
    assert {one.manager for one in robot.executed} == {robot.manager.manager}
    assert node.layer_listener.layers.active_layers() == robot.manager.hedge_clauses.active_layers()
    with pytest.raises(UnknownTrigger):
        node.subscribe("/meal", "MonitorMealTime")


def test_a_domain_change_replaces_the_rules_in_force() -> None:
    robot = Robot(CARE, "household")
    robot.task()
    robot.deliver()
    assert robot.trigger("CurtainOpenRequest") == ["OpenCurtains"]
    assert robot.trigger("PreparingExamination") == []
    robot.enter("hospital")
    robot.report({"UserAge": 15, "UserOccupied": True})
    assert robot.trigger("CurtainOpenRequest") == []
    assert robot.trigger("PreparingExamination") == ["AskLegalPresence"]
    robot.enter(None)
    assert robot.trigger("CurtainOpenRequest") == ["OpenCurtains"]
    assert robot.trigger("MonitorMealTime") == ["RemindLater"]
    assert robot.problems == []


def test_each_task_executes_its_own_rules_of_a_trigger_and_all_rules_are_checked_for_conflicts() -> None:
    robot = Robot(TWO_TASKS)
    robot.task("door", ["OpenDoor", "Whisper"])
    robot.task("light", ["LightOn", "DimLight"])
    robot.deliver()
    assert robot.trigger("Ring") == ["OpenDoor", "LightOn"]
    assert [(one.node, one.executed) for one in robot.executed] == [
        ("door", ("OpenDoor",)),
        ("light", ("LightOn",)),
    ]
    conflict = language.parse(TWO_TASKS.source.text.replace("UNLESS Night IN WHICH CASE Whisper", ""))
    robot = Robot(conflict)
    robot.task("door", ["OpenDoor"])
    robot.task("light", ["LightOn", "DimLight"])
    robot.report({"Night": True})
    assert robot.trigger("Ring") == []
    assert [bool(one.failed) for one in robot.executed] == [True, True]
    assert all("ConflictInContext" in str(problem) for problem in robot.problems)
    assert len(robot.problems) == 2


class Mute(FaultyTransport):
    """A transport that sends nothing."""

    def publisher(self, topic: Topic) -> InProcessPublisher:
        return Network().transport().publisher(topic)


def test_a_late_task_gets_the_present_context_without_asking_but_waits_for_a_heartbeat() -> None:
    robot = Robot(CARE, "household")
    for number in range(100):
        robot.report({"UserUndressed": True, "UserDistressed": number % 2 == 0})
    node = robot.task(transport=Mute(robot.network.transport(), Faults(), 0, robot.clock))
    robot.deliver()
    # What was published earlier may be old.
    assert robot.trigger("CurtainOpenRequest") == []
    robot.advance(1)
    assert robot.trigger("CurtainOpenRequest") == ["RefuseRequest", "ExplainWhy"]
    assert node.layer_listener.layers.active_layers() == robot.manager.hedge_clauses.active_layers()


def test_a_task_that_starts_again_ignores_the_updates_of_the_past() -> None:
    robot = Robot(CARE, "household")
    robot.advance(1.5)
    robot.report({"UserUndressed": True})
    link = FaultyTransport(robot.network.transport(), Faults(), 0, robot.clock)
    robot.task(transport=link, policy="hold")
    robot.outside.publisher(MissionEvent.topic).publish(MissionEvent(trigger="CurtainOpenRequest").to_fields())
    # The first update comes alone: then nobody was undressed.
    while not robot.log:
        assert robot.network.deliver(1)
    assert robot.log == ["RefuseRequest", "ExplainWhy"]


def test_sensors_in_the_process_of_the_context_manager_are_published_too() -> None:
    robot = Robot(CARE)
    robot.crash_manager()
    sleec = robot.sleec()
    ContextManagerNode(sleec, robot.network.transport())
    robot.task()
    sleec.update({"UserUndressed": True})
    robot.deliver()
    assert robot.trigger("CurtainOpenRequest") == ["RefuseRequest", "ExplainWhy"]


def test_in_strict_mode_a_decision_waits_for_the_conditions_that_it_needs() -> None:
    robot = Robot(CARE)
    robot.crash_manager()
    manager, task = (Sleec(CARE, strict=True, clock=robot.clock) for _ in range(2))
    ContextManagerNode(manager, robot.network.transport())
    task.implement({name: lambda fields, name=name: robot.log.append(name) for name in CARE.obligations})
    node = TaskManagerNode("task", task, robot.network.transport())
    robot.deliver()
    assert robot.trigger("MonitorMealTime") == []
    assert "depends on unreported values: UserOccupied" in str(robot.executed[-1].failed)
    robot.report({"UserOccupied": True})
    assert node.layer_listener.layers.active_layers() == ("mealtime.hc1",)
    assert robot.trigger("MonitorMealTime") == ["RemindLater"]


def test_code_that_fails_is_reported_and_the_node_continues() -> None:
    robot = Robot(CARE)
    sleec = robot.sleec()
    sleec.implement({"InformUser": lambda fields: 1 / 0, "RemindLater": lambda fields: robot.log.append("later")})
    TaskManagerNode("meal", sleec, robot.network.transport(), on_problem=robot.problems.append)
    robot.deliver()
    assert robot.trigger("MonitorMealTime") == []
    assert "ZeroDivisionError" in str(robot.executed[0].failed)
    assert "MonitorMealTime failed" in str(robot.problems[0])
    robot.report({"UserOccupied": True})
    assert robot.trigger("MonitorMealTime") == ["later"]


def test_a_mission_event_that_arrives_twice_occurs_once() -> None:
    robot = Robot(CARE)
    robot.task()
    robot.deliver()
    assert robot.trigger("MonitorMealTime", "m/1") == ["InformUser"]
    assert robot.trigger("MonitorMealTime", "m/1") == []
    assert robot.trigger("MonitorMealTime", "m/2") == ["InformUser"]


WITH_TIMES = language.parse("""
RULE dust WHEN DustSeen THEN Vacuum WITHIN 5 minutes
RULE rest WHEN UserSleeps THEN NOT Vacuum AND DimLight
RULE tea WHEN Thirst THEN MakeTea
""")


@pytest.mark.parametrize("label", ["dust", "rest"])
def test_a_method_that_would_never_run_is_an_error(label: str) -> None:
    sleec = Sleec(WITH_TIMES)

    class Methods:
        @sleec.rule(label)
        @cop.base
        def decided_elsewhere(self, message: Fields) -> None: ...

        @sleec.rule("tea")
        @cop.base
        def tea(self, message: Fields) -> None: ...

    sleec.bind(Methods())
    transport = Network().transport()
    with pytest.raises(NotBound, match=f"rule `{label}` has a method, which would never run"):
        TaskManagerNode("task", sleec, transport)
    TaskManagerNode("task", sleec, transport, rules=["tea"]).close()


@pytest.mark.parametrize("is_manager_first", [True, False])
def test_each_node_needs_its_own_instance_of_the_rules(is_manager_first: bool) -> None:
    transport, sleec = Network().transport(), Sleec(CARE)
    sleec.implement({name: lambda fields: None for name in CARE.obligations})
    starts: list[Callable[[], ContextManagerNode | TaskManagerNode]] = [
        lambda: ContextManagerNode(sleec, transport),
        lambda: TaskManagerNode("task", sleec, transport),
    ]
    first, second = starts if is_manager_first else reversed(starts)
    node = first()
    with pytest.raises(SleecError, match="the same Sleec as node `") as refused:
        second()
    assert refused.value.hint == "load the rules again for each node"
    node.close()
    second().close()


def test_a_node_that_does_not_start_leaves_the_instance_to_others() -> None:
    transport, sleec = Network().transport(), Sleec(CARE)
    with pytest.raises(NotBound):
        TaskManagerNode("task", sleec, transport)
    with pytest.raises(SnapshotRefused):
        ContextManagerNode(sleec, transport, checkpoint=ROOT)
    sleec.implement({name: lambda fields: None for name in CARE.obligations})
    TaskManagerNode("task", sleec, transport).close()


def test_mistakes_in_the_program_are_errors() -> None:
    transport = Network().transport()
    with pytest.raises(NotBound, match="no callable for `OpenCurtains`"):
        Robot(CARE).task("task", ["RefuseRequest"])
    with pytest.raises(NotBound, match="no code for the rules"):
        TaskManagerNode("task", Sleec(CARE), transport)
    with pytest.raises(WrongType, match="rules is a list of labels; got 'mealtime'"):
        Robot(CARE).task(rules="mealtime")
    with pytest.raises(WrongType, match="hold, default or refuse"):
        Robot(CARE).task(policy="wait")
    with pytest.raises(SleecError, match="chains"):
        ContextManagerNode(Sleec(CARE, chains=True), transport)
    without_text = language.parse("WHEN A THEN B")
    object.__setattr__(without_text, "source", type(without_text.source)("<made>", ""))
    with pytest.raises(SnapshotRefused):
        ContextManagerNode(Sleec(without_text), transport)
