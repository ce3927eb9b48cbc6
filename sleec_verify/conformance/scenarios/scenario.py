"""A scenario: events and values at given times, and what the rules require when."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from sleec_runtime.model import Value
    from sleec_verify.results.timeline import Due


@dataclass(frozen=True)
class Step:
    """One time of a scenario, in seconds from its start. First the values of `given` change (None: no longer known),
    then the triggers of `when` occur together."""

    at: int
    when: tuple[str, ...] = ()
    given: Mapping[str, Value | None] = field(default_factory=dict)


@dataclass(frozen=True)
class Completion:
    """The time at which the robot completes an obligation that a rule required at `since`. None: it never does, so that
    its deadline passes. Obligations without a completion are completed at once."""

    name: str
    since: int
    at: int | None


@dataclass(frozen=True)
class Scenario:
    """The steps in the order of time, and how long to observe the robot, in seconds from the start.

    `obligations` and `prohibitions` are what the rules require, with windows in seconds from the start; of a response
    that is missed in the scenario and its alternative, both. If `prohibitions` is None, they are not compared.
    `reaches` are the goals of a selected scenario.
    """

    name: str
    steps: tuple[Step, ...]
    end: int
    completions: tuple[Completion, ...] = ()
    obligations: tuple[Due, ...] = ()
    prohibitions: tuple[Due, ...] | None = None
    domain: str | None = None
    reaches: tuple[str, ...] = ()
