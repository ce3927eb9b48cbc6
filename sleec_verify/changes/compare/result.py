"""What a comparison says, as values: no solver, no text."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Literal, NamedTuple

if TYPE_CHECKING:
    from sleec_runtime.model import Obligation, Ruleset, Span
    from sleec_verify.changes.diagram.variables import Variable
    from sleec_verify.results.finding import Witness

Relation = Literal["equivalent", "stricter", "laxer", "incomparable", "unknown"]
Way = Literal["added", "removed"]


class Extent(NamedTuple):
    """How many situations a change concerns.

    `affected` of `possible` situations, counted over `over`: what these names may be together, as far as the
    comparisons of the rules involved can tell their values apart. `possible` are those that the assumptions of both
    sides allow and in which `given` (the triggers of the rules concerned) occur. Both are None where counting was given
    up, and `why` says at which bound.
    """

    affected: int | None
    possible: int | None
    over: tuple[Variable, ...] = ()
    given: tuple[str, ...] = ()
    why: str | None = None


class DecidingClause(NamedTuple):
    """A clause that decides in the situation shown, and all that it obliges. `span` is a place in its side's text."""

    rule: str
    clause: int
    obligations: tuple[Obligation, ...]
    span: Span


class Change(NamedTuple):
    """Obligations that a rule brings or no longer brings in the same situations: one cause, however many of these.

    `old_rule` and `new_rule` are the labels of the rule that changed; None where it is new, or gone. `witness` is a
    smallest situation, in which nothing else occurs; `before` and `after` are all clauses that decide in it.
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
    """Situations in which what is due cannot all be done on one side only: the new one, where `way` is added.

    `literals` are those at odds, `rules` what obliges them on that side, `origins` the constraints that rule them out.
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


class SituationChange(NamedTuple):
    """Situations that only one side allows, by its assumptions or by what a measure can be: the new one, where `way` is
    added. `what` is what the other side takes for granted; `witness` is None where it is not a matter of examples."""

    way: Way
    what: str
    witness: Witness | None
    extent: Extent | None
    domains: tuple[str, ...] = ()


class NameChange(NamedTuple):
    """A name that only one side knows as this kind: the new one, where `way` is added."""

    way: Way
    kind: str
    name: str


class Undecidable(NamedTuple):
    """What was not decided, and why. It never counts as equal."""

    what: str
    why: str


class Difference(NamedTuple):
    """What differs between two rulesets.

    `renamed` are labels of rules that say the same, `rewritten` those of rules that are written otherwise and oblige
    the same; `same` counts the rules that are equal. `notes` says what is left out of the comparison, and why.
    """

    old: Ruleset
    new: Ruleset
    changes: tuple[Change, ...] = ()
    conflicts: tuple[ConflictChange, ...] = ()
    situations: tuple[SituationChange, ...] = ()
    names: tuple[NameChange, ...] = ()
    undecided: tuple[Undecidable, ...] = ()
    renamed: tuple[tuple[str, str], ...] = ()
    rewritten: tuple[tuple[str, ...], ...] = ()
    reordered: bool = False
    same: int = 0
    notes: tuple[str, ...] = ()

    @property
    def more(self) -> bool:
        """Whether the new rules oblige more somewhere, or speak of situations that the old ones rule out."""
        return any(c.added for c in self.changes) or any(s.way == "added" for s in self.situations)

    @property
    def less(self) -> bool:
        """Whether they oblige less somewhere, or rule situations out."""
        return any(c.removed for c in self.changes) or any(s.way == "removed" for s in self.situations)

    @property
    def relation(self) -> Relation:
        """How the new rules stand to the old ones. Where only one side conflicts, neither obliges more."""
        return relation(self.more, self.less, bool(self.conflicts), bool(self.undecided))


def relation(more: bool, less: bool, conflicts: bool, undecided: bool) -> Relation:
    """One word for it all; "unknown" where what is undecided could change the word."""
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
