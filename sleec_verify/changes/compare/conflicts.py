"""Situations that conflict on one side only. By Definition 1, a conflict entails everything. So these situations
are reported as conflicts, and never as added obligations."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import product
from typing import Union

from sleec_runtime.model import Exclusive, Formula, Never, Not, Obligation, Truth
from sleec_verify.changes.compare.comparison import SIDES, Comparison, SideName, none_of, other
from sleec_verify.changes.compare.replay import conflicts as conflicting
from sleec_verify.changes.compare.replay import deciding, possible
from sleec_verify.changes.compare.result import ConflictChange, Undecidable, Way
from sleec_verify.changes.compare.situation_count import (
    SituationCounter,
    all_of,
    conditions_of,
    names_of_formulas,
    unknown_extent,
)
from sleec_verify.changes.diagram.decision_diagram import FALSE, TooLarge
from sleec_verify.encoding.equation import disjunction
from sleec_verify.encoding.solver import Undecided
from sleec_verify.query.inconsistent_sets import InconsistentSet
from sleec_verify.query.witness import smallest_situation
from sleec_verify.wording.phrases import grouped
from sleec_verify.wording.sentence import sentence

MOST, MOST_PER_RULE = 2_000, 10
"""The maximal number of causes on each side: this number, plus more for each rule. Contradicting rules multiply."""


def conflict_changes(comparison: Comparison) -> Iterator[Union[ConflictChange, Undecidable]]:
    """For each minimal inconsistent set of literals and each set of rules that oblige them, the situations in which
    they do so on one side and nothing conflicts on the other.

    Complete: if a situation conflicts on one side only, then either a changed rule obliges a literal of an inconsistent
    set, or a constraint of it has changed.
    """
    for way, which in (("removed", SIDES[0]), ("added", SIDES[1])):
        try:
            yield from _on(comparison, which, "added" if way == "added" else "removed")
        except Undecided as error:
            yield Undecidable(sentence("conflicts"), error.message)


def _on(comparison: Comparison, which: SideName, way: Way) -> Iterator[Union[ConflictChange, Undecidable]]:
    seen: dict[frozenset[Obligation], list[tuple[frozenset[int], Formula]]] = {}
    most = MOST + MOST_PER_RULE * len(comparison.rows)
    for tried, (clash, rows) in enumerate(_causes(comparison, which)):
        if tried >= most:
            why = sentence(
                "only the first {number} sets of rules with possible conflicts were examined", number=grouped(most)
            )
            yield Undecidable(sentence("conflicts"), why)
            return
        within = [region for smaller, region in seen.get(clash.literals, ()) if smaller < rows]
        region = _region(comparison, which, clash, rows)
        found = _found(comparison, which, way, clash, rows, region, within)
        if found is not None:
            seen.setdefault(clash.literals, []).append((rows, region))
            yield found


def _causes(comparison: Comparison, which: SideName) -> Iterator[tuple[InconsistentSet, frozenset[int]]]:
    """The inconsistent sets that a changed rule or constraint may cause, each with the rules that oblige its
    literals, smaller sets of rules first."""
    changed = {places[which] for _, places in comparison.changed if which in places}
    mine, theirs = (_constraints(comparison, side) for side in (which, other(which)))
    new_constraints = [constraint for constraint in mine if constraint not in theirs]
    names = {o.name for row in changed for o in comparison.literals(row, which)}
    names.update(name for constraint in new_constraints for name in _names(constraint))
    if not names and not new_constraints:
        return
    tied = comparison.constraints_about(which, names)
    names.update(name for constraint in tied for name in _names(constraint))
    obliging = _obliging(comparison, which, names)
    for clash in comparison.inconsistent_sets(which, set(obliging)):
        is_new = any(origin in new_constraints for origin in clash.origins)
        chosen = {
            frozenset(rows)
            for rows in product(*(obliging[literal] for literal in sorted(clash.literals, key=str)))
            if is_new or not changed.isdisjoint(rows)
        }
        for rows in sorted(chosen, key=lambda rows: (len(rows), sorted(rows))):
            yield clash, rows


def _constraints(comparison: Comparison, which: SideName) -> list[Exclusive | Never]:
    return comparison.sides[which].constraints


def _names(constraint: Exclusive | Never) -> Iterator[str]:
    from sleec_verify.query.names import obligations_in

    return obligations_in(constraint)


def _obliging(comparison: Comparison, which: SideName, names: set[str]) -> dict[Obligation, list[int]]:
    """The rows that oblige each literal of these names at once. Without a constraint, a literal that nothing
    forbids is irrelevant."""
    found: dict[Obligation, list[int]] = {}
    for row, (old, new) in enumerate(comparison.rows):
        rule = old if which == "old" else new
        if rule is None:
            continue
        for clause in rule.clauses():
            for literal in clause.obligations:
                if literal.name in names and literal.timing is None:
                    rows = found.setdefault(literal, [])
                    if not rows or rows[-1] != row:
                        rows.append(row)
    return found


def _region(comparison: Comparison, which: SideName, clash: InconsistentSet, rows: Iterable[int]) -> Formula:
    """The situations in which these rules oblige every literal of the inconsistent set, and its labels hold."""
    parts = [
        disjunction(
            [f for f in (comparison.obliges(row, which, literal.__eq__) for row in sorted(rows)) if f != Truth(False)]
        )
        for literal in sorted(clash.literals, key=str)
    ]
    return all_of([*parts, *sorted(clash.labels, key=repr)])


def _found(
    comparison: Comparison,
    which: SideName,
    way: Way,
    clash: InconsistentSet,
    rows: frozenset[int],
    region: Formula,
    within: list[Formula],
) -> ConflictChange | None:
    rules = [rule for rule in (comparison.rows[row].on(which) for row in sorted(rows)) if rule is not None]
    triggers = {rule.trigger for rule in rules}
    cone = comparison.cone(triggers)
    peace = comparison.conflict(cone.rows, other(which))
    excluded = [*within, peace]
    situation = all_of([region, *none_of(excluded)])
    own = conditions_of(comparison.sides[which].plain(rule) for rule in rules)
    try:
        everything = [*own, region, *excluded]
        counting = SituationCounter(everything, cone.in_force(all_of(everything)), triggers, comparison.measures)
        node = counting.where(region, excluded)
        if node == FALSE:
            return None
        free = counting.where(region)
        situation = all_of([region, *(Not(formula) for formula in excluded if counting.meets(free, formula))])
        extent = counting.extent(node, [*names_of_formulas(own), *names_of_formulas(clash.labels)])
    except TooLarge as error:
        extent = unknown_extent(triggers, str(error))
    witness = smallest_situation(cone.assumed, situation)
    if witness is None:
        assert extent.affected is None, "a solver and a diagram disagree"
        return None
    context = witness.context()
    said = {one: deciding(comparison, one, context) for one in SIDES}
    replayed = all(possible(comparison, one, context) for one in SIDES) and all(
        conflicting(comparison, one, context, said[one]) == (one == which) for one in SIDES
    )
    if not replayed:
        raise Undecided(sentence("the replay rejected a situation; this is a bug in sleec-verify"))
    return ConflictChange(
        way,
        tuple(sorted(clash.literals, key=str)),
        tuple(rule.label for rule in rules),
        tuple(origin.span for origin in clash.origins),
        witness,
        said["old"],
        said["new"],
        extent,
    )
