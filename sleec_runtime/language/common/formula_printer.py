"""Formulas as text, with as few parentheses as the grammar needs."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

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


class FormulaPrinter:
    """Prints formulas of structured English. Another language overrides what differs."""

    connectives: ClassVar[Mapping[type[Formula], str]] = {And: " AND ", Or: " OR ", Not: "NOT "}
    grouped: ClassVar[Mapping[type[Formula], tuple[type[Formula], ...]]] = {Or: (Or,), And: (And, Or), Not: (And, Or)}
    """The operands that need parentheses. AND binds tighter than OR; an OR in an OR was written with parentheses."""

    grouped_guard: ClassVar[tuple[type[Formula], ...]] = (Or,)
    """The guards that get parentheses, for readability."""

    def formula(self, formula: Formula) -> str:
        """A formula as text."""
        if isinstance(formula, Atom):
            return self.atom(formula)
        if isinstance(formula, (And, Or)):
            return self.joined(formula, [self.operand(operand, formula) for operand in formula.operands])
        if isinstance(formula, Not):
            return f"{self.connectives[Not]}{self.operand(formula.operand, formula)}"
        if isinstance(formula, Comparison):
            return f"{self.term(formula.left)} {self.operator(formula.operator)} {self.term(formula.right)}"
        return "true" if formula.value else "false"

    def guard(self, guard: Formula | None) -> str:
        """What follows an event that counts only under a condition."""
        if guard is None:
            return ""
        text = self.formula(guard)
        return self.connectives[And] + (f"({text})" if isinstance(guard, self.grouped_guard) else text)

    def operand(self, operand: Formula, of: Formula) -> str:
        """An operand of a connective, in parentheses if the grammar needs them."""
        text = self.formula(operand)
        return f"({text})" if isinstance(operand, self.grouped[type(of)]) else text

    def joined(self, formula: And | Or, operands: list[str]) -> str:
        return self.connectives[type(formula)].join(operands)

    def atom(self, atom: Atom) -> str:
        return atom.name

    def operator(self, operator: str) -> str:
        return operator

    def measure(self, name: str) -> str:
        return name

    def calculation(self, calculation: Calculation) -> str:
        return str(calculation)

    def term(self, term: Term) -> str:
        """One side of a comparison. A number that was written as the name of a constant keeps that name."""
        if isinstance(term, MeasureRef):
            return self.measure(term.name)
        if isinstance(term, ScaleValue):
            return term.value
        if isinstance(term, Calculation):
            return self.calculation(term)
        return term.constant if term.constant is not None else print_number(term.value)


print_formula = FormulaPrinter().formula


def print_number(value: Rational) -> str:
    """A number exactly: as a decimal if it has a finite one, as every number of a text has, else as a fraction."""
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
