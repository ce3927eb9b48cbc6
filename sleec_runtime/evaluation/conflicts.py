"""Conflicts in one context, in which Definition 1 would entail everything.

A context conflicts if the literals that are due, the context and the constraints have no common model over the
obligations. The search backtracks over the few obligations that `NEVER` constraints mention. The verifier uses a solver
for the same question.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Union

from sleec_runtime.evaluation.due import due
from sleec_runtime.evaluation.formula_truth import Situation, truth, unreported
from sleec_runtime.model import Atom, Context, Exclusive, Never, Obligation, Ruleset, leaves

Forbidding = Union[Exclusive, Never]


@dataclass(frozen=True, slots=True)
class Conflict:
    """A minimal inconsistent set of due literals and constraints.

    Without constraints, a name and its negation are both due. Without literals, a `NEVER` forbids the situation itself.
    """

    literals: tuple[Obligation, ...]
    constraints: tuple[Forbidding, ...] = ()


def conflict(ruleset: Ruleset, context: Context) -> Conflict | None:
    """A conflict among what is due in `context`; None if there is none. O(size of the rules), plus the search."""
    literals = due(ruleset, context).literals
    return find_conflict(literals, forbidding(ruleset), Situation(context, ruleset.measures))


def forbidding(ruleset: Ruleset) -> tuple[Forbidding, ...]:
    """The constraints that can forbid obligations: all but `ASSUME`."""
    return tuple(c for c in ruleset.constraints if isinstance(c, (Exclusive, Never)))


def mentioned(constraint: Forbidding) -> frozenset[str]:
    """The obligations that a constraint mentions."""
    if isinstance(constraint, Exclusive):
        return frozenset(constraint.names)
    return frozenset(
        leaf.name for leaf in leaves(constraint.formula) if isinstance(leaf, Atom) and leaf.kind == "obligation"
    )


def find_conflict(
    literals: Sequence[Obligation], constraints: Sequence[Forbidding], situation: Situation
) -> Conflict | None:
    """A minimal conflict among due `literals` under `constraints`; None if there is none.

    O(literals + constraints) if all obligations that a `NEVER` mentions are fixed; exponential in the number of the
    others in the worst case. In the open world, a `NEVER` that unreported conditions may make true counts as broken.
    """
    opposed = _opposed(literals)
    if opposed is not None:
        return Conflict(tuple(other for other in literals if other.name == opposed))
    if not constraints or _possible(literals, constraints, situation):
        return None
    needed = list(constraints)
    for constraint in constraints:
        rest = [c for c in needed if c is not constraint]
        if not _possible(literals, rest, situation):
            needed = rest
    names = frozenset().union(*map(mentioned, needed))
    at_odds = [literal for literal in literals if literal.name in names]
    for literal in tuple(at_odds):
        fewer = [other for other in at_odds if other is not literal]
        if not _possible(fewer, needed, situation):
            at_odds = fewer
    return Conflict(tuple(at_odds), tuple(needed))


def has_conflict(literals: Sequence[Obligation], constraints: Sequence[Forbidding], situation: Situation) -> bool:
    """Whether there is a conflict. Much faster than to find a minimal one."""
    return _opposed(literals) is not None or not _possible(literals, constraints, situation)


def missing_for(constraints: Iterable[Forbidding], situation: Situation) -> tuple[str, ...]:
    """The unreported conditions that the `NEVER` constraints depend on."""
    formulas = (constraint.formula for constraint in constraints if isinstance(constraint, Never))
    return tuple(dict.fromkeys(name for formula in formulas for name in unreported(formula, situation)))


def _opposed(literals: Sequence[Obligation]) -> str | None:
    """The first name that is both due and forbidden."""
    forbidden = {literal.name for literal in literals if literal.negated}
    return next((one.name for one in literals if not one.negated and one.name in forbidden), None)


def _possible(literals: Iterable[Obligation], constraints: Sequence[Forbidding], situation: Situation) -> bool:
    """Whether some choice of the other obligations satisfies every constraint."""
    fixed = {literal.name: not literal.negated for literal in literals}
    by_never = {name for c in constraints if isinstance(c, Never) for name in mentioned(c)}
    for constraint in constraints:
        if isinstance(constraint, Exclusive):
            # An EXCLUSIVE never requires an obligation; a NEVER may.
            fixed.update((name, False) for name in constraint.names if name not in fixed and name not in by_never)
    return _satisfiable(constraints, fixed, situation)


def _satisfiable(constraints: Sequence[Forbidding], fixed: Mapping[str, bool], situation: Situation) -> bool:
    situation = replace(situation, obliged=fixed)
    open_ones = []
    for constraint in constraints:
        broken = _broken(constraint, situation)
        if broken:
            return False
        if broken is None:
            open_ones.append(constraint)
    if not open_ones:
        return True
    free = sorted(mentioned(open_ones[0]) - fixed.keys())
    if not free:
        return False
    return any(_satisfiable(open_ones, {**fixed, free[0]: value}, situation) for value in (False, True))


def _broken(constraint: Forbidding, situation: Situation) -> bool | None:
    if isinstance(constraint, Never):
        return truth(constraint.formula, situation)
    values = [situation.obliged.get(name) for name in dict.fromkeys(constraint.names)]
    if values.count(True) > 1:
        return True
    return False if values.count(True) + values.count(None) <= 1 else None
