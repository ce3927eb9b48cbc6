"""A trace as a witness: what happens when, and what is due until when."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from sleec_runtime.model import Value


@dataclass(frozen=True)
class Due:
    """What a rule calls for at some moment: in words, and the window of its event in seconds of the timeline. No `end`:
    at some time.

    `instead_of` is what it is due in place of, in words: from `start` on, as that was not kept in time (`overdue`), or
    at any time.
    """

    rule: str
    clause: int
    words: str
    event: str
    negated: bool
    start: int
    end: int | None
    instead_of: str | None = None
    overdue: bool = False


@dataclass(frozen=True)
class Moment:
    """One instant: its time in seconds, the events that occur, and the conditions and measures that were looked at, of
    which those in `telling` bear on what is due."""

    time: int
    events: tuple[str, ...]
    conditions: Mapping[str, Value]
    telling: tuple[str, ...]
    due: tuple[Due, ...] = ()


@dataclass(frozen=True)
class Timeline:
    """Moments in the order of time. `now` is the place of the one after which no continuation complies with the
    rules; what comes after it is open. Without it, the timeline is a whole trace."""

    moments: tuple[Moment, ...]
    now: int | None = None
