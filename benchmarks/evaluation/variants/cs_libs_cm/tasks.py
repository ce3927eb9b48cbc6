"""The Task Manager Nodes of CS-libs-CM: each keeps the context, and evaluates its rule when it is triggered."""

from __future__ import annotations

import json
from typing import Any

from benchmarks.evaluation.variants.robot import Robot
from benchmarks.evaluation.variants.topics import CONDITIONS, DOMAIN, trigger_topic
from sleec_runtime.ros.transport import Fields, Transport

LEGAL_AGE = 18
RISKS = ("r_low", "r_moderate", "r_severe")


class TaskManagerNode:
    def __init__(self, transport: Transport, robot: Robot, trigger: str) -> None:
        self.robot = robot
        self.domain: str | None = None
        self.conditions: dict[str, Any] = {}
        transport.subscribe(DOMAIN, self.on_domain)
        transport.subscribe(CONDITIONS, self.on_conditions)
        transport.subscribe(trigger_topic(trigger), self.on_trigger)

    def on_domain(self, message: Fields) -> None:
        self.domain = json.loads(str(message["data"]))["domain"]

    def on_conditions(self, message: Fields) -> None:
        self.conditions.update(json.loads(str(message["data"])))

    def on_trigger(self, message: Fields) -> None:
        raise NotImplementedError


class HumanOnFloorNode(TaskManagerNode):
    def __init__(self, transport: Transport, robot: Robot) -> None:
        super().__init__(transport, robot, "HumanOnFloor")

    def on_trigger(self, message: Fields) -> None:
        if self.conditions.get("UserResponsive"):
            if self.conditions.get("UserWithCompanion"):
                self.robot.ask_companion_to_check()
            else:
                self.robot.ask_for_user_status()
        else:
            self.robot.call_emergency_services()


class MealtimeNode(TaskManagerNode):
    def __init__(self, transport: Transport, robot: Robot) -> None:
        super().__init__(transport, robot, "MonitorMealTime")

    def on_trigger(self, message: Fields) -> None:
        if self.conditions.get("UserOccupied"):
            self.robot.remind_later()
        else:
            self.robot.inform_user()


class AddressingNode(TaskManagerNode):
    def __init__(self, transport: Transport, robot: Robot) -> None:
        super().__init__(transport, robot, "AddressUserName")

    def on_trigger(self, message: Fields) -> None:
        if self.domain == "hospital":
            if self.conditions.get("UserNameUnknown"):
                if self.conditions.get("UserDirectsOtherwise"):
                    self.robot.use_user_chosen_name()
                else:
                    self.robot.address_sir_or_madam()
            else:
                self.robot.use_preferred_name()


class InstructionNode(TaskManagerNode):
    def __init__(self, transport: Transport, robot: Robot) -> None:
        super().__init__(transport, robot, "InstructionFail")

    def on_trigger(self, message: Fields) -> None:
        if self.domain == "hospital":
            repeat = self.conditions.get("InstructionRepeat")
            elapsed = self.conditions.get("TimeElapsed")
            if (repeat is not None and repeat >= 3) or (elapsed is not None and elapsed > 20):
                self.robot.call_support()
            else:
                self.robot.repeat_instruction()


class ExaminationNode(TaskManagerNode):
    def __init__(self, transport: Transport, robot: Robot) -> None:
        super().__init__(transport, robot, "PreparingExamination")

    def on_trigger(self, message: Fields) -> None:
        if self.domain == "hospital":
            age = self.conditions.get("UserAge")
            if age is not None and age < LEGAL_AGE:
                self.robot.ask_legal_presence()
            else:
                self.robot.ensure_private_space()


class CurtainsNode(TaskManagerNode):
    def __init__(self, transport: Transport, robot: Robot) -> None:
        super().__init__(transport, robot, "CurtainOpenRequest")

    def on_trigger(self, message: Fields) -> None:
        if self.domain == "household":
            if self.conditions.get("UserUndressed"):
                if self.conditions.get("UserDistressed"):
                    self.robot.warn_user()
                    self.robot.open_curtains()
                else:
                    self.robot.refuse_request()
                    self.robot.explain_why()
            else:
                self.robot.open_curtains()


class DressingStartedNode(TaskManagerNode):
    def __init__(self, transport: Transport, robot: Robot) -> None:
        super().__init__(transport, robot, "DressingStarted")

    def on_trigger(self, message: Fields) -> None:
        if self.domain == "household":
            if self.conditions.get("MedicalEmergency") or self.conditions.get("UserAdvices"):
                self.robot.do_nothing()
            else:
                self.robot.close_door()


class DressingStopNode(TaskManagerNode):
    def __init__(self, transport: Transport, robot: Robot) -> None:
        super().__init__(transport, robot, "UserSaysStop")

    def on_trigger(self, message: Fields) -> None:
        if self.domain == "household":
            risk = self.conditions.get("RiskLevel")
            if risk is not None and RISKS.index(risk) > RISKS.index("r_low"):
                self.robot.ask_to_finish_first()
            else:
                self.robot.robot_stop()


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
