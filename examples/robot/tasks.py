"""The tasks of the robot, in the form of the paper's Listing 2. Each task is a process of its own:

    python -m examples.robot.tasks Dressing

Each rule has a method, and each hedge clause a variant. The methods call those of the obligations, which here only say
what they do, on the topic /actions. Yours move motors there.
"""

# ruff: noqa: F811 - the variants of a method share its name
# mypy: disable-error-code="no-redef"

from __future__ import annotations

import sys

import contextpy3 as cop

from sleec_runtime.ros import TaskManagerNode, Topic
from sleec_runtime.ros.transport import Fields, Transport

from .process import run
from .rules import sleec

ACTIONS = Topic("/actions", depth=100)


class Task(TaskManagerNode):
    """What the tasks share. A subclass has the methods of its rules, followed by the obligations that they call."""

    def __init__(self, transport: Transport) -> None:
        self._actions = transport.publisher(ACTIONS)
        super().__init__(type(self).__name__, sleec, transport)

    def do(self, action: str) -> None:
        """The robot does something."""
        self._actions.publish({"data": action})


class Safety(Task):
    """Looks after people who have fallen, and after meals."""

    @sleec.rule("human_on_floor")
    @cop.base
    def human_on_floor(self, message: Fields) -> None:
        self.call_emergency_services()

    @cop.around(sleec.layers["human_on_floor.hc1"])
    def human_on_floor(self, message: Fields) -> None:
        self.ask_for_user_status()

    @cop.around(sleec.layers["human_on_floor.hc2"])
    def human_on_floor(self, message: Fields) -> None:
        self.ask_companion_to_check()

    @sleec.rule("mealtime")
    @cop.base
    def mealtime(self, message: Fields) -> None:
        self.inform_user()

    @cop.around(sleec.layers["mealtime.hc1"])
    def mealtime(self, message: Fields) -> None:
        self.remind_later()

    # What implements the obligations: the methods that have their names in snake case.

    def call_emergency_services(self) -> None:
        self.do("CallEmergencyServices")

    def ask_for_user_status(self) -> None:
        self.do("AskForUserStatus")

    def ask_companion_to_check(self) -> None:
        self.do("AskCompanionToCheck")

    def inform_user(self) -> None:
        self.do("InformUser")

    def remind_later(self) -> None:
        self.do("RemindLater")


class Triage(Task):
    """Addresses the patient, gives instructions, and prepares the examination. In the hospital only."""

    @sleec.rule("daisy_addressing")
    @cop.base
    def address_user(self, message: Fields) -> None:
        self.use_preferred_name()

    @cop.around(sleec.layers["daisy_addressing.hc1"])
    def address_user(self, message: Fields) -> None:
        self.address_sir_or_madam()

    @cop.around(sleec.layers["daisy_addressing.hc2"])
    def address_user(self, message: Fields) -> None:
        self.use_user_chosen_name()

    @sleec.rule("daisy_instruction")
    @cop.base
    def instruction_fail(self, message: Fields) -> None:
        self.repeat_instruction()

    @cop.around(sleec.layers["daisy_instruction.hc1"])
    def instruction_fail(self, message: Fields) -> None:
        self.call_support()

    @sleec.rule("daisy_examination")
    @cop.base
    def preparing_examination(self, message: Fields) -> None:
        self.ensure_private_space()

    @cop.around(sleec.layers["daisy_examination.hc1"])
    def preparing_examination(self, message: Fields) -> None:
        self.ask_legal_presence()

    # What implements the obligations: the methods that have their names in snake case.

    def use_preferred_name(self) -> None:
        self.do("UsePreferredName")

    def address_sir_or_madam(self) -> None:
        self.do("AddressSirOrMadam")

    def use_user_chosen_name(self) -> None:
        self.do("UseUserChosenName")

    def repeat_instruction(self) -> None:
        self.do("RepeatInstruction")

    def call_support(self) -> None:
        self.do("CallSupport")

    def ensure_private_space(self) -> None:
        self.do("EnsurePrivateSpace")

    def ask_legal_presence(self) -> None:
        self.do("AskLegalPresence")


class Dressing(Task):
    """Helps the user to dress. At home only."""

    @sleec.rule("dress_assist")
    @cop.base
    def open_curtains_request(self, message: Fields) -> None:
        self.open_curtains()

    @cop.around(sleec.layers["dress_assist.hc1"])
    def open_curtains_request(self, message: Fields) -> None:
        self.refuse_request()
        self.explain_why()

    @cop.around(sleec.layers["dress_assist.hc2"])
    def open_curtains_request(self, message: Fields) -> None:
        self.warn_user()
        self.open_curtains()

    @sleec.rule("dressing_started")
    @cop.base
    def dressing_started(self, message: Fields) -> None:
        self.close_door()

    @cop.around(sleec.layers["dressing_started.hc1"])
    def dressing_started(self, message: Fields) -> None:
        self.do_nothing()

    @sleec.rule("dressing_stop")
    @cop.base
    def user_says_stop(self, message: Fields) -> None:
        self.robot_stop()

    @cop.around(sleec.layers["dressing_stop.hc1"])
    def user_says_stop(self, message: Fields) -> None:
        self.ask_to_finish_first()

    # What implements the obligations: the methods that have their names in snake case.

    def open_curtains(self) -> None:
        self.do("OpenCurtains")

    def refuse_request(self) -> None:
        self.do("RefuseRequest")

    def explain_why(self) -> None:
        self.do("ExplainWhy")

    def warn_user(self) -> None:
        self.do("WarnUser")

    def close_door(self) -> None:
        self.do("CloseDoor")

    def do_nothing(self) -> None:
        self.do("DoNothing")

    def robot_stop(self) -> None:
        self.do("RobotStop")

    def ask_to_finish_first(self) -> None:
        self.do("AskToFinishFirst")


TASKS = {task.__name__: task for task in (Safety, Triage, Dressing)}

if __name__ == "__main__":
    if len(sys.argv) != 2 or sys.argv[1] not in TASKS:
        sys.exit(f"usage: python -m examples.robot.tasks {{{','.join(TASKS)}}}")
    run(TASKS[sys.argv[1]])
