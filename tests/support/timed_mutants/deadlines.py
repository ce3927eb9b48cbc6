"""Mutants of deadlines, of starts and of alternatives."""

from __future__ import annotations

from typing import Any

from tests.support.timed_mutants.registry import mutant
from tests.support.timed_mutants.robot import Response, Robot, Task

# Deadlines ------------------------------------------------------------------------------------------------------------


@mutant("missing", "CallPolice Apologise Sing", "fall ask")
class DeadlineOneSecondLate(Robot):
    """A missed deadline is noticed one second late."""

    def closing_time(self, task: Task) -> int:
        return super().closing_time(task) + 1


@mutant("not required", "CallAmbulance CallPolice Apologise Sing", "fall ask")
class DeadlineOneSecondEarly(Robot):
    """A deadline counts as missed one second too early."""

    def closing_time(self, task: Task) -> int:
        return max(int(self.clock.now()), super().closing_time(task) - 1)


@mutant("missing", "CallPolice", "fall")
class MinutesForSeconds(Robot):
    """The ambulance has 60 minutes instead of 60 seconds."""

    def fell(self) -> list[Response]:
        return [Response("CallNurse", 0, 300, Response("CallAmbulance", 0, 3600, Response("CallPolice")))]


@mutant("missing", "CallAmbulance Apologise Sing CallPolice Left", "fall ask either")
class DeadlineOfTheFirstTrigger(Robot):
    """While an obligation is pending, another trigger starts no deadline of its own."""

    def begin(self, response: Response, due: int) -> None:
        if not any(task.response.name == response.name and task.state == "under way" for task in self.tasks):
            super().begin(response, due)


@mutant("missing", "CallAmbulance CallPolice Left Apologise Sing", "fall either ask")
class DeadlineOfTheLastTrigger(Robot):
    """Another trigger starts the deadline anew."""

    def begin(self, response: Response, due: int) -> None:
        for task in self.tasks:
            if task.response.name == response.name and task.state == "under way":
                task.state = "closed"
        super().begin(response, due)


@mutant("missing", "CallAmbulance CallPolice Left Apologise Sing", "fall either ask")
class CancelledByASecondTrigger(Robot):
    """A second trigger cancels what is pending, and nothing replaces it."""

    def begin(self, response: Response, due: int) -> None:
        pending = [t for t in self.tasks if t.response.name == response.name and t.state == "under way"]
        for task in pending:
            task.state = "closed"
        if not pending:
            super().begin(response, due)


@mutant("missing", "CallAmbulance Apologise Sing CallPolice", "fall ask")
class CancelledByAnyTrigger(Robot):
    """Each trigger makes the robot forget what is pending."""

    def trigger_all(self, names: Any) -> None:
        for task in self.tasks:
            if task.state == "under way":
                task.state = "closed"
        super().trigger_all(names)


# Starts ---------------------------------------------------------------------------------------------------------------


@mutant("missing", "Vacuum CallPolice Apologise Sing", "dust fall ask")
class StartedOneSecondLate(Robot):
    """Everything starts one second late."""

    def starting_time(self, task: Task) -> int:
        return task.first + 1


@mutant("not required", "OfferWalk Light", "walk light")
class StartedOneSecondEarly(Robot):
    """A window that opens later opens one second early."""

    def starting_time(self, task: Task) -> int:
        return max(task.since, task.first - 1)


@mutant("not required", "OfferWalk Light", "walk light")
class StartedAtTheTrigger(Robot):
    """The start of a window is ignored."""

    def starting_time(self, task: Task) -> int:
        return task.since


@mutant("not required", "Vacuum", "dust")
class ExecutedTwice(Robot):
    """It vacuums twice."""

    def do(self, name: str) -> None:
        super().do(name)
        if name == "Vacuum":
            super().do(name)


@mutant("missing", "Greet", "guest")
class NeverEventually(Robot):
    """What has no deadline is never done."""

    def start(self, task: Task) -> None:
        if task.last is not None:
            super().start(task)


@mutant("missing", "Vacuum OfferGame CallNeighbour Greet Open", "dust walk alarm_at_home guest bell")
class OneTriggerOfSeveral(Robot):
    """Of several triggers at once, it sees the first."""

    def trigger_all(self, names: Any) -> None:
        super().trigger_all(list(names)[:1])


# Alternatives ---------------------------------------------------------------------------------------------------------


@mutant("missing", "CallAmbulance Apologise Sing", "fall ask")
class NoOtherwise(Robot):
    """Nothing follows a missed deadline."""

    def missed(self, task: Task) -> None:
        if task.response.otherwise is None:
            super().missed(task)


@mutant("missing", "CallPolice", "fall")
class NoSecondOtherwise(Robot):
    """The ambulance is the last resort."""

    def fell(self) -> list[Response]:
        return [Response("CallNurse", 0, 300, Response("CallAmbulance", 0, 60))]


@mutant("not required", "CallAmbulance CallPolice Apologise Sing", "fall ask")
class OtherwiseDespiteSuccess(Robot):
    """It calls the ambulance although the nurse came."""

    def close(self, task: Task) -> None:
        if task.state != "closed":
            task.state = "closed"
            self.missed(task)


@mutant("not required, missing", "CallPolice CallAmbulance", "fall")
class WrongOtherwise(Robot):
    """It calls the police instead of the ambulance."""

    def fell(self) -> list[Response]:
        return [Response("CallNurse", 0, 300, Response("CallPolice", 0, 60, Response("CallAmbulance")))]


@mutant("not required", "CallAmbulance", "fall")
class OtherwiseAtOnce(Robot):
    """It calls the nurse and the ambulance together."""

    def fell(self) -> list[Response]:
        return [Response("CallNurse", 0, 300), Response("CallAmbulance", 0, 60, Response("CallPolice"))]


@mutant("missing", "Left", "either")
class NoElse(Robot):
    """It never tries the right."""

    def begin_instead(self, response: Response, task: Task) -> None:
        return


@mutant("not required", "Right", "either")
class ElseDespiteSuccess(Robot):
    """After the left, it takes the right as well."""

    def happened(self, name: str) -> None:
        super().happened(name)
        if name == "Left":
            self.do("Right")


@mutant("missing", "CallPolice", "fall")
class FailureCountsAsDone(Robot):
    """An exception of the ambulance is swallowed."""

    def start(self, task: Task) -> None:
        super().start(task)
        if task.state == "failed" or (task.state == "under way" and task.response.name == "CallAmbulance"):
            task.state = "done"
