"""A strategy of the environment as a witness: its acts, depending on the robot's answers."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from sleec_runtime.model import Value


@dataclass(frozen=True)
class Act:
    """What happens at one instant: the time in seconds from the first act, the events, and the relevant values."""

    time: int
    events: tuple[str, ...]
    conditions: Mapping[str, Value]


@dataclass(frozen=True)
class Branch:
    """The robot's immediate actions (None: any) and its plan, and the environment's next act."""

    done: tuple[str, ...] | None
    planned: tuple[Act, ...]
    then: Strategy


@dataclass(frozen=True)
class Strategy:
    """An act of the environment, with a branch for each answer of the robot. Without branches, the robot has lost.
    `more`: the robot has other answers that are not shown."""

    act: Act
    branches: tuple[Branch, ...] = ()
    more: bool = False
