"""Obligations on one side only, in situations that both sides allow and in which neither conflicts."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple, Union

from sleec_runtime.model import Formula, Not, Obligation, Truth
from sleec_verify.changes.compare.comparison import SIDES, Comparison, SideName, TriggerCone, none_of, other
from sleec_verify.changes.compare.replay import deciding, shows_change
from sleec_verify.changes.compare.result import Change, Extent, Undecidable
from sleec_verify.changes.compare.rule_alignment import RulePair
from sleec_verify.changes.compare.situation_count import (
    SituationCounter,
    all_of,
    conditions_of,
    names_of_formulas,
    unknown_extent,
)
from sleec_verify.changes.compare.timing_order import incomparability
from sleec_verify.changes.diagram.decision_diagram import FALSE, TooLarge
from sleec_verify.encoding.solver import Undecided
from sleec_verify.query.witness import smallest_situation
from sleec_verify.results.finding import Witness
from sleec_verify.wording.phrases import quoted
from sleec_verify.wording.sentence import sentence


class _Candidate(NamedTuple):
    """A literal that a rule obliges on one side, with the situations in which the other side does not oblige it."""

    which: SideName
    literal: Obligation
    region: Formula


class _Group(NamedTuple):
    """Literals that change in the same situations."""

    members: list[_Candidate]
    situation: Formula
    extent: Extent


Found = Union[Change, Undecidable]


def changes(comparison: Comparison, in_conflicts: bool = False) -> Iterator[Found]:
    """For each rule that differs between the sides, its changes; also in situations in which a side conflicts, if
    `in_conflicts`.

    Complete: if a literal is due on one side only, some clause of this side obliges it there, and its rule differs.
    Exact: each change has a replayed situation.
    """
    for pair, places in comparison.changed:
        label = next(rule.label for rule in (pair.new, pair.old) if rule is not None)
        try:
            yield from _of_pair(comparison, pair, places, in_conflicts)
        except Undecided as error:
            yield Undecidable(label, error.message)


def _of_pair(
    comparison: Comparison, pair: RulePair, places: dict[SideName, int], in_conflicts: bool
) -> Iterator[Found]:
    rules = [rule for rule in pair if rule is not None]
    triggers = {rule.trigger for rule in rules}
    cone = comparison.cone(triggers)
    rows = cone.rows
    found: list[_Candidate] = []
    for which, row in places.items():
        for literal in comparison.literals(row, which):
            open_question = _incomparable(comparison, rows, which, literal)
            if open_question is not None:
                yield Undecidable(comparison.label(row, which), open_question)
                continue
            elsewhere = comparison.due(rows, other(which), literal)
            mine = comparison.obliges(row, which, literal.__eq__)
            found.append(
                _Candidate(which, literal, all_of([mine, Not(elsewhere)]) if elsewhere != Truth(False) else mine)
            )
    if not found:
        return
    conflicts = [] if in_conflicts else [comparison.conflict(rows, which) for which in SIDES]
    try:
        groups = _grouped(comparison, pair, found, conflicts, triggers, cone)
    except TooLarge as error:
        why = str(error)
        peace = none_of(conflicts)
        groups = [_Group([one], all_of([one.region, *peace]), unknown_extent(triggers, why)) for one in found]
    for group in groups:
        witness = smallest_situation(cone.assumed, group.situation)
        if witness is None:
            # Only without a diagram, which finds unsatisfiable formulas itself.
            assert group.extent.affected is None, "a solver and a diagram disagree"
            continue
        yield _change(comparison, pair, group, witness, in_conflicts)


def _grouped(
    comparison: Comparison,
    pair: RulePair,
    found: list[_Candidate],
    conflicts: list[Formula],
    triggers: set[str],
    cone: TriggerCone,
) -> list[_Group]:
    """The candidates that some situation shows, grouped by equal situations."""
    both = zip(SIDES, (pair.old, pair.new))
    own = conditions_of(comparison.sides[which].plain(rule) for which, rule in both if rule is not None)
    regions = [one.region for one in found]
    everything = [*own, *regions, *conflicts]
    counting = SituationCounter(everything, cone.in_force(all_of(everything)), triggers, comparison.measures)
    by_node: dict[int, list[_Candidate]] = {}
    for one in found:
        node = counting.where(one.region, conflicts)
        if node != FALSE:
            by_node.setdefault(node, []).append(one)
    groups = []
    for node, members in by_node.items():
        free = counting.where(members[0].region)
        met = [formula for formula in conflicts if counting.meets(free, formula)]
        situation = all_of([members[0].region, *none_of(met)])
        groups.append(_Group(members, situation, counting.extent(node, names_of_formulas(own))))
    return groups


def _change(comparison: Comparison, pair: RulePair, group: _Group, witness: Witness, in_conflicts: bool) -> Change:
    added = tuple(one.literal for one in group.members if one.which == "new")
    removed = tuple(one.literal for one in group.members if one.which == "old")
    context = witness.context()
    said = {which: deciding(comparison, which, context) for which in SIDES}
    if not shows_change(comparison, context, said, added, removed, in_conflicts):
        raise Undecided(sentence("the replay rejected a situation; this is a bug in sleec-verify"))
    labels = [None if rule is None else rule.label for rule in pair]
    return Change(labels[0], labels[1], added, removed, witness, said["old"], said["new"], group.extent)


def _incomparable(comparison: Comparison, rows: list[int], which: SideName, literal: Obligation) -> str | None:
    """Why the other side's literals cannot be compared with it, if they cannot."""
    if literal.timing is None and not comparison.sides[other(which)].stated.is_timed:
        return None
    against = [o for row in rows for o in comparison.literals(row, other(which))]
    if literal in against:
        return None
    for one in against:
        if one.negated == literal.negated and comparison.implied_where(one, literal) is None:
            return sentence(
                "the windows of {event} cannot be compared: {why}",
                event=quoted(literal.name),
                why=incomparability(one, literal),
            )
    return None
