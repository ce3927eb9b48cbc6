"""Calls and errors at every step of a dispatch."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from pathlib import Path

import contextpy3 as cop

import sleec_runtime
from sleec_runtime import Sleec, obligation
from sleec_runtime.language import parse

RUNTIME = str(Path(sleec_runtime.__file__).parent) + os.sep


ISSUE = parse("""
RULE a WHEN T1 THEN A WITHIN 1 TO 5 seconds
RULE b WHEN T2 THEN B WITHIN 2 seconds OTHERWISE C
RULE d WHEN T3 THEN D WITHIN 1 TO 3 seconds
RULE e WHEN T4 THEN NOT D WITHIN 9 seconds UNLESS Calm
""")


MILD = parse("RULE a WHEN T1 THEN A WITHIN 1 TO 5 seconds\nRULE b WHEN T2 THEN C UNLESS Calm IN WHICH CASE D")


class Ticking:
    """A clock that is moved by hand, and wakes nobody."""

    def __init__(self) -> None:
        self.time = 0

    def now(self) -> int:
        return self.time

    def wake(self, at, call):
        return lambda: None


class Robot:
    """The rules of the issue at work: `log` has what was executed."""

    def __init__(self, ruleset=ISSUE, clock: Ticking | None = None) -> None:
        self.clock = clock or Ticking()
        self.log: list[str] = []
        self.told: list[str] = []
        self.sleec = Sleec(ruleset, clock=self.clock, on_error=self.report)
        self.code = {name: self.callable(name) for name in "ABCD"}
        self.sleec.implement({name: self.code[name] for name in ruleset.obligations})
        self.triggers = sorted(ruleset.triggers - {"T4"})

    def callable(self, name: str):
        return obligation(name, completes=name != "B")(lambda: self.log.append(name))

    def report(self, failure: sleec_runtime.Failure) -> None:
        self.told += failure.obligations

    def bound(self) -> object:
        @self.sleec.rule("a")
        @cop.base
        def method() -> None:
            self.log.append("A")

        return method

    def asked(self) -> list[str]:
        return sorted(str(one) for one in self.sleec.pending())


def lines(stride: int = 1) -> Iterator[int]:
    return iter(range(1, 1_000_000, stride))


ACTS: dict[str, Callable[[Robot], object]] = {
    "trigger": lambda robot: robot.sleec.trigger_all(robot.triggers),
    "tick": lambda robot: robot.sleec.tick(),
    "completed": lambda robot: robot.sleec.completed("B"),
    "pending": lambda robot: robot.sleec.pending(),
    "update": lambda robot: robot.sleec.update({"Calm": True}),
    "bind": lambda robot: robot.sleec.bind(robot.bound()),
    "implement": lambda robot: robot.sleec.implement({"A": robot.code["A"]}),
    "replace": lambda robot: robot.sleec.replace(MILD),
    "close": lambda robot: robot.sleec.close(),
}


def prepared(ruleset=ISSUE, clock: Ticking | None = None) -> Robot:
    """Something is about to open and to close, and something can be completed."""
    robot = Robot(ruleset, clock)
    robot.sleec.trigger("T1")
    robot.sleec.trigger("T2")
    robot.clock.time = 2
    return robot
