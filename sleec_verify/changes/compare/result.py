"""The results of a comparison, as values."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Literal, NamedTuple

if TYPE_CHECKING:
    from sleec_runtime.model import Exclusive, Never, Obligation, Ruleset, Span
    from sleec_verify.changes.diagram.variables import Variable
    from sleec_verify.results.finding import Finding, Witness

Relation = Literal["equivalent", "stricter", "laxer", "incomparable", "unknown"]
Way = Literal["added", "removed"]


class Extent(NamedTuple):
    """The number of situations of a change.

    `affected` of `possible` situations, counted over `over`: the values of these names that the comparisons in the
    rules distinguish. `possible` are those that the assumptions of both sides allow and in which `given` (the triggers
    of the rules) occur. Both are None if counting stopped, and `why` is the limit.
    """

    affected: int | None
    possible: int | None
    over: tuple[Variable, ...] = ()
    given: tuple[str, ...] = ()
    why: str | None = None


class DecidingClause(NamedTuple):
    """A clause that decides in the shown situation, with all of its obligations. `span` is a place in its side's
    text."""

    rule: str
    clause: int
    obligations: tuple[Obligation, ...]
    span: Span


class Change(NamedTuple):
    """Obligations that a rule adds or removes in the same situations.

    `old_rule` and `new_rule` are the labels of the changed rule; None if it is new or deleted. `witness` is a smallest
    situation, in which nothing else occurs. `before` and `after` are all clauses that decide in it.
    """

    old_rule: str | None
    new_rule: str | None
    added: tuple[Obligation, ...]
    removed: tuple[Obligation, ...]
    witness: Witness
    before: tuple[DecidingClause, ...]
    after: tuple[DecidingClause, ...]
    extent: Extent
    domains: tuple[str, ...] = ()

    @property
    def rules(self) -> tuple[str, ...]:
        """The labels of the rule, the old one first."""
        return tuple(dict.fromkeys(label for label in (self.old_rule, self.new_rule) if label is not None))


class ConflictChange(NamedTuple):
    """Situations that conflict on one side only: the new side if `way` is added.

    `literals` are inconsistent, `rules` oblige them on that side, and `origins` are the constraints that exclude them.
    """

    way: Way
    literals: tuple[Obligation, ...]
    rules: tuple[str, ...]
    origins: tuple[Span, ...]
    witness: Witness
    before: tuple[DecidingClause, ...]
    after: tuple[DecidingClause, ...]
    extent: Extent
    domains: tuple[str, ...] = ()


class TimedConflictChange(NamedTuple):
    """A conflict over time that only one side has: the new side if `way` is added. `finding` is the finding of `check`
    on that side."""

    way: Way
    finding: Finding
    domains: tuple[str, ...] = ()

    @property
    def rules(self) -> tuple[str, ...]:
        """The rules in conflict, by their labels on that side."""
        return self.finding.rules


class SituationChange(NamedTuple):
    """Situations that only one side allows, by its assumptions or the values of a measure: the new side if `way` is
    added. `what` is the assumption of the other side. `witness` is None if there is no example."""

    way: Way
    what: str
    witness: Witness | None
    extent: Extent | None
    domains: tuple[str, ...] = ()


class ConstraintChange(NamedTuple):
    """Situations in which a constraint of one side excludes what the other side allows: of the new side if `way` is
    added."""

    way: Way
    constraint: Exclusive | Never
    extent: Extent
    domains: tuple[str, ...] = ()


class NameChange(NamedTuple):
    """A name that only one side uses as this kind: the new side if `way` is added."""

    way: Way
    kind: str
    name: str


class Undecidable(NamedTuple):
    """An inconclusive comparison, and the reason. It never counts as equivalent."""

    what: str
    why: str


class Difference(NamedTuple):
    """The differences between two rulesets.

    `renamed` are the labels of rules that differ only in their labels, and `rewritten` those of rules with another text
    and the same meaning. `same` is the number of equal rules. `notes` says what is left out of the comparison, and why.
    `constraints` are compared only if situations with a conflict are compared, too.
    """

    old: Ruleset
    new: Ruleset
    changes: tuple[Change, ...] = ()
    conflicts: tuple[ConflictChange, ...] = ()
    timed_conflicts: tuple[TimedConflictChange, ...] = ()
    situations: tuple[SituationChange, ...] = ()
    names: tuple[NameChange, ...] = ()
    undecided: tuple[Undecidable, ...] = ()
    renamed: tuple[tuple[str, str], ...] = ()
    rewritten: tuple[tuple[str, ...], ...] = ()
    reordered: bool = False
    same: int = 0
    notes: tuple[str, ...] = ()
    constraints: tuple[ConstraintChange, ...] = ()

    @property
    def more(self) -> bool:
        """Whether the new rules oblige more in some situation, or allow situations that the old ones exclude."""
        return any(c.added for c in self.changes) or "added" in self._ways

    @property
    def less(self) -> bool:
        """Whether they oblige less in some situation, or exclude situations."""
        return any(c.removed for c in self.changes) or "removed" in self._ways

    @property
    def _ways(self) -> frozenset[Way]:
        """How situations and constraints change."""
        return frozenset([*(one.way for one in self.situations), *(one.way for one in self.constraints)])

    @property
    def all_conflicts(self) -> list[ConflictChange | TimedConflictChange]:
        """The conflicts at one instant, and those over time."""
        return [*self.conflicts, *self.timed_conflicts]

    @property
    def conflict_ways(self) -> frozenset[Way]:
        """Whether the new rules have conflicts that the old ones do not have ("added"), and the reverse."""
        return frozenset(one.way for one in self.all_conflicts)

    @property
    def relation(self) -> Relation:
        """The relation of the new rules to the old ones. If only one side conflicts, neither obliges more."""
        return relation(self.more, self.less, bool(self.conflict_ways), bool(self.undecided))


def relation(more: bool, less: bool, conflicts: bool, undecided: bool) -> Relation:
    """The relation between the new and the old rules. It is "unknown" if an inconclusive comparison could change it."""
    if conflicts or (more and less):
        return "incomparable"
    if undecided:
        return "unknown"
    if more:
        return "stricter"
    return "laxer" if less else "equivalent"


def by_obligation(changes: tuple[Change, ...]) -> Iterator[tuple[Change, Obligation, Way]]:
    """Each obligation that some change adds or removes."""
    for change in changes:
        yield from ((change, obligation, "added") for obligation in change.added)
        yield from ((change, obligation, "removed") for obligation in change.removed)
