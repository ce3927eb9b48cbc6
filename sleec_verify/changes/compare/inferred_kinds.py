"""The kinds of names that only constraints or conditions mention, taken from the other ruleset.

A name that no rule uses and no declaration mentions is a condition in an `ASSUME` and an obligation in a `NEVER`. In a
guard or a hedge, a name is a condition if no rule has it as its trigger. These kinds are defaults, not statements of
the text: they change when the last rule that uses the name is deleted.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from functools import partial

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
    Rule,
    Ruleset,
    formulas_of,
    leaves,
    literals,
)
from sleec_verify.encoding.name_uses import formulas_beside_rules
from sleec_verify.encoding.statement_parts import with_formulas

_ASSUMED: tuple[Kind, ...] = ("trigger", "condition")
_FORBIDDEN: tuple[Kind, ...] = ("obligation", "condition", "trigger")
"""The kinds that a name may have in an `ASSUME` or a condition of a rule, and in a `NEVER`; the first that the name has
anywhere is its kind there."""


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
    conditions = _conditions_by_default(ruleset)
    if not open_names and not conditions:
        return ruleset
    stated = list(_stated(other))
    turned = {name for kind, name in stated if kind == "trigger" and name in conditions}
    open_names |= turned
    kinds = {(kind, name) for kind, name in stated if name in open_names}
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
        with_formulas(statement, partial(read, order=_FORBIDDEN if isinstance(statement, Never) else _ASSUMED))
        if isinstance(statement, (Assume, Never)) or (turned and isinstance(statement, Rule))
        else statement
        for statement in ruleset.statements
    )
    return replace(ruleset, statements=tuple(statements))


def _conditions_by_default(ruleset: Ruleset) -> set[str]:
    """The names that are conditions because rules use them so, and for no other reason."""
    used = {name for kind, name in _of_conditions(ruleset) if kind == "condition"}
    if not used:
        return used
    beside = (leaf for formula in formulas_beside_rules(ruleset) for leaf in leaves(formula))
    stated = {leaf.name for leaf in beside if isinstance(leaf, Atom)}
    return used - ruleset.declared["condition"] - stated


def _of_conditions(ruleset: Ruleset) -> Iterator[tuple[Kind, str]]:
    for rule in ruleset.rules:
        for formula in formulas_of(rule):
            yield from ((leaf.kind, leaf.name) for leaf in leaves(formula) if isinstance(leaf, Atom))


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
    yield from _of_conditions(ruleset)
    for rule in ruleset.rules:
        yield "trigger", rule.trigger
        for clause in rule.clauses():
            yield from (("obligation", literal.name) for literal in literals(clause))
