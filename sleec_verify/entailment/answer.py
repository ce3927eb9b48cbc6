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
    """A clause that is active: what it obliges, when (in words, empty for at once), and the conditions that made it the
    one.

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
        """The obligations, each with when it is due if that is said."""
        return tuple(f"{what} {when}".rstrip() for what, when in zip(self.obligations, self.times))


@dataclass(frozen=True)
class Consequence:
    """What the constraints `origins` make of what is due: it must be so, but no rule says so, and nothing executes
    it."""

    literal: Obligation
    origins: tuple[Exclusive | Never, ...]


@dataclass(frozen=True)
class ConsequenceStep:
    """Something that is done, and what that makes due: the active clauses of the rules that it triggers, each with the
    steps that its obligations are. `cycle`: it is being done already, further up; `seen`: its tree stands elsewhere;
    `more`: it goes on, too deep to be shown. `forbidden` are clauses of the situation and the tree that forbid it at
    whatever time it may be done."""

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
    """One response with its window, in seconds from the situation, or from when `after` is done. No `end`: at some
    time. `unknown` is a length that a measure says which is not given; then there are no times.

    `instead_of` is what it is due in place of, an event or ``NOT`` and an event: once that was not kept in time
    (`overdue`), or at any time.
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


@dataclass(frozen=True)
class Entailment:
    """The answer to "what is due here?".

    Where it is not `consistent`, nothing is listed as due and `conflicts` says why. `timed` are the literals due at
    some later time; whether they can be kept with all else is not decided, and `consistent` says nothing of them.
    `chain` is what becomes due once that is done, `at_odds` the events that occur and are forbidden, each with the
    clauses that do, and `schedule` what is due until when, where they were asked for (`entailment.consequence_tree`,
    `sleec_verify.entailment.schedule`).
    `missing` are measures that were asked about and not given: comparisons with them count as false.
    `broken_assumptions` are the assumptions by which the situation cannot be, and the relations, whatever else occurs;
    `unsettled` those that do not hold if all comparisons with what is not given are false. `possible` are values of
    what is not given with which the situation can be, where it cannot without.
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
