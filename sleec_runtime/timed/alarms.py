"""Alarms: calls at given times."""

from __future__ import annotations

from collections.abc import Callable

from sleec_runtime.timed.clock import Time


class Alarms:
    """Calls to make, each at its time."""

    def __init__(self) -> None:
        self._calls: dict[object, tuple[Time, Callable[[], object], bool]] = {}

    def add(self, at: Time, call: Callable[[], object], lasts: bool = False) -> object:
        """Adds a call, and returns a key for `drop`. `clear` keeps it if it `lasts`."""
        key = object()
        self._calls[key] = at, call, lasts
        return key

    def drop(self, key: object) -> None:
        self._calls.pop(key, None)

    def clear(self) -> None:
        self._calls = {key: alarm for key, alarm in tuple(self._calls.items()) if alarm[2]}

    def earliest(self) -> Time | None:
        # An instance has one alarm at a time, so the number of alarms is that of the instances that share the clock.
        return min((at for at, _, _ in self._calls.values()), default=None)

    def take(self, until: Time) -> tuple[Time, Callable[[], object]] | None:
        """Removes and returns the earliest call that is not later than `until`."""
        key = min(self._calls, key=lambda key: self._calls[key][0], default=None)
        return self._calls.pop(key)[:2] if key is not None and self._calls[key][0] <= until else None
