"""Triangles of a chordal completion, which are sufficient for transitivity (R. Bryant and M. Velev, "Boolean
satisfiability with transitivity constraints", CAV 2000)."""

from __future__ import annotations

from collections.abc import Hashable, Iterator, Mapping
from typing import TypeVar

_Node = TypeVar("_Node", bound=Hashable)


def triangles(graph: Mapping[_Node, set[_Node]]) -> Iterator[tuple[_Node, _Node, _Node]]:
    """The triangles of a chordal completion, by repeated removal of a node of minimal degree."""
    left = {node: set(near) for node, near in graph.items()}
    while left:
        node = min(left, key=lambda n: (len(left[n]), str(n)))
        near = sorted(left.pop(node), key=str)
        for position, x in enumerate(near):
            left[x].discard(node)
            for y in near[position + 1 :]:
                left[x].add(y)
                left[y].add(x)
                yield node, x, y
