"""A strategy of the environment, as a witness: what it does, and how it goes on."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from sleec_runtime.model import Value


@dataclass(frozen=True)
class Act:
    """What happens at one instant: when, in seconds from the first act, the events, and the values of all that the
    rules at odds look at."""

    time: int
    events: tuple[str, ...]
    conditions: Mapping[str, Value]


@dataclass(frozen=True)
class Branch:
    """What the robot does at once (None: whatever it does) and means to do later, and what the environment does
    then."""

    done: tuple[str, ...] | None
    planned: tuple[Act, ...]
    then: Strategy


@dataclass(frozen=True)
class Strategy:
    """What the environment does, and how it goes on. Without branches, the robot has no way left to keep all. `more`:
    the robot may do other things at once, that are not shown."""

    act: Act
    branches: tuple[Branch, ...] = ()
    more: bool = False
