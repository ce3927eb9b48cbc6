"""Deviations: where a mission does not follow the rules, or where this cannot be decided."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

if TYPE_CHECKING:
    from sleec_runtime.evaluation.hedge_chain import Decision
    from sleec_runtime.evaluation.trace_violations import Requirement
    from sleec_runtime.model import Context, Obligation, Rational, Value

DeviationKind = Literal[
    "missed",
    "prohibited",
    "constraint",
    "assumption",
    "unrequired",
    "undetermined",
    "open",
    "unknown-name",
    "wrong-value",
    "out-of-order",
]
"""What a deviation is:

- ``missed``: an obligation was not executed in its window, and no alternative to it was met.
- ``prohibited``: the robot executed what was prohibited.
- ``constraint``: an EXCLUSIVE, a NEVER or a relation does not hold.
- ``assumption``: an ASSUME does not hold.
- ``unrequired``: the robot executed what no rule required. The rules do not forbid this.
- ``undetermined``: it depends on values that were not reported.
- ``open``: the mission ends before the window of an obligation closes, or before a constraint is decided.
- ``unknown-name``: the ruleset does not have a name.
- ``wrong-value``: a value does not fit its condition or measure, and counts as not reported.
- ``out-of-order``: an observation is earlier than one before it, and counts as simultaneous with that one.
"""

BREACHES: frozenset[DeviationKind] = frozenset({"missed", "prohibited", "constraint", "assumption"})
"""The kinds that show that rules or assumptions do not hold."""


@dataclass(frozen=True, slots=True)
class Triggered:
    """A triggered rule: the time, the events and conditions of that time, and the decision; None if conditions that
    were not reported decide it."""

    time: Rational
    rule: str
    context: Context
    decision: Decision | None


@dataclass(frozen=True, slots=True)
class Deviation:
    """A deviation, and when it happens: for a missed obligation, at the end of its window.

    `triggered` is the rule with the conditions that decided, and `obligation` the literal that was not met, due from
    `first` to `last`. For an execution that was not required, `last` is the end of the last time in which it was.
    `statement` is the broken constraint or relation, and `conditions` are its conditions. `missing`
    are the values that were not reported. `name` is that of the event, condition or domain, and `detail` says more
    about it.
    """

    kind: DeviationKind
    time: Rational
    triggered: Triggered | None = None
    obligation: Obligation | None = None
    first: Rational | None = None
    last: Rational | None = None
    statement: Requirement | None = None
    conditions: Mapping[str, Value] | None = None
    missing: tuple[str, ...] = ()
    name: str = ""
    detail: str = ""

    @property
    def rule(self) -> str | None:
        """The label of the rule."""
        return None if self.triggered is None else self.triggered.rule

    @property
    def clause(self) -> int | None:
        """The number of the clause that decided."""
        return None if self.triggered is None or self.triggered.decision is None else self.triggered.decision.clause
