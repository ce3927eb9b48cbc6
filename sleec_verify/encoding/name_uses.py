"""The uses of names, for checks of the text."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from sleec_runtime.model import (
    NOWHERE,
    Assume,
    Atom,
    Comparison,
    Constant,
    DeclaredKind,
    Exclusive,
    Formula,
    Never,
    Number,
    Rule,
    Ruleset,
    ScaleValue,
    Span,
    formulas_of,
    leaves,
    literals,
    measures_of,
)

if TYPE_CHECKING:
    from sleec_runtime.model import Length


def _formulas(ruleset: Ruleset) -> Iterator[Formula]:
    yield from formulas_beside_rules(ruleset)
    for rule in ruleset.rules:
        yield from formulas_of(rule)
    for constraint in ruleset.constraints:
        if isinstance(constraint, (Never, Assume)):
            yield constraint.formula


def formulas_beside_rules(ruleset: Ruleset) -> list[Formula]:
    """The conditions of concerns, purposes and relations."""
    return _beside_rules(ruleset)[1]


def events_of_rules(ruleset: Ruleset) -> set[str]:
    """The events that trigger rules, or that rules require or forbid."""
    triggers = {rule.trigger for rule in ruleset.rules}
    return triggers | {o.name for rule in ruleset.rules for clause in rule.clauses() for o in literals(clause)}


def _beside_rules(ruleset: Ruleset) -> tuple[set[str], list[Formula], list[Length]]:
    """The events and formulas of concerns, purposes and relations, and the lengths of all windows."""
    if not ruleset.is_timed:
        return set(), [], []
    from sleec_verify.encoding.mentioned_names import names_beside_rules

    return names_beside_rules(ruleset)


def names_used(ruleset: Ruleset) -> dict[DeclaredKind, set[str]]:
    """The names that rules and constraints use, by kind. Measures count as conditions. An event counts wherever it
    is used."""
    used: dict[DeclaredKind, set[str]] = {"trigger": set(), "condition": set(), "obligation": set()}
    events, _, lengths = _beside_rules(ruleset)
    used["condition"].update(name for length in lengths for name in length.measures)
    for formula in _formulas(ruleset):
        for leaf in leaves(formula):
            if isinstance(leaf, Atom):
                used[leaf.kind].add(leaf.name)
            else:
                used["condition"].update(measures_of(leaf))
    for rule in ruleset.rules:
        used["trigger"].add(rule.trigger)
        used["obligation"].update(o.name for clause in rule.clauses() for o in literals(clause))
    for constraint in ruleset.constraints:
        if isinstance(constraint, Exclusive):
            used["obligation"].update(constraint.names)
    used["event"] = events | used["trigger"] | used["obligation"]
    return used


def constants_used(ruleset: Ruleset) -> set[str]:
    """The constants that comparisons, calculations or other constants name."""
    used = set(ruleset.calculated_with)
    used |= {s.alias for s in ruleset.statements if isinstance(s, Constant) and s.alias is not None}
    amounts = [length.amount for length in _beside_rules(ruleset)[2]]
    used |= {a.constant for a in amounts if isinstance(a, Number) and a.constant is not None}
    for formula in _formulas(ruleset):
        for leaf in leaves(formula):
            if isinstance(leaf, Comparison):
                for side in (leaf.left, leaf.right):
                    if isinstance(side, Number) and side.constant is not None:
                        used.add(side.constant)
                    elif isinstance(side, ScaleValue):
                        # Comparing a scale with a constant is an error, but a use.
                        used.add(side.value)
    return used


def mentions(ruleset: Ruleset, name: str) -> tuple[Span, tuple[str, ...]]:
    """The first place at which the rules mention a name, and the labels of the rules that do."""
    spans: list[Span] = []
    labels = []
    for rule in ruleset.rules:
        found = list(_spans(rule, name))
        if found:
            labels.append(rule.label)
            spans += found
    return (min(spans) if spans else NOWHERE), tuple(labels)


def _spans(rule: Rule, name: str) -> Iterator[Span]:
    if rule.trigger == name and rule.always is None:
        yield rule.trigger_span
    for clause in rule.clauses():
        yield from (o.span for o in literals(clause) if o.name == name)
    for formula in formulas_of(rule):
        for leaf in leaves(formula):
            named = (leaf.name,) if isinstance(leaf, Atom) else measures_of(leaf)
            if name in named:
                yield leaf.span
