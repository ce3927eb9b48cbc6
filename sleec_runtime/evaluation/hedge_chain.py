"""The meaning of a chain of hedges: Algorithm 1 of the paper, in both readings.

In the reading ``cascade``, the hedges are tested in order, and the last one before the first false condition is active.
In the reading ``priority``, the last hedge with a true condition is active. Without a true one, the default is active.

The functions follow the text of a rule, including nested chains. The verifier uses Equation 1 and a solver instead, and
the conformance suites compare both.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Union

from sleec_runtime.evaluation.formula_truth import NO_MEASURES, Situation, truth, unreported
from sleec_runtime.model import Clause, Context, Formula, Measure, Obligation, Reading, Rule


@dataclass(frozen=True, slots=True)
class ConditionTest:
    """The test of a condition: that of clause `clause`, or the guard of the rule if `clause` is None."""

    clause: int | None
    condition: Formula
    held: bool


@dataclass(frozen=True, slots=True)
class Decision:
    """The active clause of a triggered rule, and the tests that decided it, in text order.

    In the reading ``cascade``, these are the true conditions and the first false one. In the reading ``priority``, they
    are the last true condition and the false ones after it.
    """

    rule: Rule
    clause: int
    obligations: tuple[Obligation, ...]
    steps: tuple[ConditionTest, ...]

    @property
    def layer(self) -> str | None:
        """ℓ(R)i of Algorithm 1; None for the ε of the rule."""
        return self.rule.layer(self.clause)


@dataclass(frozen=True, slots=True)
class Undetermined:
    """A triggered rule whose active clause depends on unreported conditions, the `missing` ones."""

    rule: Rule
    missing: tuple[str, ...]


Outcome = Union[Decision, Undetermined, None]

_Numbered = tuple[int, Clause]


def decide(
    rule: Rule, context: Context, reading: Reading, measures: Mapping[str, Measure] = NO_MEASURES
) -> Decision | None:
    """Algorithm 1 in the closed world: the active clause of `rule`; None if the trigger does not occur or the guard is
    false.

    An active clause with a nested chain is the default of that chain. O(size of the rule). Raises WrongType as `truth`.
    """
    if rule.trigger not in context.triggers:
        return None
    outcome = walk(rule, Situation(context, measures), reading)
    assert not isinstance(outcome, Undetermined), "in the closed world every formula has a value"
    return outcome


def walk(rule: Rule, situation: Situation, reading: Reading) -> Outcome:
    """Algorithm 1 for a rule whose trigger occurs.

    In the open world, the outcome is `Undetermined` if unreported conditions can change it.
    """
    steps: list[ConditionTest] = []
    missing: dict[str, None] = {}

    def look(number: int | None, condition: Formula) -> bool | None:
        held = truth(condition, situation)
        if held is None:
            missing.update(dict.fromkeys(unreported(condition, situation)))
        else:
            steps.append(ConditionTest(number, condition, held))
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


def decide_chain(clause: Clause, situation: Situation, reading: Reading) -> Decision | Undetermined:
    """Algorithm 1 for a chain without trigger and guard, such as an alternative to a response."""
    outcome = walk(Rule("", "", None, clause, ()), situation, reading)
    assert outcome is not None, "a rule without a guard always decides"
    return outcome


_Look = Callable[[int, Formula], "bool | None"]


def _candidates(holder: _Numbered, hedges: Iterable[_Numbered], look: _Look, reading: Reading) -> list[_Numbered]:
    """The clauses of one chain that may be active: exactly one, unless conditions are unknown."""
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
    """The clauses that may be active if `candidate` is the active one of its own chain: itself, or one nested in it."""
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
