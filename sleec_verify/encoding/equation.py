"""Guards and Equation 1 as formulas that people can read.

The guard of clause i is C0 ∧ C1 ∧ … ∧ Ci ∧ ¬C(i+1), without the last conjunct for i = n. Equation 1 (paper, Section
3.2) says that each guard implies the response of its clause. This form is quadratic; `encoding.cnf` has a linear one.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import islice
from typing import NamedTuple

from sleec_runtime.model import And, Atom, Clause, Formula, Not, Or, Reading, Rule, Truth


class Implication(NamedTuple):
    """One conjunct of Equation 1: if `guard` is true, clause `number` obliges the response of `clause`."""

    number: int
    guard: Formula
    clause: Clause


def implications(rule: Rule, reading: Reading) -> Iterator[Implication]:
    """Equation 1 of a rule, a conjunct for each clause in the order of `Rule.clauses`."""
    triggered: list[Formula] = [Atom("trigger", rule.trigger)]
    if rule.guard is not None:
        triggered.append(rule.guard)
    number = 0
    for member, parts in zip((rule.default, *rule.hedges), _split(triggered, rule.hedges, reading)):
        for guard, clause in _descend(parts, member, reading):
            yield Implication(number, guard, clause)
            number += 1


def guard(rule: Rule, reading: Reading, number: int) -> Formula:
    """The guard of clause `number`."""
    return next(islice(implications(rule, reading), number, None)).guard


def chain(clause: Clause, reading: Reading) -> Iterator[tuple[Formula, Clause]]:
    """The condition under which each clause of a separate chain decides, in the order of `in_text_order`."""
    return _descend([], clause, reading)


def _descend(parts: list[Formula], clause: Clause, reading: Reading) -> Iterator[tuple[Formula, Clause]]:
    decides = _split(parts, clause.hedges, reading)
    yield conjunction(next(decides)), clause
    for nested, conjuncts in zip(clause.hedges, decides):
        yield from _descend(conjuncts, nested, reading)


def _split(active: list[Formula], hedges: Sequence[Clause], reading: Reading) -> Iterator[list[Formula]]:
    """The conjuncts under which each member of a chain decides: the default first, then the hedges."""
    conditions = [hedge.condition for hedge in hedges if hedge.condition is not None]
    for i in range(len(conditions) + 1):
        if reading == "cascade":
            yield active + conditions[:i] + [Not(following) for following in conditions[i : i + 1]]
        else:
            yield active + ([conditions[i - 1]] if i else []) + [Not(later) for later in conditions[i:]]


def conjunction(operands: Sequence[Formula]) -> Formula:
    """The conjunction of any number of formulas, with nested conjunctions flattened."""
    flat: list[Formula] = []
    for operand in operands:
        if isinstance(operand, And):
            flat += operand.operands
        elif not isinstance(operand, Truth) or not operand.value:
            flat.append(operand)
    if not flat:
        return Truth(True)
    return flat[0] if len(flat) == 1 else And(tuple(flat))


def disjunction(operands: Sequence[Formula]) -> Formula:
    """The disjunction of any number of formulas."""
    if not operands:
        return Truth(False)
    return operands[0] if len(operands) == 1 else Or(tuple(operands))
