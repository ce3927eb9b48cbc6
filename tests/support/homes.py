"""A robot at home with rules with time."""

from __future__ import annotations

import sleec_runtime
from sleec_runtime import Sleec, VirtualClock, obligation
from sleec_runtime.language import parse

SMOKE = """
RULE alarm WHEN Smoke THEN CallNurse WITHIN 10 seconds OTHERWISE SoundAlarm
RULE quiet WHEN Sleep THEN NOT SoundAlarm WITHIN 5 seconds
RULE test WHEN Test THEN SoundAlarm
RULE post WHEN Post THEN Fetch WITHIN 3 TO 8 seconds
"""


class Home:
    """Rules at work, with a log of what was begun and when. What is in `slow` is not done when its callable returns,
    what is in `broken` raises."""

    def __init__(self, text: str, slow: tuple[str, ...] = (), **options) -> None:
        self.clock = VirtualClock()
        self.told: list[sleec_runtime.Failure] = []
        self.log: list[tuple[object, str]] = []
        self.broken: set[str] = set()
        self.arguments: list[object] = []
        self.sleec = Sleec(parse(text), clock=self.clock, on_error=self.told.append, **options)
        self.code = {name: self.callable(name, name in slow) for name in sorted(self.sleec.ruleset.obligations)}
        self.sleec.implement(self.code)

    def callable(self, name: str, slow: bool = False):
        @obligation(name, completes=not slow)
        def function(*args: object) -> None:
            self.log.append((self.clock.now(), name))
            self.arguments += args
            if name in self.broken:
                raise OSError(name)

        return function

    def taken(self) -> list[tuple[object, str]]:
        log, self.log = self.log, []
        return log


def shown(pending) -> list[str]:
    return [str(one) for one in pending]


CHAIN = "RULE a WHEN A THEN B\nRULE b WHEN B THEN C WITHIN 5 seconds\nRULE c WHEN C THEN D UNLESS quiet"


def written(text: str, **options):
    clock = VirtualClock()
    return clock, Sleec(parse(text), clock=clock, **options)
