"""The timeline of a recorded mission: what occurred, what was due, and where the mission deviates from the rules."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Literal

if TYPE_CHECKING:
    from sleec_runtime.model import Rational, Value


@dataclass(frozen=True, slots=True)
class Occurrence:
    """An event or an execution at one time."""

    time: Rational
    name: str


@dataclass(frozen=True, slots=True)
class Change:
    """A condition or measure has a new value from `time` on; None: it is not known. Or the robot enters a domain."""

    time: Rational
    name: str
    value: Value | None


WindowState = Literal["met", "missed", "open", "prohibited"]
"""How a window ended: ``met``: the event occurred in time; ``missed``: it did not; ``open``: this was not decided when
the log ended, or depends on unreported values; ``prohibited``: the event must not occur, whether or not it did."""


@dataclass(frozen=True, slots=True)
class DueWindow:
    """The time in which an event must occur, or must not occur. Without `last`, it has no end. `words` say which rule
    requires what."""

    name: str
    words: str
    state: WindowState
    first: Rational
    last: Rational | None


@dataclass(frozen=True, slots=True)
class DeviationMark:
    """A deviation in one line. If `is_breach`, a rule was broken; otherwise, this is not known, or is only a note."""

    time: Rational
    words: str
    is_breach: bool


@dataclass
class MissionTimeline:
    """What a plot shows. Each list is in the order of time. `cut` is the time from which on nothing more was kept."""

    title: str
    start: Rational = 0
    end: Rational = 0
    domains: list[Change] = field(default_factory=list)
    triggers: list[Occurrence] = field(default_factory=list)
    changes: list[Change] = field(default_factory=list)
    executions: list[Occurrence] = field(default_factory=list)
    windows: list[DueWindow] = field(default_factory=list)
    deviations: list[DeviationMark] = field(default_factory=list)
    cut: Rational | None = None
