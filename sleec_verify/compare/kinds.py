"""The kinds of names that only constraints mention, taken from the other ruleset.

A name that no rule uses and no declaration mentions is a condition in an `ASSUME` and an obligation in a `NEVER`. Its
kind is a default, not a statement of the text: it changes when the last rule that uses the name is deleted.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from sleec_runtime.model import (
    And,
    Assume,
    Atom,
    Exclusive,
    Formula,
    Kind,
    Never,
    Not,
    Or,
    Ruleset,
    formulas_of,
    leaves,
    literals,
)

_ASSUMED: tuple[Kind, ...] = ("trigger", "condition")
_FORBIDDEN: tuple[Kind, ...] = ("obligation", "condition", "trigger")
"""The kinds that a name may have in such a constraint; the first that the name has anywhere is its kind there."""


def with_kinds_of(ruleset: Ruleset, other: Ruleset) -> Ruleset:
    """The ruleset with the kinds of the other one for the names whose kind it does not state. O(size of the rules)."""
    mentioned = {
        leaf.name
        for constraint in ruleset.constraints
        if isinstance(constraint, (Assume, Never))
        for leaf in leaves(constraint.formula)
        if isinstance(leaf, Atom)
    }
    open_names = mentioned - {name for _, name in _stated(ruleset)} if mentioned else mentioned
    if not open_names:
        return ruleset
    kinds = {(kind, name) for kind, name in _stated(other) if name in open_names}
    if not kinds:
        return ruleset

    def read(formula: Formula, order: tuple[Kind, ...]) -> Formula:
        if isinstance(formula, Not):
            return replace(formula, operand=read(formula.operand, order))
        if isinstance(formula, (And, Or)):
            return replace(formula, operands=tuple(read(operand, order) for operand in formula.operands))
        if isinstance(formula, Atom) and formula.name in open_names:
            found = next((kind for kind in order if (kind, formula.name) in kinds), formula.kind)
            return replace(formula, kind=found)
        return formula

    statements = (
        replace(statement, formula=read(statement.formula, _ASSUMED if isinstance(statement, Assume) else _FORBIDDEN))
        if isinstance(statement, (Assume, Never))
        else statement
        for statement in ruleset.statements
    )
    return replace(ruleset, statements=tuple(statements))


def _stated(ruleset: Ruleset) -> Iterator[tuple[Kind, str]]:
    """The names that declarations, rules and each `EXCLUSIVE` mention, with their kinds."""
    for kind in _FORBIDDEN:
        yield from ((kind, name) for name in ruleset.declared[kind])
    for name in ruleset.declared["event"]:
        yield "trigger", name
        yield "obligation", name
    for constraint in ruleset.constraints:
        if isinstance(constraint, Exclusive):
            yield from (("obligation", name) for name in constraint.names)
    for rule in ruleset.rules:
        yield "trigger", rule.trigger
        for formula in formulas_of(rule):
            yield from ((leaf.kind, leaf.name) for leaf in leaves(formula) if isinstance(leaf, Atom))
        for clause in rule.clauses():
            yield from (("obligation", literal.name) for literal in literals(clause))
