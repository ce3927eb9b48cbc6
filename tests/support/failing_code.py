"""Robots whose code fails or does not return."""

from __future__ import annotations

import threading

from sleec_runtime import Failure, Sleec, obligation
from sleec_runtime.language import parse

ISSUE = """
RULE a WHEN T1 THEN A WITHIN 1 TO 1000 seconds
RULE b WHEN T2 THEN B WITHIN 2 seconds OTHERWISE C
RULE d WHEN T3 THEN D WITHIN 1 TO 1000 seconds
"""
"""No deadline but that of b is so near that code begins after it on a busy machine."""

QUICK = """
RULE a WHEN A THEN X WITHIN 1 TO 1000 seconds
RULE b WHEN B THEN Y WITHIN 1 TO 1000 seconds
"""


PATIENCE = 20


HASTE = 50


def raising(error: type[BaseException]):
    def code() -> None:
        raise error

    return code


def slow() -> None:
    """Begun, and not done."""


class Robot:
    """Rules at work on a clock of their own, where `a` fails: events say what was done."""

    def __init__(self, a, text: str = ISSUE, **options) -> None:
        self.told: list[Failure] = []
        self.sleec = Sleec(parse(text), on_error=self.told.append, **options)
        self.done = {name: threading.Event() for name in "CD"}
        self.sleec.implement(
            {"A": a, "B": obligation("B", completes=False)(slow), "C": self.do("C"), "D": self.do("D")}
        )

    def do(self, name: str):
        return lambda: self.done[name].set()

    def does(self, name: str) -> bool:
        return self.done[name].wait(PATIENCE)

    def errors(self) -> list[type[BaseException]]:
        return [type(failure.error) for failure in self.sleec.failures]
