"""Robots that are restarted with what was pending."""

from __future__ import annotations

import json
from collections.abc import Callable
from typing import Any

from sleec_runtime import Sleec, VirtualClock, obligation
from sleec_runtime.language import parse

SAVED_AT = 1_764_000_000


RULES = """
CONDITION Awake
MEASURE Age: number
MEASURE Risk: low < high
MEASURE wait: integer
RULE fall WHEN Fall THEN CallNurse WITHIN 5 minutes OTHERWISE CallAmbulance WITHIN 1 minute OTHERWISE CallPolice
RULE rest WHEN Sleep THEN NOT Vacuum WITHIN 1 hour
RULE nap WHEN Nap THEN NOT Vacuum WITHIN 2 TO 5 seconds OTHERWISE Apologise
RULE dust WHEN Dust THEN Vacuum
RULE clean WHEN Evening THEN Vacuum WITHIN 3 seconds
RULE walk WHEN Morning THEN OfferWalk WITHIN 10 TO 60 seconds AND Open WITHIN 20 TO 60 seconds
RULE wash WHEN Noon THEN Wash WITHIN 2 TO 2 seconds OTHERWISE Apologise
RULE some WHEN Guest THEN Greet EVENTUALLY
RULE ask WHEN Ask THEN Answer WITHIN wait seconds OTHERWISE (Apologise UNLESS Awake AND Age > 36.5 AND Risk = high)
RULE either WHEN Choice THEN Left WITHIN 4 seconds ELSE Right WITHIN 8 seconds
"""


SLOW = ("CallNurse", "Answer", "Greet", "Left")


class Robot:
    """An instance on a clock of its own, which starts anywhere, with a log of what it has begun."""

    def __init__(self, text: str = RULES, start: object = 100, slow: tuple[str, ...] = SLOW, **options: Any) -> None:
        self.clock = VirtualClock(start)  # type: ignore[arg-type]
        self.log: list[tuple[object, ...]] = []
        self.broken: set[str] = set()
        ruleset = parse(text)
        self.sleec = Sleec(ruleset, clock=self.clock, on_error=lambda failure: None, **options)
        for name in sorted(ruleset.obligations):
            self.sleec.implement({name: self.code(name, name in slow)})

    def code(self, name: str, slow: bool) -> Callable[..., None]:
        @obligation(name, completes=not slow)
        def function(*args: object, **kwargs: object) -> None:
            self.log.append((name, *args, *kwargs.items()))
            if name in self.broken:
                raise OSError(name)

        return function

    def taken(self) -> list[str]:
        log, self.log = self.log, []
        return [str(entry[0]) for entry in log]

    def pending(self) -> list[str]:
        return [str(one) for one in self.sleec.pending()]

    def failures(self) -> list[str]:
        return [str(one) for one in self.sleec.failures]

    def saved(self) -> Any:
        return json.loads(json.dumps(self.sleec.pending_snapshot(SAVED_AT), allow_nan=False))


def restarted(robot: Robot, down: object = 0, text: str = RULES, **options: Any) -> Robot:
    """Another robot that takes over after `down` seconds."""
    other = Robot(text, start=1_000_000, **options)
    other.sleec.update(dict(robot.sleec.conditions))
    before = robot.pending()
    other.sleec.restore(robot.saved(), SAVED_AT + down)  # type: ignore[operator]
    if down == 0:
        assert other.pending() == before
        assert other.saved() == robot.saved()
    return other
