"""Reports of nodes say what the code executed, beside what the rules require; the monitor and the audit judge the
former only."""

from __future__ import annotations

import json
from collections.abc import Callable

import contextpy3 as cop
import pytest

import sleec_runtime
from sleec_runtime import Sleec
from sleec_runtime.audit.auditor import Auditor
from sleec_runtime.language import parse
from sleec_runtime.ros import MonitorNode, TaskManagerNode
from sleec_runtime.ros.messages import Executed
from tests.support.robot_nodes import Robot

DOOR = parse("RULE door\nWHEN Ring THEN OpenDoor\nUNLESS Alone IN WHICH CASE Refuse\n")


class Hands(TaskManagerNode):
    """The obligations of a task, and a method for whatever a variant does."""

    def open_door(self, *_: object) -> None:
        pass

    def refuse(self, *_: object) -> None:
        pass


def task(robot: Robot, variant: Callable[[Hands], None]) -> Hands:
    sleec: Sleec = robot.sleec()

    class Door(Hands):
        @sleec.rule("door")
        @cop.base
        def ring(self, fields: object) -> None:
            self.open_door()

        @cop.around(sleec.layers["door.hc1"])  # type: ignore[no-redef]
        def ring(self, fields: object) -> None:  # noqa: F811 - the style of Listing 2
            variant(self)

    return Door("door", sleec, robot.network.transport(), on_problem=robot.problems.append)


def monitored(robot: Robot) -> list[str]:
    """The kinds of the deviations that a monitor of the robot publishes, as they come."""
    kinds: list[str] = []
    MonitorNode(
        Auditor(DOOR, tolerance=0),
        robot.network.transport(),
        clock=robot.clock,
        on_deviation=lambda one: kinds.append(one.kind),
    )
    return kinds


def both(hands: Hands) -> None:
    hands.refuse()
    hands.open_door()


MUTANTS = {
    "another obligation": (lambda hands: hands.open_door(), ("OpenDoor",)),
    "nothing": (lambda hands: None, ()),
    "one too many": (both, ("Refuse", "OpenDoor")),
}


@pytest.mark.parametrize("name", MUTANTS)
def test_a_report_has_what_was_executed_and_the_monitor_sees_a_swapped_variant(name: str) -> None:
    variant, executed = MUTANTS[name]
    robot = Robot(DOOR)
    kinds = monitored(robot)
    task(robot, variant)
    robot.report({"Alone": True})
    robot.advance(1)
    robot.trigger("Ring")
    robot.advance(2)
    (report,) = robot.executed
    assert (report.due, report.executed) == (("Refuse",), executed)
    assert kinds, "the monitor reports the difference"
    assert set(kinds) <= {"missed", "unrequired"}


def test_a_correct_variant_is_no_deviation() -> None:
    robot = Robot(DOOR)
    kinds = monitored(robot)
    task(robot, lambda hands: hands.refuse())
    robot.report({"Alone": True})
    robot.deliver()
    robot.trigger("Ring")
    robot.advance(2)
    assert [(one.due, one.executed) for one in robot.executed] == [(("Refuse",), ("Refuse",))]
    assert kinds == []


def test_a_failing_variant_reports_what_it_has_executed() -> None:
    def fails(hands: Hands) -> None:
        hands.open_door()
        raise ValueError("stuck")

    robot = Robot(DOOR)
    task(robot, fails)
    robot.report({"Alone": True})
    robot.deliver()
    robot.trigger("Ring")
    (report,) = robot.executed
    assert report.executed == ("OpenDoor",)
    assert "stuck" in (report.failed or "")


def test_a_callable_of_a_rule_with_time_reports_what_it_executes_besides() -> None:
    rules = parse("RULE a\nWHEN Fall THEN CallNurse WITHIN 1 minute\nRULE b\nWHEN Ring THEN OpenDoor\n")
    robot = Robot(rules)
    sleec = robot.sleec()
    opened = sleec_runtime.obligation("OpenDoor")(lambda *_: None)
    sleec.implement({"CallNurse": lambda fields: opened(), "OpenDoor": opened})
    TaskManagerNode("nurse", sleec, robot.network.transport(), on_problem=robot.problems.append)
    robot.deliver()
    robot.trigger("Fall")
    robot.advance(1)
    assert sorted(name for one in robot.executed for name in one.executed or ()) == ["CallNurse", "OpenDoor"]


def test_the_report_of_an_earlier_version_leaves_open_what_was_executed() -> None:
    text = json.dumps({"v": 1, "node": "n", "triggered": 1, "time": 1, "trigger": "Ring", "obligations": ["OpenDoor"]})
    report = Executed.from_json(text)
    assert (report.due, report.executed) == (("OpenDoor",), None)
    robot = Robot(DOOR)
    kinds = monitored(robot)
    robot.report({"Alone": False})
    robot.deliver()
    robot.trigger("Ring")
    robot.outside.publisher(Executed.topic).publish({"data": text})
    robot.deliver()
    robot.advance(3)
    assert kinds == ["undetermined"]


def test_an_obligation_without_a_callable_is_unrecorded_and_undetermined() -> None:
    """The code of the variant acts by itself, so nobody sees which obligation it executes."""
    robot = Robot(DOOR)
    sleec = robot.sleec()
    kinds = monitored(robot)

    class Door(TaskManagerNode):
        @sleec.rule("door")
        @cop.base
        def ring(self, fields: object) -> None:
            robot.log.append("opens")

        @cop.around(sleec.layers["door.hc1"])  # type: ignore[no-redef]
        def ring(self, fields: object) -> None:  # noqa: F811 - the style of Listing 2
            robot.log.append("refuses")

    Door("door", sleec, robot.network.transport())
    robot.report({"Alone": True})
    robot.advance(1)
    robot.trigger("Ring")
    robot.advance(2)
    (report,) = robot.executed
    assert (report.due, report.executed, report.unrecorded) == (("Refuse",), (), ("Refuse",))
    assert kinds == ["undetermined"]
