"""Equation 1 as sympy formulas, and as LaTeX."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations
from typing import TYPE_CHECKING, NamedTuple

from sleec_runtime.model import (
    And,
    Assume,
    Atom,
    Calculation,
    Comparison,
    Exclusive,
    Formula,
    Never,
    Not,
    Number,
    Or,
    Ruleset,
    ScaleValue,
    Term,
    Truth,
    relation_name,
)
from sleec_verify.encoding.equation import conjunction, disjunction, implications
from sleec_verify.encoding.trace_scope import Untimed
from sleec_verify.exchange.compilation.equation_one import EquationOne
from sleec_verify.exchange.compilation.symbols import escaped

if TYPE_CHECKING:
    import sympy


class Line(NamedTuple):
    """A formula and its origin: ``dress_assist, hedge 1`` or the constraint."""

    title: str
    formula: sympy.Basic


def lines(equation: EquationOne) -> Iterator[Line]:
    """Equation 1 of every rule, one line for each clause that obliges something, then constraints, assumptions and
    relations."""
    import sympy

    ruleset = equation.ruleset
    translate = Translator(equation)
    for rule in ruleset.rules:
        for number, guard, clause in implications(rule, ruleset.reading):
            title = f"{rule.label}, {f'hedge {number}' if number else 'default'}"
            if clause.obligations:
                # Not evaluated, because sympy would change the implication into a less readable form.
                response = translate(conjunction(list(map(equation.response, clause.obligations))))
                yield Line(title, sympy.Implies(translate(guard), response, evaluate=False))
    for constraint in ruleset.constraints:
        if isinstance(constraint, Exclusive):
            for a, b in combinations(sorted(set(constraint.names)), 2):
                pair = And((Atom("obligation", a), Atom("obligation", b)))
                yield Line("EXCLUSIVE", sympy.Not(translate(pair)))
        elif isinstance(constraint, Never):
            yield Line("NEVER", sympy.Not(translate(constraint.formula)))
        else:
            assert isinstance(constraint, Assume)
            yield Line("ASSUME", translate(constraint.formula))
    for relation, disjunctions in equation.relations():
        formula = conjunction(list(map(disjunction, disjunctions)))
        yield Line(relation_name(relation), translate(formula))


class Translator:
    """Translates formulas of a ruleset to sympy."""

    def __init__(self, equation: EquationOne) -> None:
        self._equation = equation

    def __call__(self, formula: Formula) -> sympy.Basic:
        import sympy

        if isinstance(formula, Atom):
            return sympy.Symbol(self._equation.symbol(formula.kind, formula.name))
        if isinstance(formula, Not):
            return sympy.Not(self(formula.operand))
        if isinstance(formula, And):
            return sympy.And(*map(self, formula.operands))
        if isinstance(formula, Or):
            return sympy.Or(*map(self, formula.operands))
        if isinstance(formula, Truth):
            return sympy.true if formula.value else sympy.false
        return self._comparison(formula)

    def _comparison(self, comparison: Comparison) -> sympy.Basic:
        import sympy

        operators = {"<": sympy.Lt, "<=": sympy.Le, "=": sympy.Eq, "!=": sympy.Ne, ">=": sympy.Ge, ">": sympy.Gt}
        sides = (self._term(comparison.left), self._term(comparison.right))
        return operators[comparison.operator](*sides, evaluate=False)

    def _term(self, term: Term) -> sympy.Basic:
        import sympy

        if isinstance(term, Number):
            return sympy.Rational(term.value) if term.constant is None else sympy.Symbol(term.constant)
        assert not isinstance(term, Calculation), "calculations are rejected before"
        return sympy.Symbol(term.value if isinstance(term, ScaleValue) else term.name)


def as_sympy(ruleset: Ruleset, untimed: Untimed = "at") -> str:
    """One formula per line, each below a comment with its origin."""
    equation = EquationOne(ruleset, untimed)
    rows = [f"# {title}\n{formula}" for title, formula in lines(equation)]
    return "\n".join((*rows, *(f"# {excluded}" for excluded in equation.excluded()))) + "\n"


def as_latex(ruleset: Ruleset, untimed: Untimed = "at") -> str:
    """One aligned block with one line for each formula, for a document that loads amsmath."""
    from sympy import latex
    from sympy.core.symbol import Symbol

    equation = EquationOne(ruleset, untimed)
    rows = []
    for title, formula in lines(equation):
        names = {s: _latex_name(s.name, equation) for s in formula.atoms(Symbol)}
        rows.append(rf"  & {latex(formula, symbol_names=names)} && \text{{{escaped(title)}}} \\")
    comments = (f"% {excluded}" for excluded in equation.excluded())
    return "\n".join((r"\begin{align*}", *rows, r"\end{align*}", *comments)) + "\n"


def _latex_name(name: str, equation: EquationOne) -> str:
    atom = equation.windows.get(name)
    if atom is None:
        return rf"\mathit{{{escaped(name)}}}"
    last = r"\infty)" if atom.last is None else f"{escaped(atom.last)}]"
    return rf"\mathit{{{escaped(atom.event)}}}_{{[{escaped(atom.first)},{last}}}"
