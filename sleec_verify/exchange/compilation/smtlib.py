"""Equation 1 in SMT-LIB 2.6, with measures as numbers: a scale is its ranks from 0."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import combinations

from sleec_runtime.model import (
    And,
    Assume,
    Atom,
    Comparison,
    Exclusive,
    Formula,
    Kind,
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
    relation_name,
)
from sleec_verify.encoding.equation import conjunction, disjunction, implications
from sleec_verify.encoding.trace_scope import Untimed
from sleec_verify.exchange.compilation.equation_one import EquationOne

_OPERATORS = {"<": "<", "<=": "<=", "=": "=", "!=": "distinct", ">=": ">=", ">": ">"}
_SORTS = {"number": "Real", "integer": "Int", "scale": "Int"}


def as_smtlib(ruleset: Ruleset, untimed: Untimed = "at") -> str:
    """Declarations, one named assertion for each clause, constraint and relation, and ``(check-sat)``."""
    equation = EquationOne(ruleset, untimed)
    excluded = (f"; {statement}" for statement in equation.excluded())
    writer = _Writer(equation)
    assertions = list(writer.assertions())
    text = (*_declarations(equation, writer.used), *assertions, *excluded, "(check-sat)")
    return "\n".join(text) + "\n"


def _declarations(equation: EquationOne, used: Mapping[Kind, set[str]]) -> Iterator[str]:
    ruleset = equation.ruleset
    mixed = any(measure.kind != "number" for measure in ruleset.measures.values())
    yield f"(set-logic {'QF_LIRA' if mixed else 'QF_LRA'})"
    declared: Mapping[Kind, frozenset[str]] = {
        "trigger": ruleset.triggers,
        "condition": ruleset.conditions,
        "obligation": ruleset.declared["obligation"],
    }
    for kind, names in declared.items():
        for name in sorted(names | used[kind]):
            yield f"(declare-const {_quoted(equation.symbol(kind, name))} Bool) ; {kind}"
    for measure in ruleset.measures.values():
        name = _quoted(measure.name)
        yield f"(declare-const {name} {_SORTS[measure.kind]}) ; {_described(measure)}"
        if measure.kind == "scale":
            yield f"(assert (<= 0 {name} {len(measure.values) - 1}))"


def _described(measure: Measure) -> str:
    return "scale: " + " < ".join(measure.values) if measure.kind == "scale" else measure.kind


class _Writer:
    def __init__(self, equation: EquationOne) -> None:
        self._equation = equation
        self._ruleset = equation.ruleset
        self.used: dict[Kind, set[str]] = {"trigger": set(), "condition": set(), "obligation": set()}
        """The names in the formulas so far."""

    def assertions(self) -> Iterator[str]:
        ruleset = self._ruleset
        for rule in ruleset.rules:
            for number, guard, clause in implications(rule, ruleset.reading):
                if clause.obligations:
                    response = self.formula(conjunction(list(map(self._equation.response, clause.obligations))))
                    yield self._named(f"(=> {self.formula(guard)} {response})", f"{rule.label} {number}")
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
        for position, (relation, disjunctions) in enumerate(self._equation.relations()):
            formula = conjunction(list(map(disjunction, disjunctions)))
            yield self._named(self.formula(formula), f"relation {position}: {relation_name(relation)}")

    def _named(self, formula: str, name: str) -> str:
        return f"(assert (! {formula} :named {_quoted(name)}))"

    def formula(self, formula: Formula) -> str:
        if isinstance(formula, Atom):
            self.used[formula.kind].add(formula.name)
            return _quoted(self._equation.symbol(formula.kind, formula.name))
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
