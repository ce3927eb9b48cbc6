"""A smaller set of situations than a greedy search finds: the question in as many copies as there may be situations."""

from __future__ import annotations

from collections.abc import Sequence

from sleec_verify.conformance.cases.allowed_situations import AllowedSituations, Goal
from sleec_verify.encoding.solver import MiniSat

_MOST_COPIES = 12
_MOST_CLAUSES = 100_000
_BUDGET = 20_000
"""Conflicts, after which the set stays as it is: near-smallest, and not proved to be smallest."""


def minimise(world: AllowedSituations, sets: list[list[Goal]]) -> list[list[Goal]]:
    """The goals of `sets` in fewer sets, each of which one situation reaches; as few as can be where that is decided
    within the budget."""
    goals = [goal for together in sets for goal in together]
    while len(sets) > _least(world, goals):
        smaller = _in(world, goals, len(sets) - 1)
        if smaller is None:
            break
        sets = smaller
    return sets


def _least(world: AllowedSituations, goals: Sequence[Goal]) -> int:
    """A rule has one active clause at a time, so that there are as many situations as it has clauses to reach."""
    wanted = {goal.literal for goal in goals}
    return max((len(wanted.intersection(guards)) for guards in world.guards), default=0)


def _in(world: AllowedSituations, goals: Sequence[Goal], copies: int) -> list[list[Goal]] | None:
    """The goals in that many sets, or None where there are no such sets or too much would have to be tried."""
    clauses, top = world.encoder.clauses, world.encoder.top
    if copies > _MOST_COPIES or copies * len(clauses) > _MOST_CLAUSES:
        return None
    with MiniSat(budget=_BUDGET) as solver:
        for copy in range(copies):
            solver.add([[_moved(literal, copy * top) for literal in clause] for clause in clauses])
        solver.add([[_moved(goal.literal, copy * top) for copy in range(copies)] for goal in goals])
        if not solver.solve():
            return None
        sets = [[g for g in goals if solver.holds(_moved(g.literal, copy * top))] for copy in range(copies)]
    left = {goal.name for goal in goals}
    shared = []
    for together in sets:
        # Whole-number measures may have no room for what a copy says of them, which the question itself tells.
        if not world.reaches(*(goal.literal for goal in together)):
            return None
        shared.append([goal for goal in together if goal.name in left])
        left -= {goal.name for goal in together}
    return [together for together in shared if together]


def _moved(literal: int, by: int) -> int:
    return literal + by if literal > 0 else literal - by
