"""What rules oblige on one side and not on the other, in situations that both allow and in which neither conflicts."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple, Union

from sleec_runtime.model import Formula, Not, Obligation, Truth
from sleec_verify.changes.compare.comparison import SIDES, Cone, Which, World, not_both, other
from sleec_verify.changes.compare.replay import deciding, shows_change
from sleec_verify.changes.compare.result import Change, Extent, Undecidable
from sleec_verify.changes.compare.rule_alignment import Pair
from sleec_verify.changes.compare.situation_count import Counting, all_of, conditions_of, named_in, not_counted
from sleec_verify.changes.compare.timing_order import implies, why_not
from sleec_verify.changes.diagram.decision_diagram import FALSE, TooLarge
from sleec_verify.encoding.solver import Undecided
from sleec_verify.query.witness import smallest_situation
from sleec_verify.results.finding import Witness


class _Candidate(NamedTuple):
    """A literal that a rule obliges on one side, and where the other side does not call for it."""

    which: Which
    literal: Obligation
    region: Formula


class _Group(NamedTuple):
    """Literals that change in the same situations."""

    members: list[_Candidate]
    situation: Formula
    extent: Extent


Found = Union[Change, Undecidable]


def changes(world: World) -> Iterator[Found]:
    """For each rule that is not the same on both sides, the changes that it makes.

    Complete: where a situation has a literal due on one side only, some clause of this side obliges it there, whose
    rule is not the same on both sides. Exact: each change is shown by a situation, replayed.
    """
    for pair, places in world.changed:
        label = next(rule.label for rule in (pair.new, pair.old) if rule is not None)
        try:
            yield from _of_pair(world, pair, places)
        except Undecided as error:
            yield Undecidable(label, str(error))


def _of_pair(world: World, pair: Pair, places: dict[Which, int]) -> Iterator[Found]:
    rules = [rule for rule in pair if rule is not None]
    triggers = {rule.trigger for rule in rules}
    cone = world.cone(triggers)
    rows = cone.rows
    found: list[_Candidate] = []
    for which, row in places.items():
        for literal in world.literals(row, which):
            open_question = _incomparable(world, rows, which, literal)
            if open_question is not None:
                yield Undecidable(world.label(row, which), open_question)
                continue
            elsewhere = world.due(rows, other(which), literal)
            mine = world.obliges(row, which, literal.__eq__)
            found.append(
                _Candidate(which, literal, all_of([mine, Not(elsewhere)]) if elsewhere != Truth(False) else mine)
            )
    if not found:
        return
    conflicts = [world.conflict(rows, which) for which in SIDES]
    try:
        groups = _grouped(world, pair, found, conflicts, triggers, cone)
    except TooLarge as error:
        why = str(error)
        peace = not_both(conflicts)
        groups = [_Group([one], all_of([one.region, *peace]), not_counted(triggers, why)) for one in found]
    for group in groups:
        witness = smallest_situation(cone.assumed, group.situation)
        if witness is None:
            # Only without a diagram: it has no node for what no situation makes true.
            assert group.extent.affected is None, "a solver and a diagram disagree"
            continue
        yield _change(world, pair, group, witness)


def _grouped(
    world: World, pair: Pair, found: list[_Candidate], conflicts: list[Formula], triggers: set[str], cone: Cone
) -> list[_Group]:
    """The candidates that some situation shows, together where the same situations do."""
    both = zip(SIDES, (pair.old, pair.new))
    own = conditions_of(world.sides[which].plain(rule) for which, rule in both if rule is not None)
    regions = [one.region for one in found]
    everything = [*own, *regions, *conflicts]
    counting = Counting(everything, cone.in_force(all_of(everything)), triggers, world.measures)
    by_node: dict[int, list[_Candidate]] = {}
    for one in found:
        node = counting.where(one.region, conflicts)
        if node != FALSE:
            by_node.setdefault(node, []).append(one)
    groups = []
    for node, members in by_node.items():
        free = counting.where(members[0].region)
        met = [formula for formula in conflicts if counting.meets(free, formula)]
        situation = all_of([members[0].region, *not_both(met)])
        groups.append(_Group(members, situation, counting.extent(node, named_in(own))))
    return groups


def _change(world: World, pair: Pair, group: _Group, witness: Witness) -> Change:
    added = tuple(one.literal for one in group.members if one.which == "new")
    removed = tuple(one.literal for one in group.members if one.which == "old")
    context = witness.context()
    said = {which: deciding(world, which, context) for which in SIDES}
    if not shows_change(world, context, said, added, removed):
        raise Undecided("a situation did not replay, which is a bug in sleec-verify")
    labels = [None if rule is None else rule.label for rule in pair]
    return Change(labels[0], labels[1], added, removed, witness, said["old"], said["new"], group.extent)


def _incomparable(world: World, rows: list[int], which: Which, literal: Obligation) -> str | None:
    """Why the other side's literals cannot be compared with it, if that is so."""
    if literal.timing is None and not world.sides[other(which)].stated.is_timed:
        return None
    against = [o for row in rows for o in world.literals(row, other(which))]
    if literal in against:
        return None
    for one in against:
        if one.negated == literal.negated and implies(one, literal, world.untimed) is None:
            return f"what {literal.name} calls for cannot be compared by its form: {why_not(one, literal)}"
    return None
