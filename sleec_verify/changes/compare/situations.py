"""Situations that only one side allows, because assumptions, relations or scales differ."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Union

from sleec_runtime.model import Not
from sleec_verify.changes.compare.comparison import Comparison, SideName, other
from sleec_verify.changes.compare.replay import possible, satisfies
from sleec_verify.changes.compare.result import SituationChange, Undecidable, Way
from sleec_verify.changes.compare.sides import Assumption
from sleec_verify.changes.compare.situation_count import SituationCounter, names_of_formulas, unknown_extent
from sleec_verify.changes.diagram.decision_diagram import FALSE, TooLarge
from sleec_verify.encoding.solver import Undecided
from sleec_verify.query.question import is_possible
from sleec_verify.query.witness import smallest_situation
from sleec_verify.wording.sentence import sentence


def situation_changes(comparison: Comparison) -> Iterator[Union[SituationChange, Undecidable]]:
    """For each assumption of one side that the other side lacks, the situations that only the other side allows, if
    any. Assumptions that follow from the other side's assumptions do not count."""
    for which in ("old", "new"):
        mine: SideName = "old" if which == "old" else "new"
        theirs = {given.formula for given in comparison.sides[other(mine)].given}
        way: Way = "added" if mine == "old" else "removed"
        for given in comparison.sides[mine].given:
            if given.formula not in theirs:
                try:
                    found = _allowed(comparison, other(mine), given, way)
                except Undecided as error:
                    yield Undecidable(given.words, error.message)
                else:
                    yield from () if found is None else (found,)
    yield from _fractions(comparison)


def _allowed(comparison: Comparison, by: SideName, given: Assumption, way: Way) -> SituationChange | None:
    """The situations that `by` allows and that violate `given`."""
    broken = Not(given.formula)
    index = comparison.situations_about(by, broken)
    witness = smallest_situation(index, broken)
    if witness is None or not is_possible(comparison.situations_of(by)):
        return None
    context = witness.context()
    if not possible(comparison, by, context) or satisfies(comparison, other(by), given, context):
        raise Undecided(sentence("the replay rejected a situation; this is a bug in sleec-verify"))
    named = names_of_formulas([given.formula])
    assumed = [assumption.formula for assumption in index.assumptions_about(named)]
    try:
        counting = SituationCounter([broken], assumed, (), comparison.measures)
        node = counting.where(broken)
        assert node != FALSE, "a solver and a diagram disagree"
        extent = counting.extent(node, named)
    except TooLarge as error:
        extent = unknown_extent((), str(error))
    return SituationChange(way, given.words, witness, extent)


def _fractions(comparison: Comparison) -> Iterator[SituationChange]:
    """Numbers that are whole on one side only. The DSL has only whole numbers, so this is a note between the
    languages."""
    if comparison.sides["old"].stated.syntax != comparison.sides["new"].stated.syntax:
        return
    for name in comparison.vocabulary.whole:
        old = comparison.sides["old"].stated.measures[name].kind
        way: Way = "added" if old == "integer" else "removed"
        yield SituationChange(way, f"`{name}` is a whole number", None, None)
