"""Relations among events and measures (docs/dsl.md)."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal, Union

from sleec_runtime.model.comments import NO_COMMENTS, Comments
from sleec_runtime.model.formula import Formula
from sleec_runtime.model.window import Length
from sleec_runtime.support.spans import NOWHERE, Span

EventRelationKind = Literal["witness", "equal", "mutualExclusive", "happenBefore"]
MeasureRelationKind = Literal["imply", "iff", "mutualExclusive", "opposite", "invariant"]
EffectKind = Literal["causation", "includes", "forbid"]


@dataclass(frozen=True, slots=True)
class EventRelation:
    """``witness A B`` and the like: a relation between the occurrences of two events."""

    relation: EventRelationKind
    left: str
    right: str
    span: Span = field(default=NOWHERE, compare=False, repr=False)
    comments: Comments = field(default=NO_COMMENTS, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class MeasureRelation:
    """``measure imply p q`` and the like, which hold at every instant. ``measure invariant p`` has no `right`."""

    relation: MeasureRelationKind
    left: Formula
    right: Formula | None = None
    span: Span = field(default=NOWHERE, compare=False, repr=False)
    comments: Comments = field(default=NO_COMMENTS, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Effect:
    """``causation E p``, ``includes E p`` or ``forbid E p``: a relation between an event and the measures."""

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


def relation_name(relation: Relation) -> str:
    """The keywords of a relation."""
    if isinstance(relation, Lasting):
        return "when ... for" if relation.duration is not None else "when ... until"
    return f"measure {relation.relation}" if isinstance(relation, MeasureRelation) else relation.relation
