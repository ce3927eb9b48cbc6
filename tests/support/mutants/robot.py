"""A correct robot, hand-written as the paper's Listing 2 has it, for rules with something of everything."""

# ruff: noqa: F811 - the variants of a method share its name
# mypy: disable-error-code="no-redef"
from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import cache
from typing import Any

import contextpy3 as cop

from sleec_runtime import Sleec
from sleec_runtime.language import parse
from tests.support.robots import Log, listing_2

DOMAIN = "household"
RULES = """
READING cascade
MEASURE UserAge: number
MEASURE Risk: low < moderate < severe
CONSTANT LegalAge = 18
EXCLUSIVE RefuseRequest, Stop
ASSUME NOT (Asleep AND Walking)

RULE curtains WHEN CurtainRequest THEN OpenCurtains
UNLESS Undressed IN WHICH CASE (RefuseRequest AND ExplainWhy)
UNLESS Distressed IN WHICH CASE (WarnUser AND OpenCurtains)

RULE record WHEN CurtainRequest THEN WriteLog
UNLESS Asleep IN WHICH CASE (WriteLog AND NOT Speak)

RULE fall WHEN Fall AND NOT Asleep THEN CallNurse
UNLESS Responsive IN WHICH CASE (AskStatus UNLESS Companion IN WHICH CASE AskCompanion)
UNLESS UserAge < LegalAge IN WHICH CASE CallGuardian

RULE stop WHEN StopSaid THEN Stop
UNLESS Risk > low IN WHICH CASE FinishFirst

RULE greet WHEN Arrival AND Walking THEN Greet
UNLESS Undressed OR Distressed

DOMAIN hospital
RULE examination WHEN Examination THEN EnsurePrivacy
UNLESS UserAge < LegalAge IN WHICH CASE CallGuardian

DOMAIN household
RULE meal WHEN Mealtime THEN Inform
UNLESS Busy IN WHICH CASE RemindLater
"""

read = cache(parse)
"""A mutant is made many times, always of the same text."""

Make = Callable[[], Sleec]
MUTANTS: dict[str, Make] = {}
"""Every mutant by its name; what is wrong with it stands in the docstring of its factory."""


def mutant(make: Make) -> Make:
    MUTANTS[make.__name__] = make
    return make


class Instance(Sleec):
    """An instance in which one method decides for one trigger and for several, so that a mutant has one place."""

    def trigger(self, name: str, /, *args: Any, **kwargs: Any) -> Any:
        return self.occur((name,))

    def trigger_all(self, names: Iterable[str], /, *args: Any, **kwargs: Any) -> Any:
        return self.occur(tuple(names))

    def occur(self, names: tuple[str, ...]) -> Any:
        return super().trigger_all(names)


def instance(kind: type[Sleec] = Instance, text: str = RULES, **options: Any) -> Sleec:
    """An instance with correct code for the rules of `text`."""
    sleec = kind(read(text), **{"domain": DOMAIN, **options})
    listing_2(sleec)
    return sleec


def reads(*replacements: tuple[str, str], **options: Any) -> Sleec:
    """An instance that is correct for other rules: those in which these texts are replaced."""
    text = RULES
    for old, new in replacements:
        assert old in text
        text = text.replace(old, new)
    return instance(text=text, **options)


def robot_class(sleec: Sleec) -> type[Log]:
    """The robot in code for the rules that the mutants of code are about; the others are composed."""

    class Robot(Log):
        @sleec.rule("curtains")
        @cop.base
        def curtains(self) -> None:
            self.do("OpenCurtains")

        @cop.around(sleec.layers["curtains.hc1"])
        def curtains(self) -> None:
            self.do("RefuseRequest")
            self.do("ExplainWhy")

        @cop.around(sleec.layers["curtains.hc2"])
        def curtains(self) -> None:
            self.do("WarnUser")
            self.do("OpenCurtains")

        @sleec.rule("record")
        @cop.base
        def record(self) -> None:
            self.do("WriteLog")

        @cop.around(sleec.layers["record.hc1"])
        def record(self) -> None:
            self.do("WriteLog")

    return Robot


def coded(mutate: Callable[[Sleec, Any], type[Log]] | None = None) -> Sleec:
    """An instance with the robot, or with a mutant of its class."""
    sleec = Sleec(read(RULES), domain=DOMAIN)
    robot = robot_class(sleec)
    composed = Log()
    sleec.implement({name: lambda name=name: composed.do(name) for name in sleec.ruleset.obligations})
    sleec.bind((mutate(sleec, robot) if mutate else robot)())
    return sleec
