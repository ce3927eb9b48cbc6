"""What every reader of logs offers."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Protocol, Union, runtime_checkable

from sleec_runtime.audit.observation import Observation, RawMessage, Reported
from sleec_verify.results.json_values import Json

Position = Json
"""A place in a log from which to resume, as a JSON value. None is the beginning."""


@dataclass(frozen=True)
class Unreadable:
    """A part of a log that cannot be read. `place` names it, such as ``line 12``; `line` is its line, if it is one.
    `rest` is what can be read of it."""

    place: str
    message: str
    hint: str | None = None
    line: int | None = None
    rest: Reported | None = None


Item = Union[Observation, RawMessage, Unreadable]


class Reader(Protocol):
    """Reads one log as a stream, in the order of the log. It never holds the whole log in memory."""

    def read(self, start: Position = None) -> Iterator[tuple[Position, Item]]:
        """The items after the position `start`, each with the position after it.

        Raises UnreadableLog if the log is missing, has another form, or lacks the position `start`.
        """
        ...

    def fraction(self, position: Position) -> float:
        """How much of the log is before `position`, from 0 to 1."""
        ...


@runtime_checkable
class IndexedReader(Reader, Protocol):
    """A reader of logs with an index of their topics.

    `topics` are those that were recorded, with or without messages; empty before something is read.
    """

    topics: frozenset[str]

    def sample(self, each: int) -> Iterator[Item]:
        """The first `each` messages of each topic, or a few more. Raises UnreadableLog."""
        ...
