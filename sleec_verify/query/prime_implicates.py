"""The minimal inconsistent sets of constraints, as prime implicates.

The sets are prime implicates of the constraints over the literals that rules oblige, computed by resolution with
subsumption. Parts of a `NEVER` about situations only are not decomposed: a resolvent inherits them as labels.
"""

from __future__ import annotations

from collections.abc import Collection, Hashable, Iterable, Iterator

from sleec_runtime.model import And, Atom, Exclusive, Formula, Never, Not, Obligation, Or, Truth, leaves
from sleec_verify.encoding.budget import Undecided, spend
from sleec_verify.encoding.union_find import UnionFind
from sleec_verify.query.inconsistent_sets import Constraint, Exclusion, InconsistentSet, InconsistentSets, opposite
from sleec_verify.query.ruleset_index import RulesetIndex
from sleec_verify.wording.sentence import sentence

LIMIT = 2_000
"""The maximal number of cases of a NEVER, and of sets from a group of connected constraints."""

MOST_LISTED = 20
"""The maximal number of names of an EXCLUSIVE whose pairs are listed. A larger one is one `Exclusion`."""

STEPS = 20_000
"""The maximal number of resolvents for one group of constraints."""

_PER_STEP = 5
"""The cost of one resolvent in steps of a budget."""


class TooEntangled(Undecided):
    """The constraints have more minimal inconsistent sets than `LIMIT`."""


def inconsistent_sets_of(index: RulesetIndex) -> InconsistentSets:
    """Every minimal set of literals that the rules can oblige and that cannot all be obliged in one context."""
    return index.once(_inconsistent_sets)


def _inconsistent_sets(index: RulesetIndex) -> InconsistentSets:
    obliged = index.by_obligation
    direct = [
        InconsistentSet(frozenset((literal, opposite(literal))))
        for literal in obliged
        if not literal.negated and opposite(literal) in obliged
    ]
    declared = inconsistent_sets(index.constraints, obliged)
    return InconsistentSets([*direct, *declared.listed], declared.exclusions)


def constraints_on_situations(index: RulesetIndex) -> list[Constraint]:
    """The constraints that exclude a situation for all obligations, each alone or several together.

    Raises `Undecided` if the constraints are too entangled.
    """
    return index.once(_constraints_on_situations)


def _constraints_on_situations(index: RulesetIndex) -> list[Constraint]:
    without_literals = (found for found in inconsistent_sets_of(index).listed if not found.literals)
    return list(dict.fromkeys(origin for found in without_literals for origin in found.origins))


def inconsistent_sets(constraints: Iterable[Constraint], obliged: Collection[Obligation]) -> InconsistentSets:
    """The minimal inconsistent sets of literals of `obliged` under these constraints, without the sets of a name and
    its negation.

    Raises `TooEntangled` above `LIMIT`. Worst case exponential in the number of constraints that share obligations,
    linear in the number of independent groups.
    """
    constraints = list(constraints)
    nevers = [constraint.formula for constraint in constraints if isinstance(constraint, Never)]
    # Obligations that are resolved on must be listed.
    resolved = {name for formula in nevers for name in _negated(formula, True)}
    found: list[InconsistentSet] = []
    for group in _groups([term for constraint in constraints for term in _terms(constraint, resolved)]):
        found += _eliminated(group, obliged)
    alone = {literal for clash in found if len(clash.literals) == 1 and not clash.labels for literal in clash.literals}
    exclusions = []
    for constraint in constraints:
        if isinstance(constraint, Exclusive):
            literals = (Obligation(name) for name in _not_listed(constraint, resolved))
            within = tuple(literal for literal in literals if literal in obliged and literal not in alone)
            if len(within) > 1:
                exclusions.append(Exclusion(within, constraint))
    for exclusion in exclusions:
        excluded = frozenset(exclusion.literals)
        found = [clash for clash in found if len(excluded & clash.literals) < 2]
    return InconsistentSets(found, exclusions)


def _negated(formula: Formula, value: bool) -> Iterator[str]:
    """The obligations that are false in some case in which the formula has this value."""
    if isinstance(formula, Not):
        yield from _negated(formula.operand, not value)
    elif isinstance(formula, (And, Or)):
        for operand in formula.operands:
            yield from _negated(operand, value)
    elif isinstance(formula, Atom) and formula.kind == "obligation" and not value:
        yield formula.name


def _not_listed(constraint: Exclusive, resolved: Collection[str]) -> list[str]:
    """The names whose pairs are not listed."""
    names = sorted(set(constraint.names))
    return [name for name in names if name not in resolved] if len(names) > MOST_LISTED else []


def _groups(terms: list[InconsistentSet]) -> list[list[InconsistentSet]]:
    """The terms that are connected by shared obligations."""
    union = UnionFind()
    for term in terms:
        first, *rest = sorted(literal.name for literal in term.literals) or [""]
        for name in rest:
            union.join(first, name)
    groups: dict[Hashable, list[InconsistentSet]] = {}
    for term in terms:
        groups.setdefault(union.root(min((literal.name for literal in term.literals), default="")), []).append(term)
    return list(groups.values())


def _terms(constraint: Constraint, resolved: Collection[str]) -> list[InconsistentSet]:
    if isinstance(constraint, Exclusive):
        names, rest = sorted(set(constraint.names)), set(_not_listed(constraint, resolved))
        listed = [name for name in names if name not in rest]
        pairs = (
            (one, other)
            for at, one in enumerate(listed)
            for other in (*listed[at + 1 :], *(name for name in names if name in rest))
        )
        found = []
        for one, other in pairs:
            spend(_PER_STEP)
            found.append(InconsistentSet(frozenset((Obligation(one), Obligation(other))), origins=(constraint,)))
        return found
    found = []
    for literals, labels in _disjuncts(constraint.formula, True):
        if not any(opposite(literal) in literals for literal in literals):
            found.append(InconsistentSet(literals, labels, (constraint,)))
    return found


_Term = tuple[frozenset[Obligation], frozenset[Formula]]


def _disjuncts(formula: Formula, value: bool) -> list[_Term]:
    """The disjunctive normal form of "formula has this value" over obligations. Parts about situations are not
    decomposed."""
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
        spend(len(terms) * len(part))
        terms = list({(a | c, b | d): None for a, b in terms for c, d in part})
        if len(terms) > LIMIT:
            raise TooEntangled(sentence("a NEVER expands to too many cases"))
    return terms


def _minimal(found: Iterable[InconsistentSet]) -> list[InconsistentSet]:
    """Those that no other one subsumes, smallest first."""
    kept: list[InconsistentSet] = []
    bits: dict[Obligation, int] = {}
    by_literal: dict[Obligation | None, list[tuple[int, frozenset[Formula]]]] = {}
    for clash in sorted(found, key=lambda c: (len(c.literals) + len(c.labels), len(c.origins))):
        mask = sum(bits.setdefault(literal, 1 << len(bits)) for literal in clash.literals)
        # A set that subsumes this one is stored under one of this one's literals, or is empty.
        near = [by_literal.get(literal, ()) for literal in (None, *clash.literals)]
        spend(_PER_STEP + sum(map(len, near)) / 10)
        labels = clash.labels
        if not any(mask & other == other and inner <= labels for each in near for other, inner in each):
            by_literal.setdefault(min(clash.literals, default=None, key=str), []).append((mask, labels))
            kept.append(clash)
    return kept


def _eliminated(terms: list[InconsistentSet], obliged: Collection[Obligation]) -> list[InconsistentSet]:
    """The minimal sets over `obliged`. Resolves on one obligation after the other, and then drops the sets with a
    literal of it that no rule obliges (Tison's method, restricted to the relevant literals)."""
    found = _minimal(terms)
    counts: dict[Obligation, int] = {}
    for term in found:
        for literal in term.literals:
            counts[literal] = counts.get(literal, 0) + 1
    # For other names, there is nothing to resolve or drop.
    names = {literal.name for literal in counts if opposite(literal) in counts or literal not in obliged}
    steps = 0
    for name in sorted(
        names, key=lambda name: (counts.get(Obligation(name), 0) + counts.get(Obligation(name, True), 0), name)
    ):
        done, undone = Obligation(name), Obligation(name, True)
        fresh = []
        spend(len(found) / 2)
        for one in [clash for clash in found if done in clash.literals]:
            for other in [clash for clash in found if undone in clash.literals]:
                steps += 1
                spend(_PER_STEP)
                literals = (one.literals - {done}) | (other.literals - {undone})
                if not any(opposite(literal) in literals for literal in literals):
                    origins = sorted({*one.origins, *other.origins}, key=lambda origin: origin.span)
                    fresh.append(InconsistentSet(literals, one.labels | other.labels, tuple(origins)))
            if steps > STEPS:
                raise TooEntangled(sentence("the constraints exclude too many combinations"))
        idle = {literal for literal in (done, undone) if literal not in obliged}
        kept = [clash for clash in found if idle.isdisjoint(clash.literals)]
        if fresh or len(kept) < len(found):
            found = _minimal(kept + fresh)
        if fresh and len(found) > LIMIT:
            raise TooEntangled(sentence("the constraints exclude too many combinations"))
    return found
