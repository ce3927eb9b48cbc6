"""Differences of times of instants, as literals: "the time of b minus that of a is at most c seconds".

The order of such literals for one pair is a clause each; what several pairs have to do with each other is checked
against a model (`refused`), and a contradiction becomes a clause: the cycle of differences that adds up to less than
nothing.
"""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import NamedTuple


class _Edge(NamedTuple):
    """``time[target] - time[source] <= length``, because `literal` is true."""

    source: int
    target: int
    length: int
    literal: int


class _Pair(NamedTuple):
    """The literals "the time of the one minus that of the other is at most this", in the order of their lengths."""

    lengths: list[int]
    literals: list[int]


_ZERO = -1
"""The node whose time is 0, which stands for all whose times are known."""


class Times:
    """The times of instants that are numbered from 0. `known` are those that are given."""

    def __init__(
        self,
        fresh: Callable[[], int],
        add: Callable[[list[int]], None],
        true: int,
        known: Mapping[int, int] | None = None,
    ) -> None:
        self._fresh = fresh
        self._add = add
        self._true = true
        self._known = dict(known or {})
        self._fixed: dict[int, tuple[int, int]] = {}
        self._pairs: dict[tuple[int, int], _Pair] = {}
        self._asked_of: dict[int, int] = {}

    def fix(self, number: int, after: int, wait: int) -> bool:
        """Let an instant that nothing is said of yet be so many seconds after another one, if the time of that is
        known; False if there is an instant at this time already."""
        if after in self._known:
            time = self._known[after] + wait
            if time in self._known.values():
                return False
            self._known[number] = time
            self._fixed[number] = (after, wait)
        return True

    @property
    def pairs(self) -> int:
        """How many pairs of instants there are that any literal is about."""
        return len(self._pairs)

    def at_most(self, a: int, b: int, length: int) -> int:
        """The literal "the time of `b` minus that of `a` is at most `length`"."""
        asked_of = a if a in self._known else b
        if a in self._known:
            length += self._known[a]
            a = _ZERO
        if b in self._known:
            length -= self._known[b]
            b = _ZERO
        if a == b:
            return self._true if length >= 0 else -self._true
        if a > b:
            return -self._literal(b, a, -length - 1, asked_of)
        return self._literal(a, b, length, asked_of)

    def _literal(self, a: int, b: int, length: int, asked_of: int) -> int:
        lengths, literals = self._pairs.setdefault((a, b), _Pair([], []))
        place = bisect_left(lengths, length)
        if place < len(lengths) and lengths[place] == length:
            return literals[place]
        literal = self._fresh()
        self._asked_of[literal] = asked_of
        if place > 0:
            self._add([-literals[place - 1], literal])
        if place < len(lengths):
            self._add([-literal, literals[place]])
        lengths.insert(place, length)
        literals.insert(place, literal)
        return literal

    def before(self, a: int, b: int) -> int:
        """The literal "`a` is before `b`"."""
        return -self.at_most(a, b, 0)

    def bounds(self, a: int, b: int, start: int | None, end: int | None) -> list[int]:
        """Literals that say together that `b` is from `start` to `end` seconds after `a`, both included."""
        found = [] if end is None else [self.at_most(a, b, end)]
        return found if start is None else [*found, -self.at_most(a, b, start - 1)]

    def _edges(self, holds: Callable[[int], bool], used: Sequence[int]) -> Iterator[_Edge]:
        """What a model says of each pair, at its tightest: the model keeps the order of the literals of one pair."""
        there = {_ZERO, *used}
        for (a, b), (lengths, literals) in self._pairs.items():
            if a in there and b in there:
                first = bisect_left(literals, True, key=holds)
                if first < len(lengths):
                    yield _Edge(a, b, lengths[first], literals[first])
                if first > 0:
                    yield _Edge(b, a, -lengths[first - 1] - 1, -literals[first - 1])

    def _weakened(self, cycle: Sequence[_Edge]) -> list[int]:
        """The literals of a cycle that adds up to less than nothing, or of others that follow from them and do so as
        well: the less is said of each pair, the more models are refused with it."""
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
        """Clauses that a model breaks and that hold of all times; none if the model leaves times for `used`.

        Nearly all contradictions are between three instants: all of these are told at once, so that few models are
        asked for. O(n³) for n instants.
        """
        tightest: dict[int, dict[int, _Edge]] = {node: {} for node in (_ZERO, *used)}
        for edge in self._edges(holds, used):
            tightest[edge.source][edge.target] = edge
        cycles = list(_triangles(tightest)) or _negative_cycle(tightest)
        return [[-literal for literal in self._weakened(cycle)] for cycle in cycles]

    def schedule(
        self, holds: Callable[[int], bool], used: Sequence[int]
    ) -> tuple[dict[int, int], dict[int, tuple[int, int]]]:
        """The earliest times that a model allows, from 0, and for each instant that has to wait for another one,
        ``(the other, how many seconds)``. The model is one that `refused` accepts. Of several other ones of known times
        that it may be due to, it is the one that was asked about first."""
        earliest = {node: self._known.get(node, 0) for node in (_ZERO, *used)}
        waits = dict(self._fixed)
        edges = [edge for edge in self._edges(holds, used) if edge.source != _ZERO]
        changed = True
        while changed:
            changed = False
            for edge in edges:
                # time[source] >= time[target] - length
                if earliest[edge.target] - edge.length > earliest[edge.source]:
                    earliest[edge.source] = earliest[edge.target] - edge.length
                    if edge.target == _ZERO:
                        known = self._asked_of[abs(edge.literal)]
                        waits[edge.source] = (known, -edge.length - self._known[known])
                    else:
                        waits[edge.source] = (edge.target, -edge.length)
                    changed = True
        return earliest, waits


_Edges = Mapping[int, Mapping[int, _Edge]]
"""The tightest edge from a node to another one."""


def _triangles(edges: _Edges) -> Iterator[list[_Edge]]:
    """The cycles of two or three edges that add up to less than nothing, each once."""
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
    """A cycle that adds up to less than nothing, if there is one (Bellman and Ford)."""
    distance = dict.fromkeys(edges, 0)
    reached: dict[int, _Edge] = {}
    last = None
    for _ in edges:
        last = None
        for ways in edges.values():
            for edge in ways.values():
                if distance[edge.source] + edge.length < distance[edge.target]:
                    distance[edge.target] = distance[edge.source] + edge.length
                    reached[edge.target] = edge
                    last = edge.target
        if last is None:
            return []
    assert last is not None
    # So many steps back end inside the cycle.
    for _ in edges:
        last = reached[last].source
    cycle, at = [], last
    while True:
        edge = reached[at]
        cycle.append(edge)
        at = edge.source
        if at == last:
            return [cycle]
