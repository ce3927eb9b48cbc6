"""The mission: triage in the hospital, then help with dressing at home. It triggers every clause of all eight rules.

A step has a change of context, a trigger, and the expected actions. The exit code is 1 if the robot does something
else. Run the mission by `python -m examples.robot`, which starts the other processes.
"""

# ruff: noqa: T201 - the mission tells what happens

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from queue import Empty, SimpleQueue
from typing import TypeVar

from sleec_runtime.ros import MissionManagerNode
from sleec_runtime.ros.dds.transport import DdsTransport
from sleec_runtime.ros.messages import ConditionsUpdate, Executed, LayersUpdate, MissionEvent

from .rules import sleec
from .tasks import ACTIONS, TASKS

T = TypeVar("T")

PATIENCE = 20.0
"""Seconds after which the mission gives up."""

PAUSE = 0.1
"""Seconds between a change of context and a trigger."""

RECEIVERS = len(TASKS) + 2
"""The subscriptions of triggers that the mission waits for: the tasks, the Context Manager and the recorder."""


@dataclass(frozen=True)
class Step:
    """A step of the mission. `actions` is what the robot does after the trigger."""

    text: str
    conditions: Mapping[str, object] = field(default_factory=dict)
    trigger: str = ""
    actions: tuple[str, ...] = ()
    domain: str | None = None


BEGIN = {
    **dict.fromkeys(sorted(sleec.ruleset.conditions), False),
    "InstructionRepeat": 1,
    "TimeElapsed": 0,
    "UserAge": 40,
    "RiskLevel": "r_low",
}
"""What the sensors report at the beginning. Without a report, a condition is unknown."""


def step(text: str, trigger: str = "", *actions: str, domain: str | None = None, **conditions: object) -> Step:
    return Step(text, conditions, trigger, actions, domain)


MISSION = (
    step("The robot begins its shift in the hospital.", domain="hospital", **BEGIN),
    step("It greets a patient.", "AddressUserName", "UsePreferredName"),
    step("It greets one whose name it does not know.", "AddressUserName", "AddressSirOrMadam", UserNameUnknown=True),
    step("The patient tells a nickname.", "AddressUserName", "UseUserChosenName", UserDirectsOtherwise=True),
    step("The patient did not understand an instruction.", "InstructionFail", "RepeatInstruction", TimeElapsed=2),
    step("It was repeated three times.", "InstructionFail", "CallSupport", InstructionRepeat=3, TimeElapsed=5),
    step("An adult is prepared for an examination.", "PreparingExamination", "EnsurePrivateSpace", UserAge=54),
    step("The next patient is fifteen years old.", "PreparingExamination", "AskLegalPresence", UserAge=15),
    step("Lunch is over.", "MonitorMealTime", "InformUser"),
    step("The patient is on the phone.", "MonitorMealTime", "RemindLater", UserOccupied=True),
    step("Somebody lies on the floor, and does not respond.", "HumanOnFloor", "CallEmergencyServices"),
    step("The robot works at home now.", domain="household"),
    step("The user gets up, and asks for light.", "CurtainOpenRequest", "OpenCurtains"),
    step("The user has undressed, and asks.", "CurtainOpenRequest", "RefuseRequest", "ExplainWhy", UserUndressed=True),
    step("The darkness distresses the user.", "CurtainOpenRequest", "WarnUser", "OpenCurtains", UserDistressed=True),
    step("Dressing begins.", "DressingStarted", "CloseDoor"),
    step("The user prefers an open door.", "DressingStarted", "DoNothing", UserAdvices=True),
    step("The user says stop.", "UserSaysStop", "RobotStop", RiskLevel="r_low"),
    step("The user says stop while on one leg.", "UserSaysStop", "AskToFinishFirst", RiskLevel="r_severe"),
    step("The user falls, and responds.", "HumanOnFloor", "AskForUserStatus", UserResponsive=True),
    step("A visitor is there.", "HumanOnFloor", "AskCompanionToCheck", UserWithCompanion=True),
)


class Mission:
    """Guides the robot through the steps, and compares its actions with the expected ones."""

    def __init__(self, transport: DdsTransport) -> None:
        self._actions: SimpleQueue[str] = SimpleQueue()
        self._executed: SimpleQueue[Executed] = SimpleQueue()
        self._updates: SimpleQueue[LayersUpdate] = SimpleQueue()
        transport.subscribe(ACTIONS, lambda fields: self._actions.put(str(fields["data"])))
        transport.subscribe(LayersUpdate.topic, lambda fields: self._updates.put(LayersUpdate.from_fields(fields)))
        self._sensors = transport.publisher(ConditionsUpdate.topic)
        self._known: dict[str, object] = {}
        self._node = MissionManagerNode(transport, on_executed=self._executed.put)

    def run(self, steps: Sequence[Step]) -> int:
        """Runs the steps, and returns the number of those in which the robot deviates."""
        deviations = 0
        for one in steps:
            print(f"\n{one.text}", flush=True)
            self._change_context(one)
            if one.trigger:
                deviations += not self._trigger(one)
        # The record has to go on for longer than the tolerance of the audit, which is one second. Otherwise, what is
        # missing at the end might only be late.
        time.sleep(1.5)
        self._sensors.publish(ConditionsUpdate(conditions=self._known).to_fields())
        time.sleep(PAUSE)
        return deviations

    def _change_context(self, step: Step) -> None:
        """Changes the domain or the conditions, and waits until the Context Manager has told the tasks."""
        if step.domain is not None:
            print(f"    the domain is {step.domain}")
            self._node.enter_domain(step.domain)
            wait_for(self._updates, lambda update: update.domain == step.domain)
        changes = {name: value for name, value in step.conditions.items() if self._known.get(name) != value}
        if changes:
            self._known.update(changes)
            print(f"    the sensors report {', '.join(map(_assignment, changes.items()))}")
            self._sensors.publish(ConditionsUpdate(conditions=changes).to_fields())
            wait_for(self._updates, lambda update: changes.items() <= update.conditions.items())
        time.sleep(PAUSE)

    def _trigger(self, step: Step) -> bool:
        """Whether the robot executes the expected actions."""
        self._node.start(step.trigger)
        report = wait_for(self._executed, lambda report: report.trigger == step.trigger)
        actions = tuple(wait_for(self._actions) for _ in step.actions)
        while not self._actions.empty():
            actions += (self._actions.get(),)
        clauses = ", ".join(
            f"{rule}.hc{clause}" if clause else f"the default of {rule}" for rule, clause in report.clauses
        )
        print(f"    {step.trigger}: the robot executes {' and '.join(actions)}, by {clauses}", flush=True)
        if actions == step.actions:
            return True
        print(f"    DEVIATION: the robot has to execute {' and '.join(step.actions)}", flush=True)
        return False


def wait_for(queue: SimpleQueue[T], accept: Callable[[T], bool] = lambda _: True) -> T:
    """The next item that is accepted. Ends the mission if there is none in time."""
    end = time.monotonic() + PATIENCE
    while True:
        try:
            item = queue.get(timeout=max(0.0, end - time.monotonic()))
        except Empty:
            sys.exit("    DEVIATION: the robot does not answer")
        if accept(item):
            return item


def _assignment(item: tuple[str, object]) -> str:
    name, value = item
    if isinstance(value, bool):
        return name if value else f"not {name}"
    return f"{name} = {value}"


def main() -> None:
    transport = DdsTransport()
    try:
        mission = Mission(transport)
        triggers = transport.publisher(MissionEvent.topic)
        end = time.monotonic() + PATIENCE
        while (count := triggers.subscription_count()) < RECEIVERS:
            if time.monotonic() > end:
                sys.exit(f"{count} processes receive triggers, and {RECEIVERS} are expected")
            time.sleep(0.01)
        time.sleep(PAUSE)
        deviations = mission.run(MISSION)
    finally:
        transport.close()
    print(f"\nThe mission has ended with {deviations or 'no'} deviation{'s' * (deviations != 1)}.", flush=True)
    sys.exit(deviations > 0)


if __name__ == "__main__":
    try:
        main()
    except KeyboardInterrupt:
        sys.exit(130)
