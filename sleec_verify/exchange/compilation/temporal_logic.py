"""Rules with time as formulas of metric temporal logic (R. Koymans, "Specifying real-time properties with metric
temporal logic", 1990), over finite traces of instants (docs/times.md).

An atom of an event is true at an instant at which the event occurs. Windows are in seconds from the instant at which
the formula is evaluated, bounds included.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import NamedTuple, Union

from sleec_runtime.model import (
    RELATIONS,
    Assume,
    Atom,
    Claim,
    Clause,
    EventRelation,
    Exclusive,
    Formula,
    Lasting,
    Length,
    Never,
    Not,
    Obligation,
    Reading,
    Rule,
    Ruleset,
    Statement,
    relation_name,
)
from sleec_verify.encoding.equation import chain, conjunction, implications
from sleec_verify.encoding.relations import formula_at_one_instant
from sleec_verify.encoding.trace_scope import Untimed


@dataclass(frozen=True)
class Holds:
    """A formula over the events, conditions and measures of the instant."""

    formula: Formula


@dataclass(frozen=True)
class AllOf:
    parts: tuple[Temporal, ...]


@dataclass(frozen=True)
class OneOf:
    parts: tuple[Temporal, ...]


@dataclass(frozen=True)
class Implies:
    condition: Formula
    consequence: Temporal


Bound = tuple[Length, ...]
"""A number of seconds, as a sum of lengths. The empty sum is 0."""


@dataclass(frozen=True)
class Window:
    """From `start` to `end`; without an `end`, there is no upper bound."""

    start: Bound
    end: Bound | None

    @property
    def is_now(self) -> bool:
        return self.start == () == self.end


@dataclass(frozen=True)
class Eventually:
    """F: `part` is true at some instant in the window."""

    window: Window
    part: Formula


@dataclass(frozen=True)
class Always:
    """G: `part` is true at every instant in the window."""

    window: Window
    part: Formula


@dataclass(frozen=True)
class Before:
    """O, strictly in the past: `part` was true at an earlier instant."""

    part: Formula


@dataclass(frozen=True)
class WeakUntil:
    """W: `part` is true at every instant from now on, up to the first at which `end` is true (not included).

    With a `duration`, only at instants that are less than so many seconds away.
    """

    part: Formula
    end: Formula | None
    duration: Length | None


Temporal = Union[Holds, AllOf, OneOf, Implies, Eventually, Always, Before, WeakUntil]


class Requirement(NamedTuple):
    """A formula that is true at every instant of the traces that satisfy a statement. A concern or purpose is a formula
    that is true at some instant of a trace in which it occurs."""

    title: str
    statement: Statement
    formula: Temporal


def requirements(ruleset: Ruleset, untimed: Untimed = "at") -> Iterator[Requirement]:
    """The requirements of each rule, constraint and relation, in the order of the text: one for each clause of a rule
    that obliges something. `untimed` is the meaning of a response without a window. Linear in the size of the rules,
    but for guards, which are written out."""
    responses = Responses(ruleset.reading, untimed)
    for statement in ruleset.statements:
        if isinstance(statement, Rule):
            for number, guard, clause in implications(statement, ruleset.reading):
                if clause.obligations:
                    title = f"{statement.label}, {f'hedge {number}' if number else 'default'}"
                    yield Requirement(title, statement, Implies(guard, responses.all_of(clause.obligations)))
        elif isinstance(statement, (*RELATIONS, Exclusive, Never, Assume)):
            yield Requirement(_title(statement), statement, _relation(statement))


def claims_of(ruleset: Ruleset, untimed: Untimed = "at") -> Iterator[tuple[Claim, list[Temporal]]]:
    """The concerns and purposes: each occurs in a trace if each of its formulas is true at some instant."""
    responses = Responses(ruleset.reading, untimed)
    for statement in ruleset.statements:
        if isinstance(statement, Claim):
            parts = []
            claim: Claim | None = statement
            while claim is not None:
                now = conjunction([_event(claim.event), *([] if claim.condition is None else [claim.condition])])
                parts.append(AllOf((Holds(now), *(responses.of_chain(response) for response in claim.responses))))
                claim = claim.meanwhile
            yield statement, list(parts)


class Responses:
    """The formulas of obligations, at the instant of the trigger. Each is due from the time `due` on."""

    def __init__(self, reading: Reading, untimed: Untimed) -> None:
        self._reading = reading
        self._untimed = untimed

    def all_of(self, obligations: Sequence[Obligation], due: Bound = ()) -> Temporal:
        parts = tuple(self.of(obligation, due) for obligation in obligations)
        return parts[0] if len(parts) == 1 else AllOf(parts)

    def of_chain(self, clause: Clause, due: Bound = ()) -> Temporal:
        """A chain that stands by itself: its hedges are decided at the trigger, whatever the time `due`."""
        parts: list[Temporal] = []
        for guard, member in chain(clause, self._reading):
            if member.obligations:
                parts.append(Implies(guard, self.all_of(member.obligations, due)))
        return parts[0] if len(parts) == 1 else AllOf(tuple(parts))

    def of(self, obligation: Obligation, due: Bound = ()) -> Temporal:
        timing = obligation.timing
        window = None if timing is None else timing.window
        if window is None:
            own = Window(due, due if self._untimed == "at" else None)
        else:
            start = due if window.start is None else (*due, window.start)
            own = Window(start, None if window.end is None else (*due, window.end))
        event = _event(obligation.name)
        itself: Temporal = Always(own, Not(event)) if obligation.negated else Eventually(own, event)
        parts = [itself]
        if timing is not None and timing.otherwise is not None:
            closed = due if window is None or own.end is None else own.end
            parts.append(self.of_chain(timing.otherwise, closed))
        if timing is not None and timing.instead is not None:
            parts.append(self.of_chain(timing.instead, due))
        return parts[0] if len(parts) == 1 else OneOf(tuple(parts))


def _relation(statement: Statement) -> Temporal:
    if isinstance(statement, Lasting):
        begins = conjunction([_event(statement.event), *([] if statement.condition is None else [statement.condition])])
        end: Formula | None = None
        if statement.end is not None:
            ends = [] if statement.end_condition is None else [statement.end_condition]
            end = conjunction([_event(statement.end), *ends])
        return Implies(begins, WeakUntil(statement.formula, end, statement.duration))
    if isinstance(statement, EventRelation) and statement.relation == "happenBefore":
        return Implies(_event(statement.right), Before(_event(statement.left)))
    assert isinstance(statement, (*RELATIONS, Exclusive, Never, Assume)), "no other statement binds traces"
    return Holds(formula_at_one_instant(statement))


def _title(statement: Statement) -> str:
    return relation_name(statement) if isinstance(statement, RELATIONS) else type(statement).__name__.upper()


def _event(name: str) -> Formula:
    return Atom("trigger", name)
