"""Rules up to renaming. Conditions of one shape differ only in names, and the names have the same order.

Everything that follows from the structure of the conditions and the order of their names is the same for rules of one
shape.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import NamedTuple

from sleec_runtime.model import (
    And,
    Atom,
    Comparison,
    Formula,
    Measure,
    MeasureRef,
    Not,
    Number,
    Obligation,
    Or,
    Rule,
    ScaleValue,
    Term,
    formulas_of,
)
from sleec_verify.query.ruleset_index import RulesetIndex
from sleec_verify.results.finding import Witness

LARGEST = 100
"""The maximal number of nodes of formulas with a shape. Larger formulas rarely share one."""

Key = tuple[object, ...]


class Shape(NamedTuple):
    """The shape of some formulas, as a key, and their names in the order of the shape."""

    key: Key
    names: tuple[tuple[str, str], ...]

    def renamed(self, witness: Witness, names: tuple[tuple[str, str], ...]) -> Witness:
        """The situation of these formulas that corresponds to one of formulas with the same shape and these names."""
        new = {old: name for old, (_, name) in zip(names, self.names)}
        return Witness(
            tuple(new["trigger", name] for name in witness.triggers),
            {new["condition", name]: value for name, value in witness.conditions.items()},
            tuple(new["trigger", name] for name in witness.absent),
        )


def shape_of(formulas: Iterable[Formula], measures: Mapping[str, Measure]) -> Shape | None:
    """The shape of some formulas. None if they are large, or compare measures with each other."""
    found = _Nodes(measures)
    try:
        tops = [found.node(formula) for formula in formulas]
    except _Unshaped:
        return None
    names = tuple(sorted(found.names))
    rank = {found.names[name]: at for at, name in enumerate(names)}
    # Names are ranked by their first use.
    ranks = tuple(rank[at] for at in range(len(names)))
    return Shape((tuple(tops), ranks, *found.nodes), names)


def shape_at(index: RulesetIndex, position: int) -> Shape | None:
    """The shape of the rule at `position`, if a question about it alone has the same answer for all rules of its shape.

    None if assumptions may distinguish them, or if every question is recorded.
    """
    if index.assumptions or index.recorder is not None:
        return None
    known = index.once(_shapes)
    if position not in known:
        known[position] = shape_of_rule(index.rules[position], index.ruleset.measures)
    return known[position]


def _shapes(_: RulesetIndex) -> dict[int, Shape | None]:
    return {}


def shape_of_rule(rule: Rule, measures: Mapping[str, Measure]) -> Shape | None:
    """The shape of a rule: of its conditions, and of which clauses oblige the same. None if `shape_of` is None, or
    for a rule with nested chains or times."""
    clauses = (rule.default, *rule.hedges)
    due: dict[Obligation, int] = {}
    same = []
    for clause in clauses:
        if clause.hedges or any(obligation.timing is not None for obligation in clause.obligations):
            return None
        same.append(tuple(due.setdefault(obligation, len(due)) for obligation in clause.obligations))
    shape = shape_of((Atom("trigger", rule.trigger), *formulas_of(rule)), measures)
    return None if shape is None else shape._replace(key=(rule.guard is None, tuple(same), *shape.key))


class _Unshaped(Exception):
    """There is no shape."""


class _Nodes:
    """The nodes of formulas in postorder, with each name at its first use. A shared object is one node."""

    def __init__(self, measures: Mapping[str, Measure]) -> None:
        self._measures = measures
        self._places: dict[int, int] = {}
        self.names: dict[tuple[str, str], int] = {}
        self.nodes: list[Key] = []

    def node(self, formula: Formula) -> int:
        place = self._places.get(id(formula))
        if place is None:
            self.nodes.append(self._key(formula))
            place = self._places[id(formula)] = len(self.nodes) - 1
            if place >= LARGEST:
                raise _Unshaped
        return place

    def _key(self, formula: Formula) -> Key:
        if isinstance(formula, Atom):
            return (formula.kind, self._name(formula.kind, formula.name))
        if isinstance(formula, Not):
            return ("not", self.node(formula.operand))
        if isinstance(formula, (And, Or)):
            return ("and" if isinstance(formula, And) else "or", *map(self.node, formula.operands))
        if isinstance(formula, Comparison):
            if isinstance(formula.left, MeasureRef) and isinstance(formula.right, MeasureRef):
                raise _Unshaped
            return (formula.operator, self._term(formula.left), self._term(formula.right))
        return ("truth", formula.value)

    def _name(self, kind: str, name: str) -> int:
        return self.names.setdefault((kind, name), len(self.names))

    def _term(self, term: Term) -> object:
        if isinstance(term, MeasureRef):
            measure = self._measures[term.name]
            return (self._name("condition", term.name), measure.kind, measure.values)
        if isinstance(term, Number):
            return term.value
        if isinstance(term, ScaleValue):
            return ("value", term.rank)
        raise _Unshaped
