"""The names that formulas, rules and constraints mention."""

from __future__ import annotations

from collections.abc import Iterator

from sleec_runtime.model import Atom, Exclusive, Formula, Never, Rule, formulas_of, leaves, measures_of

Name = tuple[str, str]
"""A trigger (``("trigger", name)``), or a condition or measure (``("condition", name)``)."""


def names_in(formula: Formula) -> Iterator[Name]:
    """The triggers, conditions and measures that a formula names, without obligations."""
    for leaf in leaves(formula):
        if isinstance(leaf, Atom):
            if leaf.kind != "obligation":
                yield leaf.kind, leaf.name
        else:
            for measure in measures_of(leaf):
                yield "condition", measure


def obligations_in(constraint: Exclusive | Never) -> Iterator[str]:
    """The obligations that a constraint names, including repeats."""
    if isinstance(constraint, Exclusive):
        yield from constraint.names
    else:
        for leaf in leaves(constraint.formula):
            if isinstance(leaf, Atom) and leaf.kind == "obligation":
                yield leaf.name


def names_of_constraint(constraint: Exclusive | Never) -> Iterator[Name]:
    """The triggers, conditions and measures that a constraint names."""
    if isinstance(constraint, Never):
        yield from names_in(constraint.formula)


def names_of_rule(rule: Rule) -> Iterator[Name]:
    """The trigger, conditions and measures that decide a rule."""
    yield "trigger", rule.trigger
    for formula in formulas_of(rule):
        yield from names_in(formula)
