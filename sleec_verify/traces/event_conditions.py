"""Conditions that name events, as states that relations connect to these events.

`unless B` becomes `unless occurs(B)`, a condition of its own, with the relations `includes B occurs(B)` and `causation
B occurs(B)`. At each instant, the state holds if and only if the event occurs. So guards and hedges depend only on the
state of an instant. This is exact for events that only the environment causes. An act of the response can change which
clause decides at its instant, so conflicts of rules that name an act are undecided.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator
from dataclasses import replace

from sleec_runtime.model import And, Atom, Effect, Formula, Not, Or, Rule, Ruleset, Span, formulas_of, names_of
from sleec_verify.encoding.trace_scope import named_atoms

_BEGIN, _END = "occurs(", ")"


def state_of(event: str) -> str:
    """The condition that stands for an event. No text can name it."""
    return f"{_BEGIN}{event}{_END}"


def event_of(state: str) -> str | None:
    """The event that a condition stands for; None for a condition of the text."""
    return state[len(_BEGIN) : -len(_END)] if state.startswith(_BEGIN) else None


def named_events(rule: Rule) -> Iterator[str]:
    """The events that the conditions of a rule name, as atoms or by their states."""
    yield from named_atoms(rule)
    for formula in formulas_of(rule):
        for name in names_of(formula):
            event = event_of(name)
            if event is not None:
                yield event


def with_states(ruleset: Ruleset, events: Collection[str]) -> Ruleset:
    """The ruleset with states in place of `events` in the conditions of its rules, and with the relations of these."""
    named = sorted({event for rule in ruleset.rules for event in named_atoms(rule)}.intersection(events))
    if not named:
        return ruleset
    from sleec_verify.encoding.statement_parts import with_formulas

    def read(formula: Formula) -> Formula:
        if isinstance(formula, Atom) and formula.kind == "trigger" and formula.name in named:
            return replace(formula, kind="condition", name=state_of(formula.name))
        if isinstance(formula, Not):
            return replace(formula, operand=read(formula.operand))
        if isinstance(formula, (And, Or)):
            return replace(formula, operands=tuple(map(read, formula.operands)))
        return formula

    statements = (with_formulas(s, read) if isinstance(s, Rule) else s for s in ruleset.statements)
    return replace(ruleset, statements=(*statements, *_relations(named)))


def _relations(events: Collection[str]) -> Iterator[Effect]:
    # Each relation needs its own place, and these are not in the text.
    for number, event in enumerate(events):
        state = Atom("condition", state_of(event))
        yield Effect("includes", event, state, Span(-2 * number - 1, -2 * number - 1))
        yield Effect("causation", event, state, Span(-2 * number - 2, -2 * number - 2))


def is_of_state(relation: object) -> bool:
    """Whether a relation connects a state to its event."""
    return isinstance(relation, Effect) and isinstance(relation.formula, Atom) and bool(event_of(relation.formula.name))
