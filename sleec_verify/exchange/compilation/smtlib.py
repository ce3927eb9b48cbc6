"""Equation 1 in SMT-LIB 2.6, with measures as numbers: a scale is its ranks from 0."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations

from sleec_runtime.model import (
    And,
    Assume,
    Atom,
    Clause,
    Comparison,
    Exclusive,
    Formula,
    Measure,
    MeasureRef,
    Never,
    Not,
    Number,
    Or,
    Rational,
    Ruleset,
    ScaleValue,
    Term,
    Truth,
)
from sleec_verify.encoding.equation import implications
from sleec_verify.exchange.compilation.symbols import symbol

_OPERATORS = {"<": "<", "<=": "<=", "=": "=", "!=": "distinct", ">=": ">=", ">": ">"}
_SORTS = {"number": "Real", "integer": "Int", "scale": "Int"}


def as_smtlib(ruleset: Ruleset) -> str:
    """Declarations, one named assertion for each clause and constraint, and ``(check-sat)``."""
    return "\n".join((*_declarations(ruleset), *_Writer(ruleset).assertions(), "(check-sat)")) + "\n"


def _declarations(ruleset: Ruleset) -> Iterator[str]:
    mixed = any(measure.kind != "number" for measure in ruleset.measures.values())
    yield f"(set-logic {'QF_LIRA' if mixed else 'QF_LRA'})"
    for kind, names in (
        ("trigger", ruleset.triggers),
        ("condition", ruleset.conditions),
        ("obligation", ruleset.obligations),
    ):
        for name in sorted(names):
            yield f"(declare-const {_quoted(symbol(ruleset, kind, name))} Bool) ; {kind}"  # type: ignore[arg-type]
    for measure in ruleset.measures.values():
        name = _quoted(measure.name)
        yield f"(declare-const {name} {_SORTS[measure.kind]}) ; {_described(measure)}"
        if measure.kind == "scale":
            yield f"(assert (<= 0 {name} {len(measure.values) - 1}))"


def _described(measure: Measure) -> str:
    return "scale: " + " < ".join(measure.values) if measure.kind == "scale" else measure.kind


class _Writer:
    def __init__(self, ruleset: Ruleset) -> None:
        self._ruleset = ruleset

    def assertions(self) -> Iterator[str]:
        ruleset = self._ruleset
        for rule in ruleset.rules:
            for number, guard, clause in implications(rule, ruleset.reading):
                if clause.obligations:
                    yield self._named(f"(=> {self.formula(guard)} {self._response(clause)})", f"{rule.label} {number}")
        for position, constraint in enumerate(ruleset.constraints):
            if isinstance(constraint, Exclusive):
                for a, b in combinations(sorted(set(constraint.names)), 2):
                    pair = And((Atom("obligation", a), Atom("obligation", b)))
                    yield f"(assert {self.formula(Not(pair))}) ; EXCLUSIVE"
            elif isinstance(constraint, Never):
                yield self._named(self.formula(Not(constraint.formula)), f"NEVER {position}")
            else:
                assert isinstance(constraint, Assume)
                yield self._named(self.formula(constraint.formula), f"ASSUME {position}")

    def _named(self, formula: str, name: str) -> str:
        return f"(assert (! {formula} :named {_quoted(name)}))"

    def _response(self, clause: Clause) -> str:
        atoms = (Atom("obligation", o.name) for o in clause.obligations)
        literals = [self.formula(Not(a) if o.negated else a) for a, o in zip(atoms, clause.obligations)]
        return literals[0] if len(literals) == 1 else f"(and {' '.join(literals)})"

    def formula(self, formula: Formula) -> str:
        if isinstance(formula, Atom):
            return _quoted(symbol(self._ruleset, formula.kind, formula.name))
        if isinstance(formula, Not):
            return f"(not {self.formula(formula.operand)})"
        if isinstance(formula, (And, Or)):
            word = "and" if isinstance(formula, And) else "or"
            return f"({word} {' '.join(map(self.formula, formula.operands))})"
        if isinstance(formula, Truth):
            return "true" if formula.value else "false"
        assert isinstance(formula, Comparison)
        both = (formula.left, formula.right)
        sides = " ".join(self._term(side, any(map(self._is_real, both))) for side in both)
        return f"({_OPERATORS[formula.operator]} {sides})"

    def _is_real(self, term: Term) -> bool:
        if isinstance(term, Number):
            return term.value.denominator != 1
        return isinstance(term, MeasureRef) and self._ruleset.measures[term.name].kind == "number"

    def _term(self, term: Term, real: bool) -> str:
        if isinstance(term, MeasureRef):
            name = _quoted(term.name)
            return f"(to_real {name})" if real and self._ruleset.measures[term.name].kind == "integer" else name
        if isinstance(term, Number):
            return _number(term.value, real)
        assert isinstance(term, ScaleValue), "calculations are rejected before"
        return str(term.rank)


def _number(value: Rational, real: bool) -> str:
    numerator, denominator = abs(value.numerator), value.denominator
    text = f"{numerator}.0" if real else str(numerator)
    if denominator != 1:
        text = f"(/ {numerator}.0 {denominator}.0)"
    return f"(- {text})" if value < 0 else text


def _quoted(name: str) -> str:
    return f"|{name}|"
