"""The course of a scenario: what happened when, as a robot was observed."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Literal

from sleec_runtime.model import Value
from sleec_verify.traces.trace import TraceInstant

Kind = Literal["occurs", "rejected", "starts", "done", "fails"]
"""What happens: triggers occur, or are rejected; the code of an obligation starts, completes it, or raises."""


@dataclass(frozen=True)
class Happening:
    """Something that happens to `names` at the time `at`, in seconds. What has the same `act` was started together, by
    one trigger or by the clock at one time. `error` is the exception of a trigger or of code."""

    at: int
    kind: Kind
    names: tuple[str, ...]
    act: int
    error: BaseException | None = None


@dataclass(frozen=True)
class Course:
    """What happened, in order, up to the time `end`; and the values of conditions and measures from each time on at
    which they changed. `takes_time` are the obligations that the scenario completes."""

    happenings: tuple[Happening, ...]
    values: Mapping[int, Mapping[str, Value]]
    end: int
    takes_time: frozenset[str] = frozenset()

    def values_at(self, time: int) -> Mapping[str, Value]:
        """The values of conditions and measures at a time."""
        return self.values[max((at for at in self.values if at <= time), default=0)] if self.values else {}

    def occurrences(self) -> Iterator[tuple[int, str]]:
        """The events: triggers that were not rejected, and obligations that were completed."""
        for one in self.happenings:
            if one.kind in ("occurs", "done"):
                yield from ((one.at, name) for name in one.names)

    def trace(self) -> tuple[TraceInstant, ...]:
        """The trace of all events, with an instant for the end."""
        events: dict[int, set[str]] = {time: set() for time in (*self.values, self.end)}
        for time, name in self.occurrences():
            events.setdefault(time, set()).add(name)
        return tuple(TraceInstant(time, frozenset(events[time]), self.values_at(time)) for time in sorted(events))
