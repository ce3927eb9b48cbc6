"""From formulas back to text, with as few parentheses as they can be read with."""

from __future__ import annotations

from sleec_runtime.model import (
    And,
    Atom,
    Calculation,
    Comparison,
    Formula,
    MeasureRef,
    Not,
    Or,
    Rational,
    ScaleValue,
    Term,
)


def print_formula(formula: Formula) -> str:
    """A formula as text."""
    if isinstance(formula, Atom):
        return formula.name
    if isinstance(formula, Or):
        # AND binds tighter than OR and needs no parentheses in it; an OR in an OR was written with them.
        return " OR ".join(_operand(operand, Or) for operand in formula.operands)
    if isinstance(formula, And):
        return " AND ".join(_operand(operand, (And, Or)) for operand in formula.operands)
    if isinstance(formula, Not):
        return f"NOT {_operand(formula.operand, (And, Or))}"
    if isinstance(formula, Comparison):
        return f"{print_term(formula.left)} {formula.operator} {print_term(formula.right)}"
    return "true" if formula.value else "false"


def print_term(term: Term) -> str:
    """One side of a comparison; a number that was written by the name of a constant keeps that name."""
    if isinstance(term, MeasureRef):
        return term.name
    if isinstance(term, ScaleValue):
        return term.value
    if isinstance(term, Calculation):
        return str(term)
    return term.constant if term.constant is not None else print_number(term.value)


def print_number(value: Rational) -> str:
    """A number exactly: as a decimal if it has one that ends, as every number of a text does, else as a fraction."""
    if value.denominator == 1:
        return str(int(value))
    digits, rest = 0, value.denominator
    for prime in (2, 5):
        power = 0
        while rest % prime == 0:
            rest //= prime
            power += 1
        digits = max(digits, power)
    if rest != 1:
        return str(value)
    scaled = str(abs(int(value * 10**digits))).rjust(digits + 1, "0")
    return f"{'-' if value < 0 else ''}{scaled[:-digits]}.{scaled[-digits:]}"


def _operand(formula: Formula, in_parentheses: type | tuple[type, ...]) -> str:
    text = print_formula(formula)
    return f"({text})" if isinstance(formula, in_parentheses) else text


def guard_text(guard: Formula | None) -> str:
    """What stands behind an event, if the event counts only under a condition."""
    return "" if guard is None else f" AND {_operand(guard, Or)}"
