"""Minimization: a smaller set of situations than that of a greedy search, by a question with one copy for each
situation."""

from __future__ import annotations

from collections.abc import Sequence

from sleec_verify.conformance.cases.allowed_situations import AllowedSituations, Goal
from sleec_verify.encoding.solver import MiniSat

_MOST_COPIES = 12
_MOST_CLAUSES = 100_000
_BUDGET = 20_000
"""The number of conflicts after which the set stays as it is: small, and not proved to be smallest."""


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
    """A lower bound: a rule has one active clause at a time, so it needs one situation for each of its clauses."""
    wanted = {goal.literal for goal in goals}
    rules = range(len(world.index.rules))
    return max((len(wanted.intersection(world.guards(rule))) for rule in rules), default=0)


def _in(world: AllowedSituations, goals: Sequence[Goal], copies: int) -> list[list[Goal]] | None:
    """The goals in this number of sets, or None if there are none or the search is too large."""
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
