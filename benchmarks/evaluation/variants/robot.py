"""The actions of the robot. As in the paper, each is replaced by a logging statement."""

from __future__ import annotations

import json
from time import monotonic_ns

from sleec_runtime.ros.transport import Topic, Transport

ROBOT_LOG = Topic("/robot_log", depth=1_000)
"""What the robot did: `action`, and `time` in nanoseconds of the clock that all processes of a computer share."""


class Robot:
    """The robot's actions, one for each obligation of the rules. The message of the trigger is not used."""

    def __init__(self, transport: Transport) -> None:
        self._log = transport.publisher(ROBOT_LOG)

    def call_emergency_services(self, *_: object) -> None:
        self._did("CallEmergencyServices")

    def ask_for_user_status(self, *_: object) -> None:
        self._did("AskForUserStatus")

    def ask_companion_to_check(self, *_: object) -> None:
        self._did("AskCompanionToCheck")

    def inform_user(self, *_: object) -> None:
        self._did("InformUser")

    def remind_later(self, *_: object) -> None:
        self._did("RemindLater")

    def use_preferred_name(self, *_: object) -> None:
        self._did("UsePreferredName")

    def address_sir_or_madam(self, *_: object) -> None:
        self._did("AddressSirOrMadam")

    def use_user_chosen_name(self, *_: object) -> None:
        self._did("UseUserChosenName")

    def repeat_instruction(self, *_: object) -> None:
        self._did("RepeatInstruction")

    def call_support(self, *_: object) -> None:
        self._did("CallSupport")

    def ensure_private_space(self, *_: object) -> None:
        self._did("EnsurePrivateSpace")

    def ask_legal_presence(self, *_: object) -> None:
        self._did("AskLegalPresence")

    def open_curtains(self, *_: object) -> None:
        self._did("OpenCurtains")

    def refuse_request(self, *_: object) -> None:
        self._did("RefuseRequest")

    def explain_why(self, *_: object) -> None:
        self._did("ExplainWhy")

    def warn_user(self, *_: object) -> None:
        self._did("WarnUser")

    def close_door(self, *_: object) -> None:
        self._did("CloseDoor")

    def do_nothing(self, *_: object) -> None:
        self._did("DoNothing")

    def robot_stop(self, *_: object) -> None:
        self._did("RobotStop")

    def ask_to_finish_first(self, *_: object) -> None:
        self._did("AskToFinishFirst")

    def _did(self, action: str) -> None:
        time = monotonic_ns()
        self._log.publish({"data": json.dumps({"action": action, "time": time})})
