"""What the instants of a trace have to come to."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import NamedTuple

from sleec_runtime.model import Clause, Rule
from sleec_verify.timed.responses import Demand, Occurs


class Decided(NamedTuple):
    """That a clause of a rule decides at an instant where `guard` is true, and demands what is `due`."""

    at: int
    rule: Rule
    number: int
    clause: Clause
    guard: int
    due: Demand


class Placed(NamedTuple):
    """That `literal` is true only if an event occurs, or does not, in a window around instant `at`."""

    at: int
    what: Occurs
    literal: int


@dataclass
class Need:
    """That `witness` holds at some instant: of those that there are, or (`rest`) of those still to come."""

    witness: Callable[[int], int]
    rest: int
    later: str | None = None
    """The event that it calls for, at the same time or later."""
    placed: Placed | None = None
    """What it demands, if that is that an event occurs."""
    parts: list[Need] = field(default_factory=list)
    """What one instant at which this comes about first is enough for."""

    @property
    def wait(self) -> int | None:
        """The seconds after its instant at which it has to come about, if it leaves no choice."""
        if self.placed is None or self.placed.what.start != self.placed.what.end:
            return None
        return self.placed.what.start
