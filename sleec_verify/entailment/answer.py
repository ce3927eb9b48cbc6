"""The answer to "what do the rules oblige in this situation, and why?", as values."""

from __future__ import annotations

from collections.abc import Collection
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
    decided for it. `choices` has the obligations with alternatives in words, empty for those without.

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
    choices: tuple[str, ...] = ()

    def in_words(self) -> tuple[str, ...]:
        """The obligations, each with its window and its alternatives if it has any."""
        return tuple(
            choice or f"{what} {when}".rstrip()
            for what, when, choice in zip(self.obligations, self.times, self.choices)
        )

    @property
    def without_choice(self) -> tuple[str, ...]:
        """The obligations that have no alternatives."""
        return tuple(what for what, choice in zip(self.obligations, self.choices) if not choice)


@dataclass(frozen=True)
class DueLiteral:
    """A literal of an alternative. `when` is its window in words, empty if it has none. `overdue`: it is due only after
    what it replaces was missed."""

    name: str
    negated: bool
    when: str
    overdue: bool


@dataclass(frozen=True)
class Alternative:
    """An obligation with alternatives, in words: each of `options` meets it. One without literals means that nothing
    is required."""

    rule: str
    clause: int
    words: str
    options: tuple[tuple[DueLiteral, ...], ...]


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

    `consistent`: some response complies with the rules. If it is False, the obligations are empty and `conflicts` says
    why. If it is None, this is not decided, `undecided` says why, and the obligations are those that the active clauses
    state. `obligations` and `prohibitions` are in every complying response. `timed` are those with a window, and
    `alternatives` those with alternatives. A side of an alternative is among the obligations only if every complying
    response executes it at once.
    `chain` are the consequences of doing what is due, `at_odds` the events that occur although they are forbidden,
    each with the clauses that forbid it, and `schedule` the windows. These three are filled only on request
    (`sleec_verify.entailment.consequence_tree`, `sleec_verify.entailment.schedule`).
    `missing` are the measures without a value: comparisons with them count as false.
    `broken_assumptions` are the assumptions and relations that exclude the situation. `unsettled` are those that do so
    if all comparisons with missing measures are false. `possible` are values with which the situation is possible.
    """

    consistent: bool | None
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
    alternatives: tuple[Alternative, ...] = ()
    undecided: str | None = None

    def with_choices(self, expected: Collection[str], negated: bool) -> tuple[str, ...]:
        """The obligations (`negated`: the prohibitions), with those of `expected` that a clause states first of several
        alternatives: a case may name these or not."""
        found = self.prohibitions if negated else self.obligations
        first = {one.name for choice in self.alternatives for one in choice.options[0] if one.negated == negated}
        return tuple(sorted({*found, *first.intersection(expected)}))

    @property
    def has_windows(self) -> bool:
        """Whether something that is due, or an alternative to it, has a window."""
        options = (option for alternative in self.alternatives for option in alternative.options)
        return bool(self.timed) or any(literal.when for option in options for literal in option)
