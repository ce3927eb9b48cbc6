"""Ordering: observations that are late by a bounded time are put in order."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from heapq import heappop, heappush
from typing import Generic, TypeVar

from sleec_runtime.audit.observation import Observation, RawMessage
from sleec_runtime.model import Rational

T = TypeVar("T", bound="Observation | RawMessage")


class Ordering(Generic[T]):
    """Holds observations for `lag` seconds of their own time, and returns them in the order of time. Observations of
    one time keep their order."""

    def __init__(self, lag: Rational) -> None:
        self.lag = lag
        self._held: list[tuple[Rational, int, T]] = []
        self._number = 0
        self._latest: Rational = 0

    def insert(self, observation: T) -> Iterator[T]:
        """Adds an observation, and returns those that are due."""
        heappush(self._held, (observation.time, self._number, observation))
        self._number += 1
        self._latest = max(self._latest, observation.time)
        while self._held and self._held[0][0] <= self._latest - self.lag:
            yield heappop(self._held)[2]

    def held(self) -> list[T]:
        """The observations that are not due yet, in order."""
        return [observation for _, _, observation in sorted(self._held, key=lambda held: held[:2])]

    def hold(self, observations: Iterable[T]) -> None:
        """Holds observations again, after a restart."""
        for observation in observations:
            heappush(self._held, (observation.time, self._number, observation))
            self._number += 1
            self._latest = max(self._latest, observation.time)
