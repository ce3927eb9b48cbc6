"""Responses: the obligations of a clause, with their times and alternatives."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

from sleec_runtime.model.comments import NO_COMMENTS, Comments
from sleec_runtime.model.formula import Formula
from sleec_runtime.model.window import Window
from sleec_runtime.support.spans import NOWHERE, Span


@dataclass(frozen=True, slots=True)
class Obligation:
    """A literal of a response: a name (an obligation), or ``NOT`` and a name (a prohibition), with its timing if the
    text states one."""

    name: str
    negated: bool = False
    span: Span = field(default=NOWHERE, compare=False, repr=False)
    timing: Timing | None = None

    def __str__(self) -> str:
        return f"NOT {self.name}" if self.negated else self.name


@dataclass(frozen=True, slots=True)
class Clause:
    """A default (`condition` is None) or a hedge clause. ``UNLESS c`` without a response has no obligations.

    `hedges` is a chain nested in the parentheses of this clause. It applies only where this clause is the active one of
    its own chain.
    """

    condition: Formula | None
    obligations: tuple[Obligation, ...]
    hedges: tuple[Clause, ...] = ()
    span: Span = field(default=NOWHERE, compare=False, repr=False)
    comments: Comments = field(default=NO_COMMENTS, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Timing:
    """The time of a response, and its alternatives.

    `otherwise` is due if the window closes and the response is not done. `instead`, written ``else``, may be done in
    place of the response.
    """

    window: Window | None = None
    otherwise: Clause | None = None
    instead: Clause | None = None

    def alternatives(self) -> Iterator[Clause]:
        """The alternatives to this response."""
        if self.otherwise is not None:
            yield self.otherwise
        if self.instead is not None:
            yield self.instead

    def __str__(self) -> str:
        parts = [str(self.window)] if self.window is not None else []
        for word, clause in (("otherwise", self.otherwise), ("else", self.instead)):
            if clause is not None:
                due = " and ".join(obligation_text(obligation) for obligation in clause.obligations) or "nothing"
                parts.append(f"{word} {due}{' (with exceptions)' if clause.hedges else ''}")
        return ", ".join(parts)


def obligation_text(obligation: Obligation) -> str:
    """An obligation with its time, as text."""
    return f"{obligation} {obligation.timing}" if obligation.timing is not None else str(obligation)


def in_text_order(clause: Clause) -> Iterator[Clause]:
    """A clause and those nested in it, in text order."""
    yield clause
    for hedge in clause.hedges:
        yield from in_text_order(hedge)


def conditions_in(clause: Clause) -> Iterator[Formula]:
    """The condition of a clause, and those of the hedges in the alternatives to its response."""
    if clause.condition is not None:
        yield clause.condition
    for obligation in clause.obligations:
        if obligation.timing is not None:
            for alternative in obligation.timing.alternatives():
                for inner in in_text_order(alternative):
                    yield from conditions_in(inner)


def literals(clause: Clause) -> Iterator[Obligation]:
    """The obligations of a clause, and those of the alternatives to them."""
    for obligation in clause.obligations:
        yield obligation
        if obligation.timing is not None:
            for alternative in obligation.timing.alternatives():
                for inner in in_text_order(alternative):
                    yield from literals(inner)
