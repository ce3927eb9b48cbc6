"""The questions that one trace answers, by z3."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import z3

from sleec_runtime.model import (
    Claim,
    Ruleset,
)
from tests.support.z3_oracle.instants import Answer, Instant, Instants, Moment, Undecided, ordered
from tests.support.z3_oracle.meaning import Meaning, formula


def solve(parts: Sequence[Any], milliseconds: int = 60_000) -> Any:
    """A model, or None."""
    solver = z3.Solver()
    solver.set("timeout", milliseconds)
    solver.add(*parts)
    result = solver.check()
    if result == z3.unknown:
        raise Undecided(solver.reason_unknown())
    return solver.model() if result == z3.sat else None


def moments(instants: Instants, model: Any) -> tuple[Moment, ...]:
    def value(expression: Any) -> Any:
        return model.eval(expression, model_completion=True)

    found = []
    for i in instants:
        if not z3.is_true(value(i.used)):
            continue
        ruleset = i.ruleset
        conditions: dict[str, Any] = {name: z3.is_true(value(i.condition(name))) for name in ruleset.conditions}
        for name, measure in ruleset.measures.items():
            worth = value(i.measure(name)).as_fraction() if measure.kind == "number" else value(i.measure(name))
            if measure.kind != "number":
                worth = worth.as_long()
            conditions[name] = measure.values[worth] if measure.kind == "scale" else worth
        events = {name for name in ruleset.triggers | ruleset.obligations if z3.is_true(value(i.event(name)))}
        found.append(Moment(value(i.time).as_long(), frozenset(events), conditions))
    return tuple(found)


def _trace(ruleset: Ruleset, n: int, horizon: int | None) -> tuple[list[Instant], Any]:
    instants = [Instant(ruleset, f"i{k}") for k in range(n)]
    parts = [ordered(instants, first_used=True)]
    if horizon is not None:
        parts += [z3.Implies(i.used, i.time <= horizon) for i in instants]
    return instants, z3.And(parts)


def redundant(ruleset: Ruleset, label: str, n: int = 4, untimed: str = "at", horizon: int | None = None) -> Answer:
    """Whether no trace satisfies the other rules and breaks this one; `n` instants at most, none after `horizon`."""
    instants, possible = _trace(ruleset, n, horizon)
    meaning = Meaning(ruleset, instants, untimed)
    rule = ruleset.by_label[label]
    broken = z3.Or([z3.Not(meaning.law(rule, index)) for index in range(n)])
    model = solve([possible, meaning.all_rules(lambda law, index: law is rule), broken])
    return Answer(True) if model is None else Answer(False, moments(instants, model))


def vacuous(ruleset: Ruleset, label: str, n: int = 4, untimed: str = "at", horizon: int | None = None) -> Answer:
    """Whether the guard of this rule can be true, and no trace of all rules has it triggered."""
    instants, possible = _trace(ruleset, n, horizon)
    rule = ruleset.by_label[label]
    if rule.guard is not None and solve([possible, formula(rule.guard, instants[0])]) is None:
        return Answer(False)
    meaning = Meaning(ruleset, instants, untimed)
    model = solve([possible, meaning.all_rules(), z3.Or([meaning.triggered(rule, i) for i in instants])])
    return Answer(True) if model is None else Answer(False, moments(instants, model))


def concern(ruleset: Ruleset, claim: Claim, n: int = 4, untimed: str = "at", horizon: int | None = None) -> Answer:
    """Whether some trace of all rules brings this concern about."""
    instants, possible = _trace(ruleset, n, horizon)
    meaning = Meaning(ruleset, instants, untimed)
    model = solve([possible, meaning.all_rules(), meaning.claim(claim)])
    return Answer(False) if model is None else Answer(True, moments(instants, model))


def purpose(ruleset: Ruleset, claim: Claim, n: int = 4, untimed: str = "at", horizon: int | None = None) -> Answer:
    """Whether no trace of all rules brings this purpose about."""
    found, trace = concern(ruleset, claim, n, untimed, horizon)
    return Answer(not found, trace)
