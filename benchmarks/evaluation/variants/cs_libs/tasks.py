"""The Task Manager Nodes of CS-libs: each selects the actions of the clause that the Context Manager Node selected."""

from __future__ import annotations

import json

from benchmarks.evaluation.variants.cs_libs.context_manager import SELECTED
from benchmarks.evaluation.variants.robot import Robot
from benchmarks.evaluation.variants.topics import trigger_topic
from sleec_runtime.ros.transport import Fields, Transport


class TaskManagerNode:
    def __init__(self, transport: Transport, robot: Robot, rule: str, trigger: str) -> None:
        self.robot = robot
        self.rule = rule
        self.selected: int | None = None
        transport.subscribe(SELECTED, self.on_selected)
        transport.subscribe(trigger_topic(trigger), self.on_trigger)

    def on_selected(self, message: Fields) -> None:
        self.selected = json.loads(str(message["data"])).get(self.rule)

    def on_trigger(self, message: Fields) -> None:
        raise NotImplementedError


class HumanOnFloorNode(TaskManagerNode):
    def __init__(self, transport: Transport, robot: Robot) -> None:
        super().__init__(transport, robot, "human_on_floor", "HumanOnFloor")

    def on_trigger(self, message: Fields) -> None:
        if self.selected == 0:
            self.robot.call_emergency_services()
        elif self.selected == 1:
            self.robot.ask_for_user_status()
        elif self.selected == 2:
            self.robot.ask_companion_to_check()


class MealtimeNode(TaskManagerNode):
    def __init__(self, transport: Transport, robot: Robot) -> None:
        super().__init__(transport, robot, "mealtime", "MonitorMealTime")

    def on_trigger(self, message: Fields) -> None:
        if self.selected == 0:
            self.robot.inform_user()
        elif self.selected == 1:
            self.robot.remind_later()


class AddressingNode(TaskManagerNode):
    def __init__(self, transport: Transport, robot: Robot) -> None:
        super().__init__(transport, robot, "daisy_addressing", "AddressUserName")

    def on_trigger(self, message: Fields) -> None:
        if self.selected == 0:
            self.robot.use_preferred_name()
        elif self.selected == 1:
            self.robot.address_sir_or_madam()
        elif self.selected == 2:
            self.robot.use_user_chosen_name()


class InstructionNode(TaskManagerNode):
    def __init__(self, transport: Transport, robot: Robot) -> None:
        super().__init__(transport, robot, "daisy_instruction", "InstructionFail")

    def on_trigger(self, message: Fields) -> None:
        if self.selected == 0:
            self.robot.repeat_instruction()
        elif self.selected == 1:
            self.robot.call_support()


class ExaminationNode(TaskManagerNode):
    def __init__(self, transport: Transport, robot: Robot) -> None:
        super().__init__(transport, robot, "daisy_examination", "PreparingExamination")

    def on_trigger(self, message: Fields) -> None:
        if self.selected == 0:
            self.robot.ensure_private_space()
        elif self.selected == 1:
            self.robot.ask_legal_presence()


class CurtainsNode(TaskManagerNode):
    def __init__(self, transport: Transport, robot: Robot) -> None:
        super().__init__(transport, robot, "dress_assist", "CurtainOpenRequest")

    def on_trigger(self, message: Fields) -> None:
        if self.selected == 0:
            self.robot.open_curtains()
        elif self.selected == 1:
            self.robot.refuse_request()
            self.robot.explain_why()
        elif self.selected == 2:
            self.robot.warn_user()
            self.robot.open_curtains()


class DressingStartedNode(TaskManagerNode):
    def __init__(self, transport: Transport, robot: Robot) -> None:
        super().__init__(transport, robot, "dressing_started", "DressingStarted")

    def on_trigger(self, message: Fields) -> None:
        if self.selected == 0:
            self.robot.close_door()
        elif self.selected == 1:
            self.robot.do_nothing()


class DressingStopNode(TaskManagerNode):
    def __init__(self, transport: Transport, robot: Robot) -> None:
        super().__init__(transport, robot, "dressing_stop", "UserSaysStop")

    def on_trigger(self, message: Fields) -> None:
        if self.selected == 0:
            self.robot.robot_stop()
        elif self.selected == 1:
            self.robot.ask_to_finish_first()


TASKS = {
    "HumanOnFloor": HumanOnFloorNode,
    "MonitorMealTime": MealtimeNode,
    "AddressUserName": AddressingNode,
    "InstructionFail": InstructionNode,
    "PreparingExamination": ExaminationNode,
    "CurtainOpenRequest": CurtainsNode,
    "DressingStarted": DressingStartedNode,
    "UserSaysStop": DressingStopNode,
}
"""The task of each trigger."""
