"""A trace as a witness: which events occur when, and the windows of what is due."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from sleec_runtime.model import Value


@dataclass(frozen=True)
class Due:
    """A requirement of a rule at some instant: in words, and the window of its event in seconds of the timeline. No
    `end`: at some time.

    `instead_of` is the response that it replaces, in words: from `start` on, because that was missed (`overdue`), or as
    a choice.
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
    """One instant: its time in seconds, the events that occur, and the conditions and measures that were read.
    Those in `telling` affect what is due."""

    time: int
    events: tuple[str, ...]
    conditions: Mapping[str, Value]
    telling: tuple[str, ...]
    due: tuple[Due, ...] = ()


@dataclass(frozen=True)
class Timeline:
    """Instants in the order of time. `now` is the position of the one after which no continuation complies with the
    rules; everything after it is open. Without `now`, the timeline is a complete trace."""

    moments: tuple[Moment, ...]
    now: int | None = None
