"""Which obligations cannot all be due: the minimal inconsistent sets of literals.

What is due in a context is a set of literals, and the context conflicts when these, the context and the constraints
have no common model over O (a "for all" over obligations inside an "exists" over contexts). The due literals are
units, so it is enough to know every minimal set of literals that the constraints rule out, each with the situations
in which they do: then "is there a conflicting context" is a plain question of satisfiability for each set.

The sets are prime implicates of the constraints over the literals that are obliged at all, found by resolution with
subsumption. The parts of a `NEVER` that speak of situations only are kept whole, as labels that a resolvent inherits.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable
from dataclasses import dataclass
from itertools import combinations

from sleec_runtime.model import And, Atom, Exclusive, Formula, Never, Not, Obligation, Or, Truth, leaves
from sleec_verify.equation import conjunction
from sleec_verify.solver import Undecided

Constraint = Exclusive | Never

LIMIT = 2_000
"""How many cases a NEVER may have, and how many sets constraints that are tied to one another may rule out, before
the question is given up."""

STEPS = 20_000
"""How many resolvents may be formed for one group of constraints before the question is given up."""


class TooEntangled(Undecided):
    """The constraints have more minimal inconsistent sets than `LIMIT`."""


@dataclass(frozen=True)
class Clash:
    """These literals cannot all be due where the situation makes all the `labels` true.

    `origins` are the constraints that rule it out; none for a name and its own negation.
    """

    literals: frozenset[Obligation]
    labels: frozenset[Formula] = frozenset()
    origins: tuple[Constraint, ...] = ()

    @property
    def situation(self) -> Formula:
        """Where the literals clash, as one formula over triggers, conditions and measures."""
        return conjunction(sorted(self.labels, key=repr))

    def subsumes(self, other: Clash) -> bool:
        return self.literals <= other.literals and self.labels <= other.labels


def opposite(literal: Obligation) -> Obligation:
    return Obligation(literal.name, not literal.negated)


def clashes(constraints: Iterable[Constraint], obliged: Collection[Obligation]) -> list[Clash]:
    """The minimal inconsistent sets of literals of `obliged` that these constraints give, without the sets of a name
    and its negation.

    Raises `TooEntangled` past `LIMIT`; worst case exponential in the constraints that share obligations, linear in
    the number of groups that share none.
    """
    found: list[Clash] = []
    for group in _groups([term for constraint in constraints for term in _terms(constraint)]):
        found += _eliminated(group, obliged)
    return found


def _groups(terms: list[Clash]) -> list[list[Clash]]:
    """The terms that are tied to one another by the obligations they share."""
    parent: dict[str, str] = {}

    def root(name: str) -> str:
        while parent.setdefault(name, name) != name:
            parent[name] = parent[parent[name]]
            name = parent[name]
        return name

    for term in terms:
        first, *rest = sorted(literal.name for literal in term.literals) or [""]
        for name in rest:
            parent[root(name)] = root(first)
    groups: dict[str, list[Clash]] = {}
    for term in terms:
        groups.setdefault(root(min((literal.name for literal in term.literals), default="")), []).append(term)
    return list(groups.values())


def _terms(constraint: Constraint) -> list[Clash]:
    if isinstance(constraint, Exclusive):
        names = sorted(set(constraint.names))
        return [
            Clash(frozenset((Obligation(a), Obligation(b))), origins=(constraint,)) for a, b in combinations(names, 2)
        ]
    found = []
    for literals, labels in _disjuncts(constraint.formula, True):
        if not any(opposite(literal) in literals for literal in literals):
            found.append(Clash(literals, labels, (constraint,)))
    return found


_Term = tuple[frozenset[Obligation], frozenset[Formula]]


def _disjuncts(formula: Formula, value: bool) -> list[_Term]:
    """The disjunctive normal form of "formula has this value" over obligations, situations kept whole."""
    if not any(isinstance(leaf, Atom) and leaf.kind == "obligation" for leaf in leaves(formula)):
        if isinstance(formula, Truth):
            return [(frozenset(), frozenset())] if formula.value == value else []
        return [(frozenset(), frozenset((formula if value else Not(formula),)))]
    if isinstance(formula, Not):
        return _disjuncts(formula.operand, not value)
    if isinstance(formula, Atom):
        return [(frozenset((Obligation(formula.name, not value),)), frozenset())]
    assert isinstance(formula, (And, Or))
    parts = [_disjuncts(operand, value) for operand in formula.operands]
    if isinstance(formula, Or) == value:
        return [term for part in parts for term in part]
    terms: list[_Term] = [(frozenset(), frozenset())]
    for part in parts:
        terms = list({(a | c, b | d): None for a, b in terms for c, d in part})
        if len(terms) > LIMIT:
            raise TooEntangled("a NEVER expands to more cases than can be listed")
    return terms


def _minimal(found: Iterable[Clash]) -> list[Clash]:
    """Those that no other subsumes, smallest first."""
    kept: list[Clash] = []
    by_literal: dict[Obligation | None, list[Clash]] = {}
    for clash in sorted(found, key=lambda c: (len(c.literals) + len(c.labels), len(c.origins))):
        # Whatever subsumes this one is kept under one of this one's literals, or has none.
        near = (other for literal in (None, *clash.literals) for other in by_literal.get(literal, ()))
        if not any(other.subsumes(clash) for other in near):
            by_literal.setdefault(min(clash.literals, default=None, key=str), []).append(clash)
            kept.append(clash)
    return kept


def _eliminated(terms: list[Clash], obliged: Collection[Obligation]) -> list[Clash]:
    """The minimal sets over `obliged`: resolve on one obligation after the other, and after each drop the sets with a
    literal of it that nothing obliges (Tison's method, kept to the literals that matter)."""
    found = _minimal(terms)
    counts: dict[str, int] = {}
    for term in found:
        for literal in term.literals:
            counts[literal.name] = counts.get(literal.name, 0) + 1
    steps = 0
    for name in sorted(counts, key=lambda name: (counts[name], name)):
        done, undone = Obligation(name), Obligation(name, True)
        fresh = []
        for one in [clash for clash in found if done in clash.literals]:
            for other in [clash for clash in found if undone in clash.literals]:
                steps += 1
                literals = (one.literals - {done}) | (other.literals - {undone})
                if not any(opposite(literal) in literals for literal in literals):
                    origins = sorted({*one.origins, *other.origins}, key=lambda origin: origin.span)
                    fresh.append(Clash(literals, one.labels | other.labels, tuple(origins)))
        idle = {literal for literal in (done, undone) if literal not in obliged}
        kept = [clash for clash in found if idle.isdisjoint(clash.literals)]
        if fresh or len(kept) < len(found):
            found = _minimal(kept + fresh)
        if len(found) > LIMIT or steps > STEPS:
            raise TooEntangled("the constraints rule out more combinations than can be listed")
    return found
