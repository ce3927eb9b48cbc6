"""What the rules say in a situation: Algorithm 1 of the paper, in both readings of a chain of hedges.

A rule is walked as it is written, nested chains and all; nothing is compiled. The verifier takes the other road, by
Equation 1 and a solver, and the conformance suites compare the two.

Two worlds: in the closed one (Definition 1) a condition that nobody reported is false, and so is a comparison with
a measure that has no value. In the open one it is unknown, and an answer is given only where it does not matter
(Kleene's three values).
"""

from __future__ import annotations

import operator
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Any, Union

from sleec_runtime.errors import WrongType
from sleec_runtime.model import (
    NUMBER,
    And,
    Assume,
    Atom,
    Calculation,
    Clause,
    Comparison,
    Context,
    Formula,
    Measure,
    MeasureRef,
    Not,
    Number,
    Obligation,
    Or,
    Rational,
    Reading,
    Rule,
    Ruleset,
    ScaleValue,
    Term,
    Truth,
    exact,
    fit,
    leaves,
    measures_of,
)

NO_MEASURES: Mapping[str, Measure] = MappingProxyType({})
_NOTHING_OBLIGED: Mapping[str, bool] = MappingProxyType({})

_OPERATORS: Mapping[str, Callable[[Any, Any], bool]] = {
    "<": operator.lt,
    "<=": operator.le,
    "=": operator.eq,
    "!=": operator.ne,
    ">=": operator.ge,
    ">": operator.gt,
}


# Formulas -------------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Situation:
    """All that gives a formula its value.

    `absent` is what an unreported condition is worth: False in the closed world, None (unknown) in the open one.
    `obliged` are the obligations whose truth is fixed; of others nothing is known.
    """

    context: Context
    measures: Mapping[str, Measure] = field(default_factory=lambda: NO_MEASURES)
    absent: bool | None = False
    obliged: Mapping[str, bool] = field(default_factory=lambda: _NOTHING_OBLIGED)


def truth(formula: Formula, situation: Situation) -> bool | None:
    """The value of `formula`, None if what is not known decides it. O(size of the formula).

    Raises WrongType for a value that cannot be what the formula takes it for.
    """
    if isinstance(formula, Atom):
        return _atom(formula, situation)
    if isinstance(formula, Comparison):
        return _comparison(formula, situation)
    if isinstance(formula, Not):
        value = truth(formula.operand, situation)
        return None if value is None else not value
    if isinstance(formula, Truth):
        return formula.value
    deciding = isinstance(formula, Or)
    result: bool | None = not deciding
    for operand in formula.operands:
        value = truth(operand, situation)
        if value is deciding:
            return deciding
        if value is None:
            result = None
    return result


def holds(formula: Formula, context: Context, measures: Mapping[str, Measure] = NO_MEASURES) -> bool:
    """χ ⊨ formula, in the closed world (paper, Section 3.2), for a formula over triggers and conditions.

    `measures` gives the scales (`Ruleset.measures`); without it a value of a scale equals itself and has no order.
    Raises WrongType as `truth` does, ValueError for a formula that obligations decide.
    """
    value = truth(formula, Situation(context, measures))
    if value is None:
        raise ValueError("the truth of an obligation is not part of a context")
    return value


def unreported(formula: Formula, situation: Situation) -> Iterator[str]:
    """The conditions and measures without a value that leave `formula` unknown, in the order of the text."""
    if truth(formula, situation) is not None:
        return
    if isinstance(formula, Not):
        yield from unreported(formula.operand, situation)
    elif isinstance(formula, (And, Or)):
        for operand in formula.operands:
            yield from unreported(operand, situation)
    else:
        for leaf in leaves(formula):
            if isinstance(leaf, Comparison):
                yield from (name for name in measures_of(leaf) if situation.context.conditions.get(name) is None)
            elif leaf.kind == "condition":
                yield leaf.name


def _atom(atom: Atom, situation: Situation) -> bool | None:
    if atom.kind == "condition":
        value = situation.context.conditions.get(atom.name)
        if value is None:
            return situation.absent
        return bool(fit(atom.name, value, None))
    if atom.kind == "trigger":
        return atom.name in situation.context.triggers
    return situation.obliged.get(atom.name)


def _comparison(comparison: Comparison, situation: Situation) -> bool | None:
    left, right = comparison.left, comparison.right
    if isinstance(left, Calculation):
        calculated = _calculated(left, situation)
        if calculated is None:
            return situation.absent
        return _OPERATORS[comparison.operator](calculated, _worth(right, left, situation))
    measured = [situation.context.conditions.get(side.name) for side in (left, right) if isinstance(side, MeasureRef)]
    if None in measured:
        return situation.absent
    return _OPERATORS[comparison.operator](_worth(left, right, situation), _worth(right, left, situation))


def _calculated(side: Calculation, situation: Situation) -> Rational | None:
    """What a calculation comes to, None if one of its measures has no value."""
    values: dict[str, Rational] = {}
    for name in side.measures:
        value = situation.context.conditions.get(name)
        if value is None:
            return None
        number = exact(value)
        if number is None:
            raise WrongType(name, value, NUMBER)
        values[name] = number
    return side.value(values)


def _worth(side: Term, other: Term, situation: Situation) -> object:
    """What a side of a comparison is worth: an exact number, or a place in a scale."""
    if isinstance(side, Number):
        return side.value
    if isinstance(side, ScaleValue):
        return side.rank
    assert isinstance(side, MeasureRef), "a calculation is no side to be compared with a calculation"
    value = situation.context.conditions[side.name]
    measure = situation.measures.get(side.name)
    if isinstance(value, str):
        if measure is not None:
            return measure.values.index(str(fit(side.name, value, measure)))
        if isinstance(other, ScaleValue) and value == other.value:
            return other.rank
        raise WrongType(side.name, value, "a measure with no known scale", "pass the ruleset's measures")
    number = exact(value)
    if number is None or isinstance(other, ScaleValue):
        raise WrongType(side.name, value, "a value of a scale" if number is not None else NUMBER)
    return number


# One rule -------------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Step:
    """One condition that was looked at: that of clause `clause`, or the guard of the rule if `clause` is None."""

    clause: int | None
    condition: Formula
    held: bool


@dataclass(frozen=True, slots=True)
class Decision:
    """The active clause of a triggered rule, and the conditions that decided it, in the order of the text.

    In a cascade these are the true prefix and the first false condition; by priority the last true condition and
    the false ones after it.
    """

    rule: Rule
    clause: int
    obligations: tuple[Obligation, ...]
    steps: tuple[Step, ...]

    @property
    def layer(self) -> str | None:
        """ℓ(R)i of Algorithm 1; None is the rule's own ε."""
        return self.rule.layer(self.clause)


@dataclass(frozen=True, slots=True)
class Undetermined:
    """A triggered rule whose active clause depends on conditions that nobody reported: `missing`."""

    rule: Rule
    missing: tuple[str, ...]


Outcome = Union[Decision, Undetermined, None]

_Numbered = tuple[int, Clause]


def decide(
    rule: Rule, context: Context, reading: Reading, measures: Mapping[str, Measure] = NO_MEASURES
) -> Decision | None:
    """Algorithm 1 in the closed world: the active clause of `rule`, or None where the trigger did not occur or the
    guard is false.

    A clause that holds a nested chain and decides in its own is the default of the nested one. O(size of the rule).
    Raises WrongType as `truth` does.
    """
    if rule.trigger not in context.triggers:
        return None
    outcome = walk(rule, Situation(context, measures), reading)
    assert not isinstance(outcome, Undetermined), "in the closed world every formula has a value"
    return outcome


def decide_reported(
    rule: Rule, context: Context, reading: Reading, measures: Mapping[str, Measure] = NO_MEASURES
) -> Outcome:
    """Algorithm 1 in the open world: `decide`, or `Undetermined` where unreported conditions may change the answer."""
    if rule.trigger not in context.triggers:
        return None
    return walk(rule, Situation(context, measures, absent=None), reading)


def walk(rule: Rule, situation: Situation, reading: Reading) -> Outcome:
    """Algorithm 1 for a rule whose trigger is taken to occur."""
    steps: list[Step] = []
    missing: dict[str, None] = {}

    def look(number: int | None, condition: Formula) -> bool | None:
        held = truth(condition, situation)
        if held is None:
            missing.update(dict.fromkeys(unreported(condition, situation)))
        else:
            steps.append(Step(number, condition, held))
        return held

    guard = True if rule.guard is None else look(None, rule.guard)
    if guard is False:
        return None
    top = _numbered(_size(rule.default), rule.hedges)
    possible = [
        clause
        for candidate in _candidates((0, rule.default), top, look, reading)
        for clause in _settle(candidate, look, reading)
    ]
    if guard is None or len(possible) > 1:
        return Undetermined(rule, tuple(missing))
    ((number, clause),) = possible
    steps.sort(key=lambda step: -1 if step.clause is None else step.clause)
    return Decision(rule, number, clause.obligations, tuple(steps))


_Look = Callable[[int, Formula], "bool | None"]


def _candidates(holder: _Numbered, hedges: Iterable[_Numbered], look: _Look, reading: Reading) -> list[_Numbered]:
    """The clauses of one chain that may decide it: exactly one, unless conditions are unknown."""
    candidates: list[_Numbered] = []
    if reading == "cascade":
        last = holder
        for hedge in hedges:
            held = look(hedge[0], _condition(hedge))
            if held is False:
                break
            if held is None:
                candidates.append(last)
            last = hedge
        return [*candidates, last]
    for hedge in reversed(list(hedges)):
        held = look(hedge[0], _condition(hedge))
        if held is not False:
            candidates.append(hedge)
        if held:
            return candidates
    return [*candidates, holder]


def _settle(candidate: _Numbered, look: _Look, reading: Reading) -> list[_Numbered]:
    """The clauses that may speak where `candidate` decides its own chain: itself, or one nested in it."""
    number, clause = candidate
    if not clause.hedges:
        return [candidate]
    nested = _candidates(candidate, _numbered(number + 1, clause.hedges), look, reading)
    return [last for inner in nested for last in ([inner] if inner is candidate else _settle(inner, look, reading))]


def _numbered(first: int, hedges: Iterable[Clause]) -> Iterator[_Numbered]:
    number = first
    for hedge in hedges:
        yield number, hedge
        number += _size(hedge)


def _size(clause: Clause) -> int:
    return 1 + sum(map(_size, clause.hedges))


def _condition(hedge: _Numbered) -> Formula:
    condition = hedge[1].condition
    assert condition is not None, "only a default has no condition"
    return condition


# All rules ------------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Due:
    """What the rules oblige in a context: a decision for each rule that speaks, in the order of the rules."""

    decisions: tuple[Decision, ...]

    @property
    def literals(self) -> tuple[Obligation, ...]:
        """Every literal that is due, once, in the order of the rules and of their text."""
        return tuple(dict.fromkeys(literal for decision in self.decisions for literal in decision.obligations))

    @property
    def obligations(self) -> tuple[str, ...]:
        """The names to be done."""
        return tuple(literal.name for literal in self.literals if not literal.negated)

    @property
    def prohibitions(self) -> tuple[str, ...]:
        """The names not to be done."""
        return tuple(literal.name for literal in self.literals if literal.negated)


def due(ruleset: Ruleset, context: Context) -> Due:
    """What the rules oblige in `context`, in the ruleset's reading and the closed world.

    Definition 1, wherever the context does not conflict: ask `evaluation.conflicts.conflict` for that, because in a
    conflict Definition 1 entails everything and nothing is to be done. O(size of the rules).
    """
    decisions = (decide(rule, context, ruleset.reading, ruleset.measures) for rule in ruleset.rules)
    return Due(tuple(decision for decision in decisions if decision is not None))


def broken_assumptions(ruleset: Ruleset, context: Context) -> tuple[Assume, ...]:
    """The assumptions that `context` breaks: it is a situation that cannot be, and counts nowhere."""
    return tuple(
        constraint
        for constraint in ruleset.constraints
        if isinstance(constraint, Assume) and not holds(constraint.formula, context, ruleset.measures)
    )
