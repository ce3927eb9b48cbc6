"""What a task does with a trigger while it is out of step with the Context Manager."""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Iterator
from typing import Literal, NamedTuple, get_args

from sleec_runtime.errors import WrongType
from sleec_runtime.ros.transport import Fields
from sleec_runtime.timed.clock import Clock, Time

Policy = Literal["hold", "default", "refuse"]
"""``hold`` keeps the trigger until the node is in step, ``default`` runs the defaults of its rules, and ``refuse``
executes nothing."""

MOST_HELD = 100
"""The most triggers that a node holds."""


def checked_policy(policy: Policy) -> Policy:
    """Raises WrongType for another value."""
    if policy not in get_args(Policy):
        raise WrongType("policy", policy, "hold, default or refuse", "give one of these names")
    return policy


class HeldTrigger(NamedTuple):
    """A trigger that waits, `until` a time of the clock. It `arrived` at a time in seconds since 1970."""

    until: Time
    trigger: str
    fields: Fields
    arrived: float


class HeldTriggers:
    """The triggers that wait, in order, each for `longest` seconds at most."""

    def __init__(self, clock: Clock, longest: float) -> None:
        self._clock = clock
        self._longest = longest
        self._lock = threading.Lock()
        self._held: deque[HeldTrigger] = deque()

    def hold(self, trigger: str, fields: Fields, arrived: float) -> bool:
        """Holds a trigger; returns False if too many wait already."""
        with self._lock:
            if len(self._held) < MOST_HELD:
                self._held.append(HeldTrigger(self._clock.now() + self._longest, trigger, fields, arrived))
                return True
        return False

    def __len__(self) -> int:
        return len(self._held)

    def take(self) -> HeldTrigger | None:
        """Removes the first trigger that waits; None if there is none."""
        with self._lock:
            return self._held.popleft() if self._held else None

    def take_expired(self) -> Iterator[HeldTrigger]:
        """Removes what has waited too long, one after the other."""
        now = self._clock.now()
        while self._held:
            with self._lock:
                held = self._held.popleft() if self._held and self._held[0].until <= now else None
            if held is None:
                return
            yield held
