"""The answer to "what do the rules oblige in this situation, and why?", as values."""

from __future__ import annotations

from dataclasses import dataclass

from sleec_runtime.model import Assume, Exclusive, Formula, Never, Obligation, Relation, Span, Value
from sleec_verify.results.finding import Finding


@dataclass(frozen=True)
class ConditionValue:
    """A condition that was looked at, and its truth. `clause` is its hedge's number, None for the rule's guard."""

    formula: Formula
    truth: bool
    clause: int | None
    span: Span


@dataclass(frozen=True)
class ActiveClause:
    """An active clause: its obligations, their windows (in words, empty for immediate ones), and the conditions that
    decided for it.

    In a cascade these are the true prefix and the first false condition; by priority, the last true condition and
    the false ones after it.
    """

    rule: str
    clause: int
    layer: str | None
    obligations: tuple[str, ...]
    decisions: tuple[ConditionValue, ...]
    span: Span
    times: tuple[str, ...] = ()

    def in_words(self) -> tuple[str, ...]:
        """The obligations, each with its window if it has one."""
        return tuple(f"{what} {when}".rstrip() for what, when in zip(self.obligations, self.times))


@dataclass(frozen=True)
class Consequence:
    """A literal that follows from what is due and the constraints `origins`, but that no rule requires: nothing
    executes it."""

    literal: Obligation
    origins: tuple[Exclusive | Never, ...]


@dataclass(frozen=True)
class ConsequenceStep:
    """An obligation that is done, and its consequences: the active clauses of the rules that it triggers, each with the
    steps of its obligations. `cycle`: the event is also an ancestor of this step. `seen`: its tree is shown elsewhere.
    `more`: the tree is too deep to be shown. `forbidden` are the clauses that forbid it at every time at which it can
    be done."""

    name: str
    clauses: tuple[tuple[ActiveClause, tuple[ConsequenceStep, ...]], ...] = ()
    cycle: bool = False
    seen: bool = False
    more: bool = False
    forbidden: tuple[str, ...] = ()

    @property
    def leads_on(self) -> bool:
        return bool(self.clauses) or self.cycle or self.seen or self.more


@dataclass(frozen=True)
class ScheduledResponse:
    """One response with its window, in seconds from the situation, or from the event `after`. Without `end`, the window
    has no end. `unknown` names a measure that gives the length and has no value; then there are no times, and `lengths`
    are the shortest and the longest length in its range, if that has bounds.

    `instead_of` is the response that this one replaces (an event, or ``NOT`` and an event): after it was missed if
    `overdue`, otherwise at any time.
    """

    event: str
    negated: bool
    start: int | None
    end: int | None
    rule: str
    clause: int
    layer: str | None
    after: str | None = None
    instead_of: str | None = None
    overdue: bool = False
    unknown: str | None = None
    lengths: tuple[int, int] | None = None


@dataclass(frozen=True)
class Entailment:
    """What a ruleset entails in one context.

    If it is not `consistent`, the obligations are empty and `conflicts` says why. `timed` are the literals with a
    window. Whether these can be met together is not decided, and `consistent` does not include them.
    `chain` are the consequences of doing what is due, `at_odds` the events that occur although they are forbidden,
    each with the clauses that forbid it, and `schedule` the windows. These three are filled only on request
    (`sleec_verify.entailment.consequence_tree`, `sleec_verify.entailment.schedule`).
    `missing` are the measures without a value: comparisons with them count as false.
    `broken_assumptions` are the assumptions and relations that exclude the situation. `unsettled` are those that do so
    if all comparisons with missing measures are false. `possible` are values with which the situation is possible.
    """

    consistent: bool
    obligations: tuple[str, ...]
    prohibitions: tuple[str, ...]
    because: tuple[ActiveClause, ...]
    consequences: tuple[Consequence, ...]
    conflicts: tuple[Finding, ...]
    broken_assumptions: tuple[Assume | Relation, ...]
    missing: tuple[str, ...]
    timed: tuple[Obligation, ...] = ()
    chain: tuple[ConsequenceStep, ...] = ()
    at_odds: tuple[tuple[str, tuple[str, ...]], ...] = ()
    unsettled: tuple[Assume | Relation, ...] = ()
    possible: tuple[tuple[str, Value], ...] = ()
    schedule: tuple[ScheduledResponse, ...] = ()
