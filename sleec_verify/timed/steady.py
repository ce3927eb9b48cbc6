"""Measures that may be the same at all instants to come, so that as little as possible is called for there."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

from sleec_runtime.model import Rule
from sleec_runtime.model_time import Effect
from sleec_verify.solver import Undecided
from sleec_verify.timed.program import Program
from sleec_verify.timed.responses import ways_of
from sleec_verify.timed.unfolding import Unfolding

MOST_RULES = 100
"""Rules that decide by measures; with more of them, none are looked for."""


class Steady(NamedTuple):
    """One choice of the measures that is good at any instant, whatever occurs there: for rules that decide by measures,
    the place of the clause that decides, or None if the guard does not hold."""

    clauses: tuple[tuple[str, int | None], ...]


def steady(program: Program, first: Iterable[str]) -> Steady | None:
    """Measures by which the rules that the events `first` trigger ask for little, and then others. None if there are no
    measures that are good at any instant, or that is not known."""
    reading = [rule for rule in program.rules if rule.guard is not None or len(list(rule.clauses())) > 1]
    if len(reading) > MOST_RULES:
        return None
    place = {event: number for number, event in enumerate(first)}
    reading.sort(key=lambda rule: place.get(rule.trigger, len(place)))
    unfolding = Unfolding(program, rules={})
    instant = unfolding.instants[unfolding.instant(unfolding.formula.true)]
    required = []
    for law in program.laws:
        if isinstance(law, Effect):
            holds = instant.literal(law.formula)
            required.append(holds if law.relation == "includes" else -holds)
    clauses: list[tuple[str, int | None]] = []
    try:
        if not unfolding.ask(*required):
            return None
        for rule in reading:
            guards = instant.guards(rule, program.ruleset.reading, unfolding.formula.true)
            ways: list[tuple[int, int | None, int]] = [
                (_asks(program, rule, number), number, guard) for number, guard in enumerate(guards)
            ]
            if rule.guard is not None:
                ways.append((0, None, -instant.literal(rule.guard)))
            for _, number, literal in sorted(ways, key=lambda way: way[0]):
                if unfolding.ask(*required, literal):
                    required.append(literal)
                    clauses.append((rule.label, number))
                    break
    except Undecided:
        return None
    return Steady(tuple(clauses))


def _asks(program: Program, rule: Rule, clause: int) -> int:
    """How much a clause of a rule asks for: nothing that matters, only that something is not done for which nothing
    calls, or more."""
    demands = [one for one in program.demands_of_clauses(rule)[clause] if not program.free.is_free(one)]
    uncalled = [
        ways is not None
        and all(
            any(w.negated and w.event not in program.obliging and w.event not in program.bound for w in way)
            for way in ways
        )
        for ways in map(ways_of, demands)
    ]
    return 0 if not demands else 1 if all(uncalled) else 2
