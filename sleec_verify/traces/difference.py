"""Difference logic: literals "the time of b minus the time of a is at most c seconds".

The solver orders the literals of one pair of nodes by clauses. Consequences of several pairs are checked in a model: a
negative cycle of differences becomes a clause (lazy SMT; S. Cotton and O. Maler, "Fast and flexible difference
constraint propagation for DPLL(T)", SAT 2006).
"""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import NamedTuple

from sleec_verify.encoding.budget import spend

PER_EDGE = 4
"""Budget steps for each difference that is compared with the others."""


class _Edge(NamedTuple):
    """``time[target] - time[source] <= length``, because `literal` is true."""

    source: int
    target: int
    length: int
    literal: int


class _Pair(NamedTuple):
    """The literals "time[b] - time[a] is at most this", sorted by their lengths."""

    lengths: list[int]
    literals: list[int]


class Differences:
    """Time nodes, numbered from 0, and the literals about their differences."""

    def __init__(self, fresh: Callable[[], int], add: Callable[[list[int]], None], true: int) -> None:
        self._fresh = fresh
        self._add = add
        self._true = true
        self._pairs: dict[tuple[int, int], _Pair] = {}

    @property
    def pairs(self) -> int:
        """The number of pairs of nodes that some literal compares."""
        return len(self._pairs)

    def at_most(self, a: int, b: int, length: int) -> int:
        """The literal ``time[b] - time[a] <= length``."""
        if a == b:
            return self._true if length >= 0 else -self._true
        if a > b:
            return -self.at_most(b, a, -length - 1)
        lengths, literals = self._pairs.setdefault((a, b), _Pair([], []))
        place = bisect_left(lengths, length)
        if place < len(lengths) and lengths[place] == length:
            return literals[place]
        literal = self._fresh()
        if place > 0:
            self._add([-literals[place - 1], literal])
        if place < len(lengths):
            self._add([-literal, literals[place]])
        lengths.insert(place, length)
        literals.insert(place, literal)
        return literal

    def before(self, a: int, b: int) -> int:
        """The literal ``time[a] < time[b]``."""
        return -self.at_most(a, b, 0)

    def within(self, a: int, b: int, start: int | None, end: int | None) -> list[int]:
        """Literals that together say ``start <= time[b] - time[a] <= end``. None means unbounded."""
        found = [] if end is None else [self.at_most(a, b, end)]
        return found if start is None else [*found, -self.at_most(a, b, start - 1)]

    def _edges(self, holds: Callable[[int], bool], used: Sequence[int]) -> Iterator[_Edge]:
        """The tightest bound of a model for each pair. The literals of a pair are monotone in every model."""
        there = set(used)
        for (a, b), (lengths, literals) in self._pairs.items():
            if a in there and b in there:
                first = bisect_left(literals, True, key=holds)
                if first < len(lengths):
                    yield _Edge(a, b, lengths[first], literals[first])
                if first > 0:
                    yield _Edge(b, a, -lengths[first - 1] - 1, -literals[first - 1])

    def _weakened(self, cycle: Sequence[_Edge]) -> list[int]:
        """The literals of a negative cycle, weakened while the cycle stays negative, so that the clause excludes
        more models."""
        spare = -1 - sum(edge.length for edge in cycle)
        found = []
        for source, target, length, literal in cycle:
            if literal > 0:
                lengths, literals = self._pairs[source, target]
                weaker = bisect_right(lengths, length + spare) - 1
                spare -= lengths[weaker] - length
                found.append(literals[weaker])
            else:
                lengths, literals = self._pairs[target, source]
                weaker = bisect_left(lengths, -length - 1 - spare)
                spare -= -lengths[weaker] - 1 - length
                found.append(-literals[weaker])
        return found

    def refused(self, holds: Callable[[int], bool], used: Sequence[int]) -> list[list[int]]:
        """Valid clauses that a model violates; none if the nodes `used` can have times. O(n³) for n nodes."""
        tightest: dict[int, dict[int, _Edge]] = {node: {} for node in used}
        for edge in self._edges(holds, used):
            tightest[edge.source][edge.target] = edge
        spend(PER_EDGE * sum(map(len, tightest.values())))
        # Most contradictions have three nodes. Returning all of these at once saves models.
        cycles = list(_triangles(tightest)) or _negative_cycle(tightest)
        return [[-literal for literal in self._weakened(cycle)] for cycle in cycles]

    def schedule(
        self, holds: Callable[[int], bool], used: Sequence[int], fixed: int | None = None
    ) -> tuple[dict[int, int], dict[int, tuple[int, int]]]:
        """The earliest times, from 0, that a model allows. For each node that cannot be earlier because of another
        one: ``(the other node, the seconds after it)``. With a node `fixed`, the latest times with that node at the
        same time; a node without a latest time is late. `refused` must accept the model."""
        times = dict.fromkeys(used, 0)
        waits: dict[int, tuple[int, int]] = {}
        edges = list(self._edges(holds, used))
        changed = True
        while changed:
            changed = False
            for edge in edges:
                if times[edge.target] - edge.length > times[edge.source]:
                    times[edge.source] = times[edge.target] - edge.length
                    waits[edge.source] = (edge.target, -edge.length)
                    changed = True
        if fixed is None:
            return times, waits
        now, waits = times[fixed], {}
        times = dict.fromkeys(used, 2 * max(times.values()) + 1)
        times[fixed] = now
        changed = True
        while changed:
            changed = False
            for edge in edges:
                if times[edge.source] + edge.length < times[edge.target]:
                    times[edge.target] = times[edge.source] + edge.length
                    waits[edge.target] = (edge.source, edge.length)
                    changed = True
        return times, waits


_Edges = Mapping[int, Mapping[int, _Edge]]
"""The tightest edge from a node to another one."""


def _triangles(edges: _Edges) -> Iterator[list[_Edge]]:
    """The negative cycles of two or three edges, each once."""
    for first, from_first in edges.items():
        for second, one in from_first.items():
            back = edges[second].get(first)
            if first < second and back is not None and one.length + back.length < 0:
                yield [one, back]
            for third, other in edges[second].items():
                # Each cycle begins at its least node.
                if first < second and first < third:
                    last = edges[third].get(first)
                    if last is not None and one.length + other.length + last.length < 0:
                        yield [one, other, last]


def _negative_cycle(edges: _Edges) -> list[list[_Edge]]:
    """A negative cycle, if there is one (Bellman and Ford)."""
    distance = dict.fromkeys(edges, 0)
    reached: dict[int, _Edge] = {}
    last = None
    for _ in edges:
        last = None
        for outgoing in edges.values():
            for edge in outgoing.values():
                if distance[edge.source] + edge.length < distance[edge.target]:
                    distance[edge.target] = distance[edge.source] + edge.length
                    reached[edge.target] = edge
                    last = edge.target
        if last is None:
            return []
    assert last is not None
    # After as many steps back as there are nodes, the node is on the cycle.
    for _ in edges:
        last = reached[last].source
    cycle, at = [], last
    while True:
        edge = reached[at]
        cycle.append(edge)
        at = edge.source
        if at == last:
            return [cycle]
