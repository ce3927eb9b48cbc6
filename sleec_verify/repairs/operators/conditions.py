"""Conditions under which clauses decide, as candidates write them."""

from __future__ import annotations

from collections.abc import Iterator

from sleec_runtime.model import And, Formula, Not, Rule, Ruleset, Truth
from sleec_verify.encoding.equation import conjunction, guard


def conjuncts(formula: Formula) -> tuple[Formula, ...]:
    """The operands of a conjunction; a formula that is none, alone."""
    return formula.operands if isinstance(formula, And) else (formula,)


def negation(formula: Formula) -> Formula:
    """The opposite of a formula, without a double negation."""
    return formula.operand if isinstance(formula, Not) else Not(formula)


def deciding(ruleset: Ruleset, rule: Rule, number: int) -> list[Formula]:
    """The conjuncts of the guard of a clause (`encoding.equation`), the trigger first, without double negations."""
    return list(simplified(guard(rule, ruleset.reading, number)))


def simplified(formula: Formula) -> Iterator[Formula]:
    """The conjuncts of a formula without double negations. ``true`` has none."""
    for part in conjuncts(formula):
        if isinstance(part, Not) and isinstance(part.operand, Not):
            yield from simplified(part.operand.operand)
        elif part != Truth(True):
            yield part


def unless(ruleset: Ruleset, rule: Rule, number: int, condition: Formula) -> Formula:
    """A condition for the trigger of a rule: clause `number` does not decide where `condition` holds, and every other
    clause keeps its situations."""
    if not rule.hedges:
        return negation(condition)
    outer = [] if rule.guard is None else list(simplified(rule.guard))
    own = [part for part in deciding(ruleset, rule, number)[1:] if part not in outer]
    return negation(conjunction([*own, condition]))
