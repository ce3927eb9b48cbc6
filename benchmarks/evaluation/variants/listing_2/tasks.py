"""The Task Manager Nodes: each has the method of a rule, in variants on the layers of its hedge clauses."""

# ruff: noqa: F811 - the variants of a method share its name
# mypy: disable-error-code="no-redef,untyped-decorator"

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import contextpy3 as cop

from benchmarks.evaluation.variants.robot import Robot
from benchmarks.evaluation.variants.topics import trigger_topic
from sleec_runtime import Sleec, load
from sleec_runtime.ros import ContextManagerNode, TaskManagerNode
from sleec_runtime.ros.transport import Fields, Transport


def context_manager(transport: Transport, rules: Path) -> ContextManagerNode:
    return ContextManagerNode(load(rules), transport)


class Task(TaskManagerNode):
    def __init__(self, sleec: Sleec, transport: Transport, robot: Robot, trigger: str) -> None:
        super().__init__(trigger, sleec, transport, policy="hold")
        self.robot = robot
        self.subscribe(trigger_topic(trigger), trigger)


def human_on_floor(transport: Transport, rules: Path) -> Task:
    sleec = load(rules)

    class HumanOnFloorNode(Task):
        @sleec.rule("human_on_floor")
        @cop.base
        def on_trigger(self, message: Fields) -> None:
            self.robot.call_emergency_services()

        @cop.around(sleec.layers["human_on_floor.hc1"])
        def on_trigger(self, message: Fields) -> None:
            self.robot.ask_for_user_status()

        @cop.around(sleec.layers["human_on_floor.hc2"])
        def on_trigger(self, message: Fields) -> None:
            self.robot.ask_companion_to_check()

    return HumanOnFloorNode(sleec, transport, Robot(transport), "HumanOnFloor")


def mealtime(transport: Transport, rules: Path) -> Task:
    sleec = load(rules)

    class MealtimeNode(Task):
        @sleec.rule("mealtime")
        @cop.base
        def on_trigger(self, message: Fields) -> None:
            self.robot.inform_user()

        @cop.around(sleec.layers["mealtime.hc1"])
        def on_trigger(self, message: Fields) -> None:
            self.robot.remind_later()

    return MealtimeNode(sleec, transport, Robot(transport), "MonitorMealTime")


def daisy_addressing(transport: Transport, rules: Path) -> Task:
    sleec = load(rules)

    class AddressingNode(Task):
        @sleec.rule("daisy_addressing")
        @cop.base
        def on_trigger(self, message: Fields) -> None:
            self.robot.use_preferred_name()

        @cop.around(sleec.layers["daisy_addressing.hc1"])
        def on_trigger(self, message: Fields) -> None:
            self.robot.address_sir_or_madam()

        @cop.around(sleec.layers["daisy_addressing.hc2"])
        def on_trigger(self, message: Fields) -> None:
            self.robot.use_user_chosen_name()

    return AddressingNode(sleec, transport, Robot(transport), "AddressUserName")


def daisy_instruction(transport: Transport, rules: Path) -> Task:
    sleec = load(rules)

    class InstructionNode(Task):
        @sleec.rule("daisy_instruction")
        @cop.base
        def on_trigger(self, message: Fields) -> None:
            self.robot.repeat_instruction()

        @cop.around(sleec.layers["daisy_instruction.hc1"])
        def on_trigger(self, message: Fields) -> None:
            self.robot.call_support()

    return InstructionNode(sleec, transport, Robot(transport), "InstructionFail")


def daisy_examination(transport: Transport, rules: Path) -> Task:
    sleec = load(rules)

    class ExaminationNode(Task):
        @sleec.rule("daisy_examination")
        @cop.base
        def on_trigger(self, message: Fields) -> None:
            self.robot.ensure_private_space()

        @cop.around(sleec.layers["daisy_examination.hc1"])
        def on_trigger(self, message: Fields) -> None:
            self.robot.ask_legal_presence()

    return ExaminationNode(sleec, transport, Robot(transport), "PreparingExamination")


def dress_assist(transport: Transport, rules: Path) -> Task:
    sleec = load(rules)

    class CurtainsNode(Task):
        @sleec.rule("dress_assist")
        @cop.base
        def on_trigger(self, message: Fields) -> None:
            self.robot.open_curtains()

        @cop.around(sleec.layers["dress_assist.hc1"])
        def on_trigger(self, message: Fields) -> None:
            self.robot.refuse_request()
            self.robot.explain_why()

        @cop.around(sleec.layers["dress_assist.hc2"])
        def on_trigger(self, message: Fields) -> None:
            self.robot.warn_user()
            self.robot.open_curtains()

    return CurtainsNode(sleec, transport, Robot(transport), "CurtainOpenRequest")


def dressing_started(transport: Transport, rules: Path) -> Task:
    sleec = load(rules)

    class DressingStartedNode(Task):
        @sleec.rule("dressing_started")
        @cop.base
        def on_trigger(self, message: Fields) -> None:
            self.robot.close_door()

        @cop.around(sleec.layers["dressing_started.hc1"])
        def on_trigger(self, message: Fields) -> None:
            self.robot.do_nothing()

    return DressingStartedNode(sleec, transport, Robot(transport), "DressingStarted")


def dressing_stop(transport: Transport, rules: Path) -> Task:
    sleec = load(rules)

    class DressingStopNode(Task):
        @sleec.rule("dressing_stop")
        @cop.base
        def on_trigger(self, message: Fields) -> None:
            self.robot.robot_stop()

        @cop.around(sleec.layers["dressing_stop.hc1"])
        def on_trigger(self, message: Fields) -> None:
            self.robot.ask_to_finish_first()

    return DressingStopNode(sleec, transport, Robot(transport), "UserSaysStop")


TASKS: dict[str, Callable[..., Task]] = {
    "HumanOnFloor": human_on_floor,
    "MonitorMealTime": mealtime,
    "AddressUserName": daisy_addressing,
    "InstructionFail": daisy_instruction,
    "PreparingExamination": daisy_examination,
    "CurtainOpenRequest": dress_assist,
    "DressingStarted": dressing_started,
    "UserSaysStop": dressing_stop,
}
"""The task of each trigger."""
