"""Moments: what a mission observes at one time, in one context."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from sleec_runtime.model import Rational, Value

UNKNOWN_DOMAIN = ""
"""The domain of a moment before the domain is known, or in a domain that the rules do not have. Only rules without a
domain are decided."""


@dataclass(slots=True)
class Moment:
    """A run of observations with the same time and the same context.

    A report ends a moment if something has happened in it, so that each event is decided by what was reported before
    it. `changed` are the conditions that were reported since the moment before. `occurred` are the events that trigger
    rules, and `executed` those that fulfil obligations. If the rules have chains, both have all events. `is_triggered`:
    an event occurred that is not only an execution. `executions` are the observed executions. `has_entered`: the moment
    begins with another domain.
    """

    time: Rational
    domain: str | None
    conditions: Mapping[str, Value]
    changed: set[str] = field(default_factory=set)
    occurred: set[str] = field(default_factory=set)
    executed: set[str] = field(default_factory=set)
    is_triggered: bool = False
    executions: list[str] = field(default_factory=list)
    has_entered: bool = False
