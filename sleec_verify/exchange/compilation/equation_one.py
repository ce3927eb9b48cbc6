"""Equation 1 of rules with time, as formulas over one instant, with the windows of responses in their atoms.

The atom ``Call[0,300]`` is true if `Call` occurs at some instant from 0 to 300 seconds later. So an obligation is an
atom, and a prohibition is the negation of one. A response with alternatives is the disjunction of all ways to meet it.
Replacing each atom by its meaning gives the formula of metric temporal logic.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from sleec_runtime.model import (
    RELATIONS,
    And,
    Atom,
    Calculation,
    Claim,
    EventRelation,
    Formula,
    Kind,
    Lasting,
    MeasureRef,
    Not,
    Obligation,
    Or,
    Relation,
    Ruleset,
    Truth,
    relation_name,
)
from sleec_verify.encoding.equation import disjunction
from sleec_verify.encoding.relations import at_one_instant, events_of
from sleec_verify.encoding.trace_scope import Untimed
from sleec_verify.exchange.compilation.symbols import bound_text
from sleec_verify.exchange.compilation.temporal_logic import (
    AllOf,
    Always,
    Bound,
    Eventually,
    Implies,
    OneOf,
    Responses,
    Temporal,
    Window,
)


class WindowAtom(NamedTuple):
    """What an atom with a window means: the event, and the first and the last second, as text. `last` is None
    without an upper bound."""

    event: str
    first: str
    last: str | None

    def __str__(self) -> str:
        return f"{self.event}[{self.first},{'inf)' if self.last is None else f'{self.last}]'}"


class Excluded(NamedTuple):
    """A statement that Equation 1 does not include: its name, its line and the reason."""

    name: str
    line: int
    reason: str

    def __str__(self) -> str:
        return f"not in Equation 1: {self.name} in line {self.line}, {self.reason}"


class EquationOne:
    """The responses and relations of a ruleset as formulas over one instant. `untimed` is the meaning of a response
    without a window."""

    def __init__(self, ruleset: Ruleset, untimed: Untimed = "at") -> None:
        self.ruleset = ruleset
        self.windows: dict[str, WindowAtom] = {}
        """The atoms with a window, by name."""
        self.due_now: set[str] = set()
        """The events that a response requires or forbids at the instant of the trigger."""
        self._triggers = ruleset.triggers.union(*(events_of(s) for s in ruleset.statements if isinstance(s, RELATIONS)))
        self._responses = Responses(ruleset.reading, untimed)
        for rule in ruleset.rules:
            for clause in rule.clauses():
                for obligation in clause.obligations:
                    self.response(obligation)

    def symbol(self, kind: Kind, name: str) -> str:
        """The symbol of a name, if triggers and obligations share one name space: an obligation that is also a trigger
        is ``due(name)``, because its occurrence and its obligation are different atoms."""
        return f"due({name})" if kind == "obligation" and name in self._triggers else name

    def response(self, obligation: Obligation) -> Formula:
        """What an obligation requires: a literal, or a disjunction with its alternatives."""
        return self._at_trigger(self._responses.of(obligation))

    def relations(self) -> Iterator[tuple[Relation, list[tuple[Formula, ...]]]]:
        """The relations that concern one instant, as disjunctions of which all hold.

        An event occurs if it is in the situation, or if a response requires it at the instant of the trigger.
        """
        for statement in self.ruleset.statements:
            if isinstance(statement, RELATIONS) and not _relates_instants(statement):
                yield statement, [tuple(map(self._occurring, part)) for part in at_one_instant(statement)]

    def excluded(self) -> Iterator[Excluded]:
        """The statements that Equation 1 does not include, in the order of the text."""
        for statement in self.ruleset.statements:
            line = self.ruleset.source.place(statement.span).line
            if isinstance(statement, RELATIONS) and _relates_instants(statement):
                yield Excluded(relation_name(statement), line, "which relates several instants")
            elif isinstance(statement, Claim):
                yield Excluded(f"{statement.kind} {statement.label}", line, "which is a question about traces")

    def _at_trigger(self, formula: Temporal) -> Formula:
        if isinstance(formula, Eventually):
            return self._atom(formula.part, formula.window)
        if isinstance(formula, Always):
            assert isinstance(formula.part, Not), "only prohibitions hold throughout a window"
            return Not(self._atom(formula.part.operand, formula.window))
        if isinstance(formula, AllOf):
            return And(tuple(map(self._at_trigger, formula.parts))) if formula.parts else Truth(True)
        if isinstance(formula, OneOf):
            return disjunction(tuple(map(self._at_trigger, formula.parts)))
        assert isinstance(formula, Implies), "responses have no other formulas"
        consequence = self._at_trigger(formula.consequence)
        return consequence if formula.condition == Truth(True) else Or((Not(formula.condition), consequence))

    def _atom(self, event: Formula, window: Window) -> Atom:
        assert isinstance(event, Atom), "a response is about one event"
        atom = WindowAtom(event.name, _text(window.start), None if window.end is None else _text(window.end))
        if (atom.first, atom.last) == ("0", "0"):
            self.due_now.add(event.name)
            return Atom("obligation", event.name)
        self.windows[str(atom)] = atom
        return Atom("obligation", str(atom))

    def _occurring(self, part: Formula) -> Formula:
        if isinstance(part, Not):
            return Not(self._occurring(part.operand))
        if isinstance(part, Atom) and part.kind == "trigger" and part.name in self.due_now:
            return Or((part, Atom("obligation", part.name)))
        return part


def _relates_instants(relation: Relation) -> bool:
    return isinstance(relation, Lasting) or (
        isinstance(relation, EventRelation) and relation.relation == "happenBefore"
    )


def _text(bound: Bound) -> str:
    return bound_text(bound, _measure)


def _measure(measure: MeasureRef | Calculation) -> str:
    return f"({measure})" if isinstance(measure, Calculation) else measure.name
