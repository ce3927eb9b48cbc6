"""Equation 1 as sympy formulas, and as LaTeX."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
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
    Obligation,
    Or,
    Ruleset,
    ScaleValue,
    Term,
    Truth,
)
from sleec_verify.encoding.equation import implications
from sleec_verify.exchange.compilation.symbols import escaped, symbol

if TYPE_CHECKING:
    import sympy


class Line(NamedTuple):
    """A formula and its origin: ``dress_assist, hedge 1`` or the constraint."""

    title: str
    formula: sympy.Basic


def lines(ruleset: Ruleset) -> Iterator[Line]:
    """Equation 1 of every rule, one line for each clause that obliges something, then constraints and assumptions."""
    import sympy

    translate = Translator(ruleset)
    for rule in ruleset.rules:
        for number, guard, clause in implications(rule, ruleset.reading):
            title = f"{rule.label}, {f'hedge {number}' if number else 'default'}"
            if clause.obligations:
                # Not evaluated, because sympy would change the implication into a less readable form.
                response = translate.response(clause.obligations)
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


class Translator:
    """Translates formulas of a ruleset to sympy."""

    def __init__(self, ruleset: Ruleset) -> None:
        self._ruleset = ruleset

    def __call__(self, formula: Formula) -> sympy.Basic:
        import sympy

        if isinstance(formula, Atom):
            return sympy.Symbol(symbol(self._ruleset, formula.kind, formula.name))
        if isinstance(formula, Not):
            return sympy.Not(self(formula.operand))
        if isinstance(formula, And):
            return sympy.And(*map(self, formula.operands))
        if isinstance(formula, Or):
            return sympy.Or(*map(self, formula.operands))
        if isinstance(formula, Truth):
            return sympy.true if formula.value else sympy.false
        return self._comparison(formula)

    def response(self, obligations: Sequence[Obligation]) -> sympy.Basic:
        """What a clause obliges, as a conjunction of literals."""
        atoms: list[Formula] = [Atom("obligation", o.name) for o in obligations]
        literals = [Not(atom) if o.negated else atom for atom, o in zip(atoms, obligations)]
        return self(literals[0] if len(literals) == 1 else And(tuple(literals)))

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


def as_sympy(ruleset: Ruleset) -> str:
    """One formula per line, each below a comment with its origin."""
    return "\n".join(f"# {title}\n{formula}" for title, formula in lines(ruleset)) + "\n"


def as_latex(ruleset: Ruleset) -> str:
    """One aligned block with one line for each formula, for a document that loads amsmath."""
    from sympy import latex
    from sympy.core.symbol import Symbol

    rows = []
    for title, formula in lines(ruleset):
        names = {s: rf"\mathit{{{escaped(s.name)}}}" for s in formula.atoms(Symbol)}
        rows.append(rf"  & {latex(formula, symbol_names=names)} && \text{{{escaped(title)}}} \\")
    return "\n".join((r"\begin{align*}", *rows, r"\end{align*}")) + "\n"
