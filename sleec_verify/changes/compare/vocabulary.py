"""The names that only one of two rulesets uses. Names that are only declared do not count."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from sleec_runtime.model import (
    Atom,
    Exclusive,
    Formula,
    Rule,
    Ruleset,
    formulas_of,
    leaves,
    literals,
    measures_of,
)
from sleec_verify.changes.compare.result import NameChange, Way
from sleec_verify.changes.compare.rule_alignment import Alignment

_Named = tuple[str, str]

KINDS = ("trigger", "condition", "measure", "obligation", "domain")


def name_changes(old: Ruleset, new: Ruleset, aligned: Alignment) -> Iterator[NameChange]:
    """The added and removed names, by kind. Names of equal rules are checked only if one of the others is missing
    on a side. O(size of the rules) at most."""
    sides = [
        {*_of_rules(rule for pair in aligned.changed if (rule := pair[at]) is not None), *_of_constraints(ruleset)}
        for at, ruleset in enumerate((old, new))
    ]
    only: list[set[_Named]] = [sides[0] - sides[1], sides[1] - sides[0]]
    if any(only):
        shared = set(_of_rules(one for one, _ in aligned.same))
        only = [names - shared for names in only]
    only[0].update(("domain", name) for name in set(old.domains) - set(new.domains))
    only[1].update(("domain", name) for name in set(new.domains) - set(old.domains))
    ways: tuple[Way, Way] = ("removed", "added")
    found = [NameChange(way, kind, name) for way, names in zip(ways, only) for kind, name in names]
    yield from sorted(found, key=lambda one: (one.way, KINDS.index(one.kind), one.name))


def _of_rules(rules: Iterable[Rule]) -> Iterator[_Named]:
    for rule in rules:
        yield "trigger", rule.trigger
        for formula in formulas_of(rule):
            yield from _of_formula(formula)
        for clause in rule.clauses():
            yield from (("obligation", obligation.name) for obligation in literals(clause))


def _of_constraints(ruleset: Ruleset) -> Iterator[_Named]:
    for constraint in ruleset.constraints:
        if isinstance(constraint, Exclusive):
            yield from (("obligation", name) for name in constraint.names)
        else:
            yield from _of_formula(constraint.formula)


def _of_formula(formula: Formula) -> Iterator[_Named]:
    for leaf in leaves(formula):
        if isinstance(leaf, Atom):
            yield leaf.kind, leaf.name
        else:
            yield from (("measure", name) for name in measures_of(leaf))
