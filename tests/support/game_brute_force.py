"""Who wins the game about a small ruleset, by trying everything: each act of the environment, each reply of the robot.

It shares with the product the parser, the evaluator of traces and the definition of the game (docs/times.md), no more.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import chain, combinations, product

from sleec_runtime.evaluation.trace import Instant, Trace
from sleec_runtime.evaluation.trace_violations import violations
from sleec_runtime.model import RELATIONS, Assume, Exclusive, Never, Rule, Ruleset, Value


class Game:
    """`environments` and `robots` are events, `laws` the texts of the relations that the environment keeps. Times are
    whole seconds; nothing in the rules may reach further than `reach` of them. The measure `w` is 1 or 2, the others
    are true or false."""

    def __init__(
        self,
        ruleset: Ruleset,
        environments: list[str],
        robots: list[str],
        laws: set[str],
        measures: list[str],
        reach: int,
    ) -> None:
        self.environments, self.robots, self.measures, self.reach = environments, robots, measures, reach
        kept = [s for s in ruleset.statements if isinstance(s, (Rule, *RELATIONS, Exclusive, Never, Assume))]
        text = ruleset.source.text
        own = [s for s in kept if text[s.span.start : s.span.end].strip() in laws]
        given = tuple(ruleset.measures.values())
        self.all = replace(ruleset, statements=tuple(kept), inferred=given)
        self.lawful = replace(ruleset, statements=tuple(own), inferred=given)

    def environment_wins(self, steps: int) -> bool:
        return any(self._beaten((), act, steps) for act in self._acts(0))

    def _beaten(self, before: tuple[Instant, ...], act: Instant, left: int) -> bool:
        """Whether the environment wins with an act, with so many acts left, this one included."""
        if violations(self.lawful, Trace((*before, act))):
            return False
        for now, plan in self._replies(act):
            if violations(self.all, Trace((*before, now, *plan))):
                continue
            if left == 1:
                return False
            further = range(act.time + 1, act.time + 2 * self.reach + 2)
            if not any(
                self._beaten((*before, now, *(p for p in plan if p.time < time)), again, left - 1)
                for time in further
                for again in self._acts(time)
            ):
                return False
        return True

    def _acts(self, time: int) -> Iterator[Instant]:
        for events in _subsets(self.environments):
            for values in self._values():
                yield Instant(time, events, values)

    def _values(self) -> Iterator[dict[str, Value]]:
        domains: list[tuple[Value, ...]] = [(1, 2) if name == "w" else (False, True) for name in self.measures]
        for values in product(*domains):
            yield dict(zip(self.measures, values))

    def _replies(self, act: Instant) -> Iterator[tuple[Instant, tuple[Instant, ...]]]:
        later: list[list[Instant | None]] = []
        for time in range(act.time + 1, act.time + self.reach + 1):
            done = [e for e in _subsets(self.robots) if e]
            later.append([None, *(Instant(time, e, v) for e in done for v in self._values())])
        for events in _subsets(self.robots):
            for plan in product(*later):
                yield replace(act, events=act.events | events), tuple(p for p in plan if p is not None)


def _subsets(names: list[str]) -> Iterator[frozenset[str]]:
    sizes = (combinations(names, size) for size in range(len(names) + 1))
    return map(frozenset, chain.from_iterable(sizes))
