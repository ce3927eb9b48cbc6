"""Modified condition/decision coverage of a rule: for each condition, two situations that differ only in it, and in
which different clauses are active.

The decision is the whole rule, which selects one of its clauses (or none, if its guard is false). Two situations differ
in one condition only if every other condition of the rule has the same truth value in both. A comparison counts as one
condition.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

from sleec_runtime.model import And, Atom, Clause, Comparison, Formula, Not, Or, Rule, Truth
from sleec_verify.query.question import Question
from sleec_verify.query.ruleset_index import RulesetIndex

Vector = tuple[bool, ...]
_Condition = Atom | Comparison


class DecidingVectors(NamedTuple):
    """The truth values of the conditions in each necessary situation, and the conditions, by position, that never
    decide."""

    vectors: tuple[Vector, ...]
    undecided: tuple[int, ...]


def deciding_vectors(index: RulesetIndex, position: int, conditions: Sequence[_Condition]) -> DecidingVectors:
    """Few vectors that show every condition to decide. Each condition is first tried as a change of an existing
    vector, which needs only one new vector. Raises `Undecided`."""
    rule = index.rules[position]
    undecided: list[int] = []
    with Question(index) as question:
        literals = [question.encoder.literal(condition) for condition in conditions]
        guards = question.guards(position)
        question.require(question.encoder.variable(("trigger", rule.trigger)))
        outcomes: dict[Vector, int | None] = {}

        def outcome(vector: Vector) -> int | str | None:
            """The active clause, or why there is none: "never" for inconsistent values."""
            if not question.ask(*_signed(literals, vector)):
                return "never"
            return next((number for number, guard in enumerate(guards) if question.true(guard)), None)

        for place in range(len(conditions)):
            for vector in list(outcomes):
                flipped = _flipped(vector, place)
                found = outcomes[flipped] if flipped in outcomes else outcome(flipped)
                if not isinstance(found, str) and found != outcomes[vector]:
                    outcomes[flipped] = found
                    break
            else:
                pair = _pair(index, position, conditions, place)
                if pair is None:
                    undecided.append(place)
                    continue
                for vector in pair:
                    found = outcome(vector)
                    assert not isinstance(found, str), "both were found to be possible"
                    outcomes[vector] = found
    return DecidingVectors(tuple(outcomes), tuple(undecided))


def _pair(
    index: RulesetIndex, position: int, conditions: Sequence[_Condition], place: int
) -> tuple[Vector, Vector] | None:
    """Two vectors that differ only at `place` and have different active clauses, or None."""
    rule = index.rules[position]
    blocked: list[list[tuple[int, bool]]] = []
    while True:
        with Question(index) as question:
            encoder = question.encoder
            literals = [encoder.literal(condition) for condition in conditions]
            question.require(encoder.variable(("trigger", rule.trigger)))
            sides = [question.guards_of(_settled(rule, conditions[place], value)) for value in (True, False)]
            question.require(
                encoder.any_of([x for a, b in zip(*sides) for x in (encoder.both(a, -b), encoder.both(b, -a))])
            )
            for values in blocked:
                question.require(*(-literals[n] if value else literals[n] for n, value in values))
            if not question.ask():
                return None
            vector = tuple(question.true(literal) for literal in literals)
            flipped = _flipped(vector, place)
            if question.ask(*_signed(literals, flipped)):
                return vector, flipped
            # Comparisons may exclude each other: exclude values whose other side is impossible.
            core = set(question.core())
            blocked.append([(n, v) for n, v in enumerate(vector) if n != place and _sign(literals[n], v) in core])


def _settled(rule: Rule, condition: _Condition, value: bool) -> Rule:
    """The rule with a condition replaced by its truth value."""

    def formula(old: Formula) -> Formula:
        if old == condition:
            return Truth(value)
        if isinstance(old, Not):
            return Not(formula(old.operand))
        if isinstance(old, (And, Or)):
            return type(old)(tuple(map(formula, old.operands)))
        return old

    def clause(old: Clause) -> Clause:
        settled = None if old.condition is None else formula(old.condition)
        return replace(old, condition=settled, hedges=tuple(map(clause, old.hedges)))

    guard = None if rule.guard is None else formula(rule.guard)
    return replace(rule, guard=guard, default=clause(rule.default), hedges=tuple(map(clause, rule.hedges)))


def _flipped(vector: Vector, place: int) -> Vector:
    return (*vector[:place], not vector[place], *vector[place + 1 :])


def _sign(literal: int, value: bool) -> int:
    return literal if value else -literal


def _signed(literals: Sequence[int], vector: Vector) -> list[int]:
    return [_sign(literal, value) for literal, value in zip(literals, vector)]
