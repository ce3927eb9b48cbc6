"""Union-find with path halving (Tarjan and van Leeuwen 1984)."""

from __future__ import annotations

from collections.abc import Hashable


class UnionFind:
    """Sets of items that grow together. Each call takes amortised near-constant time."""

    def __init__(self) -> None:
        self._parent: dict[Hashable, Hashable] = {}

    def root(self, item: Hashable) -> Hashable:
        """The representative of the set of an item."""
        while self._parent.setdefault(item, item) != item:
            self._parent[item] = self._parent[self._parent[item]]
            item = self._parent[item]
        return item

    def join(self, one: Hashable, other: Hashable) -> None:
        """Unite the sets of two items."""
        self._parent[self.root(one)] = self.root(other)
