"""Formulas as text in either dialect of the DSL.

The LEGOS dialect has measures in braces and every operation in parentheses; the SLEEC-TK dialect has as few parentheses
as the grammar needs.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

from sleec_runtime.language.common.formula_printer import FormulaPrinter
from sleec_runtime.language.common.token_cursor import MAX_DEPTH
from sleec_runtime.model import And, Atom, Calculation, Comparison, Formula, Not, Or


class SleecTkFormulaPrinter(FormulaPrinter):
    """Prints formulas in the SLEEC-TK dialect."""

    connectives: ClassVar[Mapping[type[Formula], str]] = {And: " and ", Or: " or ", Not: "not "}
    grouped: ClassVar[Mapping[type[Formula], tuple[type[Formula], ...]]] = {
        And: (And, Or),
        Or: (And, Or),
        Not: (Not, And, Or),
    }
    grouped_guard: ClassVar[tuple[type[Formula], ...]] = ()

    def operator(self, operator: str) -> str:
        return "<>" if operator == "!=" else operator


class LegosFormulaPrinter(SleecTkFormulaPrinter):
    """Prints formulas in the LEGOS dialect."""

    grouped: ClassVar[Mapping[type[Formula], tuple[type[Formula], ...]]] = {And: (), Or: (), Not: ()}

    def formula(self, formula: Formula) -> str:
        text = super().formula(formula)
        return f"({text})" if isinstance(formula, (And, Or, Not, Comparison)) else text

    def joined(self, formula: And | Or, operands: list[str]) -> str:
        """Two operands at a time: ``a and (b and c)``."""
        if len(operands) > MAX_DEPTH // 2:
            return super().joined(formula, operands)
        *others, last = operands
        nested = [f"{'(' if n else ''}{text}" for n, text in enumerate(others)]
        return super().joined(formula, [*nested, last]) + ")" * (len(operands) - 2)

    def atom(self, atom: Atom) -> str:
        return atom.name if atom.kind == "trigger" else self.measure(atom.name)

    def measure(self, name: str) -> str:
        return f"{{{name}}}"

    def calculation(self, calculation: Calculation) -> str:
        return calculation.written(self.measure, "({})".format)
