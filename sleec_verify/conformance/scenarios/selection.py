"""Selection of a small set of scenarios that reaches every reachable goal."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from random import Random

from sleec_runtime.model import Ruleset
from sleec_verify.conformance.cases.selection import UnreachedGoal
from sleec_verify.conformance.scenarios.construction import scenario_of
from sleec_verify.conformance.scenarios.goals import TraceGoal, trace_goals
from sleec_verify.conformance.scenarios.lawful_traces import LawfulTraces
from sleec_verify.conformance.scenarios.scenario import Scenario
from sleec_verify.encoding.solver import Undecided
from sleec_verify.query.ruleset_index import RulesetIndex

_SEVERAL_ORDERS = 150
"""With at most this number of goals, the search runs in several orders, and the best result counts."""

_UNCONFIRMED = "unknown: the trace that was found breaks a rule or relation"


@dataclass(frozen=True)
class Scenarios:
    """The scenarios, the number of goals that they reach, and the goals that are not reached."""

    scenarios: tuple[Scenario, ...]
    reached: int
    unreached: tuple[UnreachedGoal, ...]


@dataclass
class _Set:
    """Goals that one trace reaches together, the literals that imply them, and the responses that they are about."""

    world: LawfulTraces
    goals: list[TraceGoal] = field(default_factory=list)
    literals: list[int] = field(default_factory=list)
    responses: set[str] = field(default_factory=set)

    def add(self, goal: TraceGoal) -> bool:
        """Add a goal if one trace reaches it, too. Raises `Undecided`."""
        if goal.response in self.responses:
            return False
        literals = [*self.literals, *goal.situation(self.world)]
        if not self.world.reaches(literals):
            return False
        literals += goal.windows(self.world)
        if not self.world.reaches(literals):
            return False
        self.goals.append(goal)
        self.literals = literals
        if goal.response:
            self.responses.add(goal.response)
        return True


def choose_scenarios(ruleset: Ruleset, criterion: str, domain: str | None = None, single: bool = False) -> Scenarios:
    """A small set of scenarios for a criterion of situations and all windows, with what is due in each.

    Several inputs may occur at once if that helps, unless `single`. Rules of several domains are covered in each domain
    in turn, as far as still needed. In no scenario does the robot have to violate a rule or relation.
    """
    found: list[Scenario] = []
    missed: dict[str, UnreachedGoal] = {}
    done: set[str] = set()
    for where in (domain,) if domain is not None else ruleset.domains or (None,):
        search = _Search(RulesetIndex(ruleset if where is None else ruleset.in_domain(where)), criterion, single)
        sets, unreached = search.cover(done)
        for one in sets:
            names = tuple(goal.name for goal in one.goals)
            more = f" and {len(names) - 1} more" if len(names) > 1 else ""
            scenario = search.scenario(one, f"{len(found) + 1}: {names[0]}{more}")
            if scenario is None:
                unreached += [UnreachedGoal(name, _UNCONFIRMED) for name in names]
                continue
            found.append(replace(scenario, domain=where, reaches=names))
            done.update(names)
        missed.update({one.name: one for one in unreached})
    return Scenarios(tuple(found), len(done), tuple(one for name, one in missed.items() if name not in done))


_Cover = tuple[list[_Set], list[tuple[TraceGoal, "str | None"]]]
"""Sets of goals, and the goals that are not reached. Of those that are not decided, why."""


class _Search:
    """The search in one domain."""

    def __init__(self, index: RulesetIndex, criterion: str, single: bool) -> None:
        self._index = index
        self._single = single
        world = self._world(False)
        self._goals = trace_goals(world, criterion)
        self._unbounded = world.unbounded

    def _world(self, startable: bool) -> LawfulTraces:
        return LawfulTraces(self._index, self._single, startable)

    def cover(self, done: Collection[str]) -> tuple[list[_Set], list[UnreachedGoal]]:
        """Sets of goals that are not `done` yet, and the goals that cannot be reached."""
        wanted = [goal for goal in self._goals if goal.name not in done]
        sets, rest = self._smallest_cover([goal for goal in wanted if goal.is_startable], startable=True)
        # What a runtime that starts obligations at once can execute only in part, in scenarios of its own.
        names = {goal.name for goal, _ in rest}
        waiting = [goal for goal in wanted if not goal.is_startable or goal.name in names]
        more, unreached = self._smallest_cover(waiting, startable=False)
        found = [UnreachedGoal(goal.name, why or self._reason(goal)) for goal, why in unreached]
        found += [UnreachedGoal(f"{label}: windows", f"unknown: {why}") for label, why in self._unbounded.items()]
        return [*sets, *more], found

    def _smallest_cover(self, wanted: Sequence[TraceGoal], startable: bool) -> _Cover:
        """The best result of several orders, if there are not too many goals."""
        sets, unreached = self._greedily(wanted, startable)
        names = {goal.name for goal, _ in unreached}
        reachable = [goal for goal in wanted if goal.name not in names]
        if len(reachable) <= _SEVERAL_ORDERS:
            for order in (reachable[::-1], Random(0).sample(reachable, len(reachable))):
                sets = min(sets, self._greedily(order, startable)[0], key=len)
        return sets, unreached

    def _greedily(self, wanted: Iterable[TraceGoal], startable: bool) -> _Cover:
        """One set after the other, each with as many goals as one trace can reach together with its first goal."""
        left = {goal.name: goal for goal in wanted}
        sets: list[_Set] = []
        unreached: list[tuple[TraceGoal, str | None]] = []
        while left:
            one = _Set(self._world(startable))
            for goal in list(left.values()):
                try:
                    if one.add(goal):
                        del left[goal.name]
                    elif not one.goals:
                        unreached.append((goal, None))
                        del left[goal.name]
                except Undecided as error:
                    if one.goals:
                        # The trace is as large as it can get.
                        break
                    unreached.append((goal, f"unknown: {error.message}"))
                    del left[goal.name]
                    one = _Set(self._world(startable))
            if one.goals:
                sets.append(one)
        return sets, unreached

    def _reason(self, goal: TraceGoal) -> str:
        """Why no trace reaches a goal: asks again with fewer requirements."""
        if self._unbounded:
            return f"unknown: {' and '.join(dict.fromkeys(self._unbounded.values()))}"
        try:
            if self._single and _Set(LawfulTraces(self._index)).add(goal):
                return "only if other events also occur"
            if _Set(LawfulTraces(self._index, lawful=False)).add(goal):
                return "only if a rule is violated"
        except Undecided as error:
            return f"unknown: {error.message}"
        return "in no trace"

    def scenario(self, one: _Set, name: str) -> Scenario | None:
        """A scenario that reaches the goals of a set. As far as these leave it open, windows are met at once."""
        literals = one.literals
        with suppress(Undecided):
            literals = one.world.prompt(literals)
        return scenario_of(one.world.traces, name, one.world.smallest(literals))
