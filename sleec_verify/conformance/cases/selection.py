"""Selection of a small set of situations that reaches every reachable goal."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from random import Random

from sleec_runtime.model import Context, Ruleset
from sleec_verify.conformance.cases.allowed_situations import AllowedSituations, Goal
from sleec_verify.conformance.cases.case import Case
from sleec_verify.conformance.cases.goals import goals
from sleec_verify.conformance.cases.minimisation import minimise
from sleec_verify.conformance.oracle import Oracle
from sleec_verify.query.ruleset_index import RulesetIndex

_SEVERAL_ORDERS = 150
"""With at most this number of goals, the search runs in several orders, and the best result counts."""


@dataclass(frozen=True)
class UnreachedGoal:
    """A goal that no situation of the set reaches, and why."""

    name: str
    why: str

    @property
    def is_unknown(self) -> bool:
        """Whether it is not decided if a situation reaches the goal."""
        return self.why.startswith("unknown")


@dataclass(frozen=True)
class Cases:
    """The situations, the number of goals that they reach, and the goals that cannot be reached."""

    cases: tuple[Case, ...]
    reached: int
    unreached: tuple[UnreachedGoal, ...]


@dataclass
class _Found:
    goals: list[Goal]
    context: Context


def choose_cases(ruleset: Ruleset, criterion: str, domain: str | None = None, single: bool = False) -> Cases:
    """A small set of situations for a criterion of `goals`, with what is due in each.

    Several triggers may occur in a situation if that helps, unless `single`. Rules of several domains are covered in
    each domain in turn, as far as still needed. No situation violates an assumption, or conflicts. O(goals²) questions
    in the worst case. Raises `Undecided`.
    """
    found: list[Case] = []
    missed: dict[str, UnreachedGoal] = {}
    done: set[str] = set()
    for where in (domain,) if domain is not None else ruleset.domains or (None,):
        part = ruleset if where is None else ruleset.in_domain(where)
        index = RulesetIndex(part)
        world = AllowedSituations(index, single)
        labels = frozenset(rule.label for rule in part.rules)
        wanted = [goal for goal in goals(world, criterion, labels) if goal.name not in done]
        chosen, unreached = _cover(world, wanted)
        oracle = Oracle(ruleset, where)
        for one in chosen:
            found.append(_case(oracle, one, len(found) + 1, done))
            done.update(goal.name for goal in one.goals)
        missed.update({u.name: u for u in _reasons(index, criterion, unreached, single)})
    return Cases(tuple(found), len(done), tuple(u for name, u in missed.items() if name not in done))


def _cover(world: AllowedSituations, wanted: Sequence[Goal]) -> tuple[list[_Found], list[Goal]]:
    orders = [list(wanted)]
    if len(wanted) <= _SEVERAL_ORDERS:
        orders += [list(wanted)[::-1], Random(0).sample(wanted, len(wanted))]
    tried = [_greedily(world, order) for order in orders]
    sets, unreached = min(tried, key=lambda one: len(one[0]))
    found = [_Found(goals, world.smallest([goal.literal for goal in goals])) for goals in minimise(world, sets)]
    return found, unreached


def _greedily(world: AllowedSituations, wanted: Iterable[Goal]) -> tuple[list[list[Goal]], list[Goal]]:
    """One set after the other, each with as many goals as one situation can reach together with its first goal."""
    left = {goal.name: goal for goal in wanted}
    found: list[list[Goal]] = []
    unreached: list[Goal] = []
    while left:
        together: list[Goal] = []
        literals: list[int] = []
        for goal in list(left.values()):
            if world.reaches(*literals, goal.literal):
                together.append(goal)
                literals.append(goal.literal)
            elif not together:
                unreached.append(left.pop(goal.name))
        if together:
            found.append(together)
            for goal in together:
                del left[goal.name]
    return found, unreached


def _case(oracle: Oracle, found: _Found, number: int, done: set[str]) -> Case:
    expected = oracle.expected(found.context)
    if expected.conflict or not expected.possible:
        raise AssertionError(f"chose the situation {found.context}, which is excluded; this is a bug in sleec-verify")
    names = tuple(goal.name for goal in found.goals if goal.name not in done)
    more = f" and {len(names) - 1} more" if len(names) > 1 else ""
    return Case(
        name=f"{number}: {names[0]}{more}",
        triggers=tuple(sorted(found.context.triggers)),
        conditions=found.context.conditions,
        obligations=tuple(dict.fromkeys(expected.due)),
        prohibitions=expected.prohibited,
        domain=oracle.domain,
        reaches=names,
    )


def _reasons(index: RulesetIndex, criterion: str, unreached: Sequence[Goal], single: bool) -> Iterable[UnreachedGoal]:
    """Why goals are not reached: asks again with fewer requirements, and the goal that is reachable then names the
    reason."""
    if not unreached:
        return
    names = {goal.name for goal in unreached}
    labels = frozenset(rule.label for rule in index.rules)

    def reachable(world: AllowedSituations) -> set[str]:
        return {g.name for g in goals(world, criterion, labels) if g.name in names and world.reaches(g.literal)}

    together = reachable(AllowedSituations(index)) if single else set()
    at_all = reachable(AllowedSituations(index, peaceful=False))
    for goal in unreached:
        if goal.name in together:
            yield UnreachedGoal(goal.name, "only if other triggers also occur")
        elif goal.name in at_all:
            yield UnreachedGoal(goal.name, "only if the rules contradict each other")
        else:
            yield UnreachedGoal(goal.name, "in no situation")
