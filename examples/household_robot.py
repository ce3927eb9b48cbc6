"""A robot for rulesets/household.sleec, in the form of the paper's Listing 2.

Each rule has a method, and each hedge clause a variant. The implementation of an obligation only prints its name. Run
from the top folder of the project:

    python -m examples.household_robot
    sleec-verify conform examples/household_robot.py --ruleset rulesets/household.sleec
"""

# ruff: noqa: F811, T201 - the variants of a method share its name; this robot only prints
# mypy: disable-error-code="no-redef"

from __future__ import annotations

from pathlib import Path

import contextpy3 as cop

import sleec_runtime

sleec = sleec_runtime.load(Path(__file__).parent.parent / "rulesets" / "household.sleec", domain="household")


class Robot:
    """The methods of the rules, followed by the obligations that they call."""

    @sleec.rule("human_on_floor")
    @cop.base
    def human_on_floor(self) -> None:
        self.call_emergency_services()

    @cop.around(sleec.layers["human_on_floor.hc1"])
    def human_on_floor(self) -> None:
        self.ask_for_user_status()

    @cop.around(sleec.layers["human_on_floor.hc2"])
    def human_on_floor(self) -> None:
        self.ask_companion_to_check()

    @sleec.rule("mealtime")
    @cop.base
    def mealtime(self) -> None:
        self.inform_user()

    @cop.around(sleec.layers["mealtime.hc1"])
    def mealtime(self) -> None:
        self.remind_later()

    @sleec.rule("dress_assist")
    @cop.base
    def open_curtains_request(self) -> None:
        self.open_curtains()

    @cop.around(sleec.layers["dress_assist.hc1"])
    def open_curtains_request(self) -> None:
        self.refuse_request()
        self.explain_why()

    @cop.around(sleec.layers["dress_assist.hc2"])
    def open_curtains_request(self) -> None:
        self.warn_user()
        self.open_curtains()

    @sleec.rule("dressing_started")
    @cop.base
    def dressing_started(self) -> None:
        self.close_door()

    @cop.around(sleec.layers["dressing_started.hc1"])
    def dressing_started(self) -> None:
        self.do_nothing()

    @sleec.rule("dressing_stop")
    @cop.base
    def user_says_stop(self) -> None:
        self.robot_stop()

    @cop.around(sleec.layers["dressing_stop.hc1"])
    def user_says_stop(self) -> None:
        self.ask_to_finish_first()

    # What implements the obligations: the methods that have their names in snake case.

    def call_emergency_services(self) -> None:
        print("CallEmergencyServices")

    def ask_for_user_status(self) -> None:
        print("AskForUserStatus")

    def ask_companion_to_check(self) -> None:
        print("AskCompanionToCheck")

    def inform_user(self) -> None:
        print("InformUser")

    def remind_later(self) -> None:
        print("RemindLater")

    def open_curtains(self) -> None:
        print("OpenCurtains")

    def refuse_request(self) -> None:
        print("RefuseRequest")

    def explain_why(self) -> None:
        print("ExplainWhy")

    def warn_user(self) -> None:
        print("WarnUser")

    def close_door(self) -> None:
        print("CloseDoor")

    def do_nothing(self) -> None:
        print("DoNothing")

    def robot_stop(self) -> None:
        print("RobotStop")

    def ask_to_finish_first(self) -> None:
        print("AskToFinishFirst")


def main() -> None:
    """The curtains are asked for twice; in between, the user undresses."""
    sleec.bind(Robot())
    sleec.trigger("CurtainOpenRequest")
    sleec.update({"UserUndressed": True})
    sleec.trigger("CurtainOpenRequest")


if __name__ == "__main__":
    main()
