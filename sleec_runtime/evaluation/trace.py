"""Traces: what happens, instant by instant."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from itertools import pairwise
from typing import Literal

from sleec_runtime.errors import WrongType
from sleec_runtime.model import Value

Untimed = Literal["at", "eventually"]
"""When a response without a window is due: at the instant of the trigger, or at any instant from then on."""


@dataclass(frozen=True, slots=True)
class Instant:
    """A time in seconds, the events of that time, and the values of conditions and measures.

    A condition without a value is false, and so is a comparison with a measure that has none.
    """

    time: int
    events: frozenset[str] = frozenset()
    conditions: Mapping[str, Value] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class Trace:
    """Instants in order of time. Nothing happens between them and after the last.

    Raises WrongType for a time that is not a whole number from 0 on, or not later than the one before.
    """

    instants: tuple[Instant, ...]

    def __post_init__(self) -> None:
        for instant in self.instants:
            if type(instant.time) is not int or instant.time < 0:
                raise WrongType("the time of an instant", instant.time, "a whole number of seconds, from 0 on")
        for earlier, later in pairwise(self.instants):
            if later.time <= earlier.time:
                raise WrongType(
                    "the time of an instant",
                    later.time,
                    f"later than that of the instant before it, {earlier.time}",
                    "give the instants in order, and each time once",
                )
