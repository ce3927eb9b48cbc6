"""Mutants of completions, of prohibitions, of values and of the runtime."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from sleec_runtime import Sleec, VirtualClock, obligation
from sleec_runtime.dispatch.recording import recorded
from sleec_runtime.errors import Prohibited
from sleec_runtime.language import parse
from tests.support.timed_mutants.registry import mutant
from tests.support.timed_mutants.robot import DOMAIN, RULES, SLOW, TEXT, Response, Robot, Task

# Completions ----------------------------------------------------------------------------------------------------------


@mutant("not required", "CallAmbulance Right Apologise Sing", "fall ask either")
class CompletionNotReported(Robot):
    """It does not notice that the nurse came."""

    def completed(self, name: str) -> None:
        self.follow(name)


@mutant("not required", "CallAmbulance Apologise Sing Right", "fall ask either")
class LastSecondIsLate(Robot):
    """A completion at the last second of a window does not count."""

    def discharges(self, task: Task, now: int) -> bool:
        return super().discharges(task, now) and (task.last is None or now < task.last or task.first == task.last)


@mutant("not required", "CallAmbulance Apologise Sing", "fall ask")
class OneCompletionForOneTrigger(Robot):
    """One completion fulfils only one of two pending obligations."""

    def happened(self, name: str) -> None:
        open_ones = [t for t in self.tasks if t.response.name == name and self.discharges(t, self.clock.now())]
        for task in [t for t in open_ones if t.state != "done"][:1]:
            task.state = "done"
        self.follow(name)


@mutant("missing", "CallAmbulance Apologise Sing Left CallPolice OfferWalk Light", "fall ask either walk light")
class AnyCompletionWillDo(Robot):
    """Whatever completes fulfils everything."""

    def happened(self, name: str) -> None:
        for task in self.tasks:
            if self.discharges(task, self.clock.now()):
                task.state = "done"
        self.follow(name)


@mutant("missing", "Light OfferWalk", "light walk")
class DischargedBeforeItsWindow(Robot):
    """What is done before a window opens counts for it."""

    def discharges(self, task: Task, now: int) -> bool:
        return task.last is None or now <= task.last


# Prohibitions ---------------------------------------------------------------------------------------------------------


class _Prohibition(Robot):
    first, last = 0, 3600

    def forbidden(self, trigger: str) -> list[tuple[str, int, int]]:
        return [(name, self.first, self.last) for name, _, _ in super().forbidden(trigger)]


@mutant("forbidden", "Vacuum", "rest")
class ProhibitionEndsEarly(_Prohibition):
    """The prohibition ends one second early."""

    last = 3599


@mutant("rejected", "DustSeen", "dust")
class ProhibitionEndsLate(_Prohibition):
    """The prohibition lasts one second longer."""

    last = 3601


@mutant("forbidden", "Vacuum", "rest")
class ProhibitionStartsLate(_Prohibition):
    """The prohibition begins one second after the trigger."""

    first = 1


@mutant("forbidden", "Vacuum", "rest")
class ProhibitionInMinutes(_Prohibition):
    """The hour is 60 seconds long."""

    last = 60


@mutant("forbidden", "Vacuum", "rest")
class ProhibitionIgnored(Robot):
    """It vacuums whenever there is dust."""

    def is_banned(self, name: str) -> bool:
        return False


@mutant("forbidden", "Vacuum", "rest")
class ProhibitionLiftedByATrigger(Robot):
    """The next trigger ends all prohibitions."""

    def trigger_all(self, names: Any) -> None:
        self.bans.clear()
        super().trigger_all(names)


@mutant("rejected", "DustSeen Ask UserFell Morning Guest Bell Choice Alarm UserSleeps Open", "")
class RejectsWhileBusy(Robot):
    """It rejects every trigger while something is pending."""

    def trigger_all(self, names: Any) -> None:
        if any(task.state == "under way" for task in self.tasks):
            raise Prohibited("busy", next(iter(names)), None, "wait")
        super().trigger_all(names)


# Values ---------------------------------------------------------------------------------------------------------------


@mutant("missing, not required", "Apologise Sing", "ask")
class MeasureReadAtTheDeadline(Robot):
    """The patience of the deadline counts, not that of the trigger."""

    def close(self, task: Task) -> None:
        if task.response.name == "Answer":
            last = task.since + self.patience()
            if last > self.clock.now():
                task.last = last
                self.at(last, lambda: self.close(task))
                return
        super().close(task)


@mutant("missing, not required", "Apologise Sing", "ask")
class MeasureInMinutes(Robot):
    """The patience is taken as minutes."""

    def patience(self) -> int:
        return super().patience() * 60


@mutant("missing, not required", "Apologise Sing", "ask")
class HedgeReadAtTheDeadline(Robot):
    """Whether the user is alone is read at the deadline."""

    def missed(self, task: Task) -> None:
        if task.response.name == "Answer":
            task.response.otherwise = self.excuse()
        super().missed(task)


@mutant("missing, not required", "OfferWalk OfferGame", "walk")
class HedgeIgnored(Robot):
    """It offers a walk in the rain."""

    def morning(self) -> list[Response]:
        return [Response("OfferWalk", 600, 3600)]


@mutant("missing, not required", "Light", "light")
class HedgeOfAnotherRule(Robot):
    """The light has the exception of the walk."""

    def required(self, trigger: str) -> list[Response]:
        if trigger == "Open":
            return [] if self.known.get("Raining") else [Response("Light", 5, 9)]
        return super().required(trigger)


@mutant("missing, not required", "Sing Apologise OfferGame OfferWalk Light", "ask walk light")
class UnknownStaysKnown(Robot):
    """A value that is no longer known is kept."""

    def update(self, changes: Mapping[str, object]) -> None:
        super().update({name: value for name, value in changes.items() if value is not None})


@mutant("not required, missing", "Report CallNeighbour", "alarm_at_home")
class WrongDomain(Robot):
    """At home, it follows the rules of the ward."""

    def alarm(self) -> list[Response]:
        return [Response("Report", 0, 20)]


@mutant("missing", "Light", "light")
class NoChains(Robot):
    """When it opens the door, it forgets the light."""

    def follow(self, name: str) -> None:
        return


# Mutants of the runtime -----------------------------------------------------------------------------------------------


def on_runtime(clock: Any, text: str = TEXT, domain: str = DOMAIN) -> Sleec:
    """The runtime, with these rules."""
    rules = RULES if text == TEXT else parse(text)
    sleec = Sleec(rules, domain, clock=clock, chains=True, on_error=lambda failure: None)
    for name in sorted(rules.obligations):
        sleec.implement({name: obligation(name, completes=name not in SLOW)(recorded(name, lambda: None))})
    return sleec


class _LateAlarms:
    """A clock whose alarms go off one second late."""

    def __init__(self, clock: VirtualClock) -> None:
        self.now = clock.now
        self.clock = clock

    def wake(self, at: Any, call: Callable[[], object]) -> Callable[[], None]:
        return self.clock.wake(at + 1, call)


@mutant("missing, rejected", "Vacuum CallPolice Apologise Sing DustSeen OfferGame", "fall ask dust")
def late_alarms(clock: Any) -> Sleec:
    """The clock wakes the runtime one second late."""
    return on_runtime(_LateAlarms(clock))


@mutant("missing", "CallPolice", "fall")
def other_rules(clock: Any) -> Sleec:
    """The runtime has an older version of the rules."""
    return on_runtime(clock, TEXT.replace("CallAmbulance WITHIN 1 minute", "CallAmbulance WITHIN 2 minutes"))


@mutant("not required, missing", "Report CallNeighbour", "alarm_at_home")
def other_domain(clock: Any) -> Sleec:
    """The runtime follows the rules of another domain."""
    return on_runtime(clock, domain="ward")
