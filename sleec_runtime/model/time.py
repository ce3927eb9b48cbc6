"""What rules say of time, and what a ruleset says besides its rules: concerns, purposes, relations.

These are values as those of `sleec_runtime.model`, kept apart so that rulesets without time need not import them. What
they mean is `docs/dsl.md`.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Literal, NamedTuple, Union

from sleec_runtime.model import (
    NO_COMMENTS,
    NOWHERE,
    Calculated,
    Clause,
    Comments,
    Formula,
    MeasureRef,
    Number,
    Obligation,
    Rational,
    Rule,
    Ruleset,
    Span,
)

Unit = Literal["seconds", "minutes", "hours", "days"]
SECONDS: Mapping[Unit, int] = {"seconds": 1, "minutes": 60, "hours": 3600, "days": 86400}

ClaimKind = Literal["concern", "purpose"]
CLAIM_KINDS: tuple[ClaimKind, ...] = ("concern", "purpose")
ClaimForm = Literal["exists", "when"]
EventRelationKind = Literal["witness", "equal", "mutualExclusive", "happenBefore"]
MeasureRelationKind = Literal["imply", "iff", "mutualExclusive", "opposite", "invariant"]
EffectKind = Literal["causation", "includes", "forbid"]


# Times of a response --------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Length:
    """A length of time as it is written: a number, a constant, a measure or what is calculated from measures, and a
    unit."""

    amount: Number | MeasureRef | Calculated
    unit: Unit
    span: Span = field(default=NOWHERE, compare=False, repr=False)

    @property
    def seconds(self) -> Rational | None:
        """The length in seconds; None where measures say how long it is."""
        return self.amount.value * SECONDS[self.unit] if isinstance(self.amount, Number) else None

    @property
    def measures(self) -> tuple[str, ...]:
        """The measures that say how long it is, each once."""
        if isinstance(self.amount, Calculated):
            return self.amount.measures
        return (self.amount.name,) if isinstance(self.amount, MeasureRef) else ()

    def seconds_where(self, values: Mapping[str, Rational]) -> Rational:
        """The length in seconds where the measures that say it have these values. Raises KeyError for one that has
        none."""
        amount = self.amount
        if isinstance(amount, Calculated):
            return amount.value(values) * SECONDS[self.unit]
        return (values[amount.name] if isinstance(amount, MeasureRef) else amount.value) * SECONDS[self.unit]

    def __str__(self) -> str:
        amount = self.amount
        if isinstance(amount, Calculated):
            return f"({amount}) {self.unit}"
        if isinstance(amount, MeasureRef):
            return f"{amount.name} {self.unit}"
        return f"{amount.constant or amount.value} {self.unit[:-1] if amount.value == 1 else self.unit}"


@dataclass(frozen=True, slots=True)
class Window:
    """When a response is due: from `start` (at once, if None) to `end` after the trigger. No `end`: eventually."""

    end: Length | None
    start: Length | None = None
    span: Span = field(default=NOWHERE, compare=False, repr=False)

    def __str__(self) -> str:
        if self.end is None:
            return "eventually"
        return f"within {self.end}" if self.start is None else f"from {self.start} to {self.end} after the trigger"


@dataclass(frozen=True, slots=True)
class Timing:
    """What a response says besides the event: its window, what is due when that closes undone (`otherwise`), and what
    may be done in its place (`instead`, written ``else``)."""

    window: Window | None = None
    otherwise: Clause | None = None
    instead: Clause | None = None

    def alternatives(self) -> Iterator[Clause]:
        """The responses in place of this one."""
        if self.otherwise is not None:
            yield self.otherwise
        if self.instead is not None:
            yield self.instead

    def __str__(self) -> str:
        parts = [str(self.window)] if self.window is not None else []
        for word, clause in (("otherwise", self.otherwise), ("else", self.instead)):
            if clause is not None:
                due = " and ".join(described(obligation) for obligation in clause.obligations) or "nothing"
                parts.append(f"{word} {due}{' (with hedges of its own)' if clause.hedges else ''}")
        return ", ".join(parts)


def described(obligation: Obligation) -> str:
    """A response in words, with its time."""
    return f"{obligation} {obligation.timing}" if obligation.timing is not None else str(obligation)


# What a ruleset holds besides rules -----------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Claim:
    """A concern, which must not come about, or a purpose, which must be able to.

    ``label exists event and condition while responses[0] while …``, or ``label when event and condition then
    responses[0] while …``. `meanwhile` is a second claim, without a label, that must come about somewhere too.
    """

    kind: ClaimKind
    label: str
    form: ClaimForm
    event: str
    condition: Formula | None = None
    responses: tuple[Clause, ...] = ()
    meanwhile: Claim | None = None
    span: Span = field(default=NOWHERE, compare=False, repr=False)
    label_span: Span = field(default=NOWHERE, compare=False, repr=False)
    event_span: Span = field(default=NOWHERE, compare=False, repr=False)
    comments: Comments = field(default=NO_COMMENTS, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class EventRelation:
    """``witness A B`` and the like: what the occurrences of two events have to do with each other."""

    relation: EventRelationKind
    left: str
    right: str
    span: Span = field(default=NOWHERE, compare=False, repr=False)
    comments: Comments = field(default=NO_COMMENTS, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class MeasureRelation:
    """``measure imply p q`` and the like, true at every instant. ``measure invariant p`` has no `right`."""

    relation: MeasureRelationKind
    left: Formula
    right: Formula | None = None
    span: Span = field(default=NOWHERE, compare=False, repr=False)
    comments: Comments = field(default=NO_COMMENTS, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Effect:
    """``causation E p``, ``includes E p`` or ``forbid E p``: what an event has to do with the measures."""

    relation: EffectKind
    event: str
    formula: Formula
    span: Span = field(default=NOWHERE, compare=False, repr=False)
    comments: Comments = field(default=NO_COMMENTS, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Lasting:
    """``when event and condition then formula until end and end_condition``, or ``… for duration``."""

    event: str
    condition: Formula | None
    formula: Formula
    end: str | None = None
    end_condition: Formula | None = None
    duration: Length | None = None
    span: Span = field(default=NOWHERE, compare=False, repr=False)
    comments: Comments = field(default=NO_COMMENTS, compare=False, repr=False)


Relation = Union[EventRelation, MeasureRelation, Effect, Lasting]
RELATIONS = (EventRelation, MeasureRelation, Effect, Lasting)


# What cannot be analysed without time ---------------------------------------------------------------------


class Construct(NamedTuple):
    """Something that only makes sense in time: what it is called, and where it stands."""

    name: str
    span: Span


def constructs(ruleset: Ruleset) -> Iterator[Construct]:
    """What of the rules, and of the relations among their events and measures, speaks of time, in the order of the
    text. Concerns and purposes are not among them: they ask about the rules and change nothing."""
    for statement in ruleset.statements:
        if isinstance(statement, Rule):
            for clause in statement.clauses():
                for obligation in clause.obligations:
                    if obligation.timing is not None:
                        yield from _of_timing(obligation.timing, clause)
        elif isinstance(statement, RELATIONS):
            yield Construct(f"the relation {relation_name(statement)}", statement.span)


def _of_timing(timing: Timing, clause: Clause) -> Iterator[Construct]:
    if timing.window is not None:
        yield Construct("eventually" if timing.window.end is None else "within", timing.window.span)
    if timing.otherwise is not None:
        yield Construct("otherwise", timing.otherwise.span)
    if timing.instead is not None:
        yield Construct("else", timing.instead.span)


def relation_name(relation: Relation) -> str:
    """The word, or words, that a relation is written with."""
    if isinstance(relation, Lasting):
        return "when ... for" if relation.duration is not None else "when ... until"
    return f"measure {relation.relation}" if isinstance(relation, MeasureRelation) else relation.relation


def refuse_times(ruleset: Ruleset, who: str) -> None:
    """Raises UnsupportedTimes if anything in `ruleset` speaks of time; `who` is what cannot keep it."""
    found = list(constructs(ruleset))
    if found:
        from sleec_runtime.errors import UnsupportedTimes
        from sleec_runtime.support.messages import listed

        lines = [ruleset.source.place(construct.span).line for construct in found]
        said = listed([f"{construct.name} in line {line}" for construct, line in zip(found, lines)])
        raise UnsupportedTimes(f"{who} does not support times and relations yet: {said}", lines)


def claims(ruleset: Ruleset, kind: ClaimKind) -> tuple[Claim, ...]:
    """The concerns, or the purposes, of a ruleset."""
    return tuple(s for s in ruleset.statements if isinstance(s, Claim) and s.kind == kind)
