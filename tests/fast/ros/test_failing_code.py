"""Nodes continue after code that raises anything, and after messages that no node can pass on."""

from __future__ import annotations

import json
import threading
from typing import Any

import pytest

from sleec_runtime import VirtualClock, language
from sleec_runtime.audit.auditor import Auditor
from sleec_runtime.errors import SleecError
from sleec_runtime.ros import MissionManagerNode, MonitorNode, Network, TaskManagerNode, Topic
from sleec_runtime.ros.messages import ConditionsUpdate, MissionEvent
from sleec_runtime.ros.monitoring.deviation_report import DeviationReport
from sleec_runtime.ros.transport import EMPTY
from sleec_runtime.ros.transport_errors import MalformedMessage
from tests.support.robot_nodes import Robot

RULES = language.parse("""
MEASURE Age: integer
RULE door WHEN Ring THEN Open UNLESS Night IN WHICH CASE Wait
RULE fall WHEN Fall THEN Help WITHIN 5 seconds OTHERWISE Shout
RULE call WHEN Bell THEN Answer WITHIN Age days
""")
pytestmark = pytest.mark.filterwarnings("ignore::sleec_runtime.errors.NotEnforced")


class Unprintable(Exception):
    """An error that cannot be shown as text."""

    def __str__(self) -> str:
        raise ValueError("no text")


ERRORS = (ValueError, SystemExit, GeneratorExit, BaseException, Unprintable)


def raising(kind: type[BaseException]) -> Any:
    def code(*_: object) -> None:
        raise kind("x")

    return code


def task(robot: Robot, code: dict[str, Any], **more: Any) -> TaskManagerNode:
    """A task with this code, and code that does nothing for the other obligations."""
    sleec = robot.sleec()
    sleec.implement({**{name: robot._logged(name) for name in robot.ruleset.obligations}, **code})
    more = {"on_problem": robot.problems.append, **more}
    node = TaskManagerNode("task", sleec, robot.network.transport(), **more)
    robot.deliver()
    return node


@pytest.mark.parametrize("policy", ["refuse", "default"])
@pytest.mark.parametrize("kind", ERRORS)
def test_a_task_continues_after_any_error_of_its_code(kind: type[BaseException], policy: Any) -> None:
    robot = Robot(RULES)
    task(robot, {"Open": raising(kind), "Help": raising(kind)}, policy=policy)
    robot.trigger("Ring")
    robot.trigger("Fall")
    robot.advance(6)
    failed = [report.failed or "" for report in robot.executed]
    assert [kind.__name__ in text for text in failed] == [True, True, False]
    assert all(type(problem) is SleecError for problem in robot.problems)
    robot.report({"Night": True})
    assert robot.trigger("Ring") == ["Wait"]
    assert robot.log == ["Shout", "Wait"]
    robot.crash_manager()
    robot.advance(4)
    robot.trigger("Ring")
    assert (kind.__name__ in (robot.executed[-1].failed or "")) == (policy == "default")


def test_an_interrupt_of_the_main_thread_ends_the_program() -> None:
    robot = Robot(RULES)
    task(robot, {"Open": raising(KeyboardInterrupt)})
    with pytest.raises(KeyboardInterrupt):
        robot.trigger("Ring")
    robot.deliver()
    assert "KeyboardInterrupt" in (robot.executed[-1].failed or "")


@pytest.mark.parametrize("kind", ERRORS)
def test_a_node_continues_after_any_error_of_on_problem(kind: type[BaseException]) -> None:
    robot = Robot(RULES)
    robot.manager._node._on_problem = raising(kind)
    task(robot, {}, on_problem=raising(kind))
    robot.trigger("Ring")
    robot.trigger("Rung")
    assert [report.refused is None for report in robot.executed] == [True]
    assert robot.trigger("Ring") == ["Open"]


@pytest.mark.parametrize("kind", ERRORS)
def test_a_monitor_continues_after_any_error_of_on_deviation(kind: type[BaseException]) -> None:
    network, clock = Network(), VirtualClock(start=1_000)
    monitor = MonitorNode(Auditor(RULES), network.transport(), late=False, clock=clock, on_deviation=raising(kind))
    for trigger in ("Ring", "Rung"):
        event = MissionEvent(trigger=trigger)
        network.transport().publisher(event.topic).publish(event.to_fields())
    network.deliver()
    clock.advance(3)
    assert monitor.published == 2


@pytest.mark.parametrize("kind", [*ERRORS, KeyboardInterrupt])
def test_a_transport_continues_after_any_error_of_a_subscriber(kind: type[BaseException]) -> None:
    network, arrived = Network(threads=True), threading.Event()
    transport = network.transport()
    transport.subscribe(Topic("/a"), raising(kind))
    transport.subscribe(Topic("/a"), lambda fields: arrived.set())
    transport.publisher(Topic("/a")).publish({})
    assert arrived.wait(5)
    transport.close()


def test_code_that_changes_the_context_does_not_hang_what_is_held() -> None:
    robot = Robot(RULES)
    instance: list[Any] = []
    node = task(robot, {"Open": lambda fields: instance[0].update({"Night": True})}, policy="hold")
    instance.append(node._sleec)
    robot.crash_manager()
    robot.advance(4)
    for _ in range(3):
        robot.trigger("Ring")
    robot.context_manager()
    robot.advance(4)
    assert [report.executed for report in robot.executed] == [("Open",)] * 3


@pytest.mark.parametrize("place", ["code", "on_problem"])
def test_a_node_may_be_closed_by_what_it_calls(place: str) -> None:
    robot = Robot(RULES)
    nodes: list[TaskManagerNode] = []

    def close(*_: object) -> None:
        nodes[0].close()

    nodes.append(task(robot, {"Open": close}, **({"on_problem": close} if place == "on_problem" else {})))
    if place == "on_problem":
        robot.crash_manager()
        robot.advance(4)
    robot.trigger("Ring")
    robot.advance(9)
    assert robot.trigger("Ring") == []
    assert nodes[0]._node.closed


CYCLE: list[object] = []
CYCLE.append(CYCLE)
DEEP = json.loads("[" * 50 + "]" * 50)


@pytest.mark.parametrize(
    "value",
    [float("nan"), float("inf"), "\ud800", b"x", object(), CYCLE, 10**2_000, 10**5_000, "x" * 2**20, DEEP],
    ids=lambda value: type(value).__name__,
)
def test_arguments_that_no_message_carries_are_refused(value: object) -> None:
    robot = Robot(RULES)
    robot.task()
    topic = Topic("/fallen", "std_msgs/msg/Float32")
    robot.manager.subscribe(topic, "Fall")
    robot.outside.publisher(topic).publish({"data": value})
    robot.deliver()
    assert [type(problem) for problem in robot.problems] == [MalformedMessage]
    assert "MalformedMessage" in (robot.executed[-1].failed or "")
    assert robot.manager_sleec.pending() == ()
    robot.outside.publisher(topic).publish({"data": 1.5})
    robot.deliver()
    assert robot.log == ["Help"]


@pytest.mark.parametrize("fields", [None, 5, "x", [1]])
def test_fields_that_are_no_mapping_are_refused(fields: Any) -> None:
    robot = Robot(RULES)
    robot.task()
    robot.manager.subscribe("/fallen", "Fall")
    robot.outside.publisher(Topic("/fallen", EMPTY)).publish(fields)
    robot.deliver()
    arguments: Any = 0 if fields is None else fields
    with pytest.raises(MalformedMessage):
        MissionManagerNode(robot.outside).start("Ring", arguments)
    assert [type(problem) for problem in robot.problems] == [MalformedMessage]
    assert robot.trigger("Fall") == ["Help"]


@pytest.mark.parametrize("number", [10**1_000 - 1, 1 - 10**1_000, 2**3_322 - 1], ids=["most", "least", "longest"])
def test_a_number_that_a_context_manager_has_reaches_the_tasks(number: int) -> None:
    robot = Robot(RULES)
    robot.task()
    robot.manager_sleec.update({"Age": number})
    robot.advance(2)
    assert robot.problems == []
    assert robot.trigger("Ring") == ["Open"]


@pytest.mark.parametrize("days", [10**1_000 - 1, 10**8, 0, -1, -(10**999)], ids=lambda days: str(days)[:9])
def test_the_report_of_a_window_of_any_length_is_accepted(days: int) -> None:
    network, clock = Network(), VirtualClock(start=1_790_000_000)
    monitor = MonitorNode(Auditor(RULES), network.transport(), late=False, clock=clock)
    found: list[DeviationReport] = []
    network.transport().subscribe(
        DeviationReport.topic, lambda fields: found.append(DeviationReport.from_fields(fields))
    )
    for message in (ConditionsUpdate(conditions={"Age": days}), MissionEvent(trigger="Bell")):
        network.transport().publisher(message.topic).publish(message.to_fields())
    network.deliver()
    clock.advance(3)
    monitor.close()
    network.deliver()
    assert [report.rule for report in found] == ["call"]
