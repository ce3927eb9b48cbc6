"""What a NEVER or EXCLUSIVE of one side excludes, and the other side allows.

A constraint excludes some choices of obligations in some situations. It is weaker on the other side where a choice
breaks it and none of the constraints of the other side. The existential quantifier over the obligations is expanded
(Shannon expansion).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import combinations
from typing import Union

from sleec_runtime.model import And, Atom, Exclusive, Formula, Never, Not, Or, Truth
from sleec_verify.changes.compare.comparison import SIDES, Comparison, SideName, other
from sleec_verify.changes.compare.replay import excluded_on_one_side
from sleec_verify.changes.compare.result import ConstraintChange, Undecidable, Way
from sleec_verify.changes.compare.situation_count import SituationCounter, names_of_formulas, unknown_extent
from sleec_verify.changes.diagram.decision_diagram import FALSE, TooLarge
from sleec_verify.encoding.equation import conjunction, disjunction
from sleec_verify.encoding.solver import Undecided
from sleec_verify.query.names import obligations_in
from sleec_verify.query.witness import smallest_situation
from sleec_verify.wording.sentence import sentence

MOST_NAMES = 8
"""The obligations of connected constraints whose choices are expanded, at most."""


def constraint_changes(comparison: Comparison) -> Iterator[Union[ConstraintChange, Undecidable]]:
    """For each constraint of one side that the other side lacks, the situations in which the other side allows what it
    excludes. A constraint that follows from those of the other side is left out. O(2^`MOST_NAMES`) formulas."""
    for way, which in (("removed", SIDES[0]), ("added", SIDES[1])):
        theirs = comparison.sides[other(which)].constraints
        for constraint in comparison.sides[which].constraints:
            if constraint not in theirs:
                try:
                    found = _change(comparison, "added" if way == "added" else "removed", which, constraint)
                except Undecided as error:
                    yield Undecidable(sentence("the constraints"), error.message)
                else:
                    yield from () if found is None else (found,)


def _change(
    comparison: Comparison, way: Way, which: SideName, constraint: Exclusive | Never
) -> ConstraintChange | None:
    against = comparison.constraints_about(other(which), obligations_in(constraint))
    names = list(dict.fromkeys(name for one in (constraint, *against) for name in obligations_in(one)))
    if len(names) > MOST_NAMES:
        why = sentence("its constraints name more than {number} obligations", number=MOST_NAMES)
        return ConstraintChange(way, constraint, unknown_extent((), why))
    allowed = conjunction([_broken(constraint), *(Not(_broken(one)) for one in against)])
    region = _some_choice(allowed, names)
    index = comparison.index
    witness = None if region == Truth(False) else smallest_situation(index, region)
    if witness is None:
        return None
    if not excluded_on_one_side(comparison, which, constraint, names, witness.context()):
        raise Undecided(sentence("the replay rejected a situation; this is a bug in sleec-verify"))
    assumed = [one.formula for one in index.assumptions_about(names_of_formulas([region]))]
    try:
        counting = SituationCounter([region], assumed, (), comparison.measures)
        node = counting.where(region)
        assert node != FALSE, "a solver and a diagram disagree"
        return ConstraintChange(way, constraint, counting.extent(node, names_of_formulas([region])))
    except TooLarge as error:
        return ConstraintChange(way, constraint, unknown_extent((), str(error)))


def _broken(constraint: Exclusive | Never) -> Formula:
    """What the constraint excludes."""
    if isinstance(constraint, Never):
        return constraint.formula
    return disjunction(
        [And((Atom("obligation", one), Atom("obligation", two))) for one, two in combinations(constraint.names, 2)]
    )


def _some_choice(formula: Formula, names: Sequence[str]) -> Formula:
    """The situations in which some choice of these obligations makes the formula true."""
    for name in names:
        parts = [_simplified(formula, name, value) for value in (False, True)]
        formula = _any(list(dict.fromkeys(part for part in parts if part != Truth(False))))
    return formula


def _any(parts: list[Formula]) -> Formula:
    return Truth(True) if Truth(True) in parts else disjunction(parts)


def _simplified(formula: Formula, name: str, value: bool) -> Formula:
    """The formula with this value of an obligation."""
    if isinstance(formula, Atom):
        return Truth(value) if formula.kind == "obligation" and formula.name == name else formula
    if isinstance(formula, Not):
        operand = _simplified(formula.operand, name, value)
        return Truth(not operand.value) if isinstance(operand, Truth) else replace(formula, operand=operand)
    if not isinstance(formula, (And, Or)):
        return formula
    neutral = Truth(isinstance(formula, And))
    operands = [_simplified(operand, name, value) for operand in formula.operands]
    if Truth(not neutral.value) in operands:
        return Truth(not neutral.value)
    operands = [operand for operand in operands if operand != neutral]
    return conjunction(operands) if isinstance(formula, And) else disjunction(operands)
