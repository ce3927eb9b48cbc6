"""Which Context Manager a node follows, and whether it is alive and the only one."""

from __future__ import annotations

from sleec_runtime.timed.clock import Time


class ManagerWatch:
    """The Context Managers that a node has heard, by the clock of the node. A silent one is forgotten.

    A Context Manager is silent if no new heartbeat arrived for `timeout` seconds.
    """

    def __init__(self, timeout: float) -> None:
        self.timeout = timeout
        self.followed: str | None = None
        self._heard: dict[str, Time] = {}
        self._beats: dict[str, int] = {}
        self._numbers: dict[str, int] = {}

    def hear(self, manager: str, beat: int, number: int, now: Time) -> None:
        """Records heartbeat `beat` of `manager`, whose last update has this `number`. Old heartbeats are ignored."""
        if manager not in self._heard:
            for other in [one for one in self._heard if one != self.followed and not self._is_recent(one, now)]:
                del self._heard[other], self._beats[other], self._numbers[other]
        if beat > self._beats.get(manager, -1):
            self._beats[manager] = beat
            self._numbers[manager] = number
            self._heard[manager] = now

    def beat(self) -> int:
        """The last heartbeat of the followed Context Manager."""
        return self._beats.get(self.followed or "", 0)

    def announced(self) -> int | None:
        """The last update of the followed Context Manager, by its last heartbeat; None before the first heartbeat."""
        return self._numbers.get(self.followed or "")

    def silent(self, now: Time) -> bool:
        """Whether the followed Context Manager is silent."""
        return self.followed is None or not self._is_recent(self.followed, now)

    def end(self, now: Time) -> Time:
        """The next time at which a Context Manager becomes silent if it is not heard again; `now` if all are."""
        return min(
            (heard + self.timeout for one, heard in self._heard.items() if self._is_recent(one, now)), default=now
        )

    def others(self, now: Time) -> list[str]:
        """The other Context Managers that are not silent."""
        return [one for one in self._heard if one != self.followed and self._is_recent(one, now)]

    def _is_recent(self, manager: str, now: Time) -> bool:
        heard = self._heard.get(manager)
        return heard is not None and now < heard + self.timeout
