"""Measures, for one instant to come or for all of them, by which as little as possible is called for there."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import NamedTuple

from sleec_runtime.model import Rule
from sleec_runtime.model_time import Effect
from sleec_verify.solver import Undecided
from sleec_verify.timed.lean import Lean
from sleec_verify.timed.program import Program
from sleec_verify.timed.unfolding import Unfolding

MOST_RULES = 100
"""Rules that decide by measures; with more of them, none are looked for."""


class Measured(NamedTuple):
    """What one choice of the measures decides: of rules, the place of the clause, or None if no guard holds."""

    clauses: tuple[tuple[str, int | None], ...]


def steady(program: Program, lean: Lean, first: Iterable[str]) -> Measured | None:
    """Measures that are good at any instant, whatever occurs there, by which the rules that the events `first` trigger
    ask for what can be met soonest, and then others; `lean` says when that is. None if there are none, or that is not
    known."""
    if len(program.free.reading_rules) > MOST_RULES:
        return None
    place = {event: number for number, event in enumerate(first)}
    reading = sorted(program.free.reading_rules, key=lambda rule: place.get(rule.trigger, len(place)))
    unfolding = Unfolding(program, rules={})
    instant = unfolding.instants[unfolding.instant(unfolding.formula.true)]
    required = []
    for law in program.laws:
        if isinstance(law, Effect):
            holds = instant.literal(law.formula)
            required.append(holds if law.relation == "includes" else -holds)
    return _chosen(lean, unfolding, reading, required)


def at_an_instant_of(program: Program, lean: Lean, event: str) -> Measured | None:
    """As `steady`, at an instant of an event at which they matter to no other one."""
    unfolding = Unfolding(program, rules={})
    here = unfolding.instants[unfolding.instant(unfolding.formula.true)].event(event)
    return _chosen(lean, unfolding, program.by_trigger.get(event, ()), [here])


def _chosen(lean: Lean, unfolding: Unfolding, rules: Sequence[Rule], required: list[int]) -> Measured | None:
    """What is decided at the first instant of an unfolding, by one rule after the other."""
    instant = unfolding.instants[0]
    clauses: list[tuple[str, int | None]] = []
    try:
        if not unfolding.ask(*required):
            return None
        for rule in rules:
            guards = instant.guards(rule, unfolding.program.ruleset.reading, unfolding.formula.true)
            ways: list[tuple[float, int | None, int]] = [
                (lean.asks_until(rule, number), number, guard)
                for number, guard in enumerate(guards)
                if not lean.is_dead(rule, number)
            ]
            if rule.guard is not None:
                ways.append((-1, None, -instant.literal(rule.guard)))
            for _, number, literal in sorted(ways, key=lambda way: way[0]):
                if unfolding.ask(*required, literal):
                    required.append(literal)
                    clauses.append((rule.label, number))
                    break
            else:
                return None
    except Undecided:
        return None
    return Measured(tuple(clauses))
