"""Reduced ordered multi-valued decision diagrams (Bryant 1986).

Variables are numbered from 0, in their order, and so are their values. Two nodes are equivalent exactly if they have
the same number. The size may grow exponentially with the variables, up to `MOST_NODES`.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from math import prod

from sleec_verify.wording.sentence import sentence

MOST_NODES = 200_000
"""The maximal number of nodes of one diagram, unless it has a limit of its own."""

FALSE, TRUE = 0, 1


class TooLarge(Exception):
    """A diagram at its limit, which the message names."""


class DecisionDiagram:
    """Nodes over variables with `sizes` values."""

    def __init__(self, sizes: Sequence[int], most_nodes: int | None = None) -> None:
        self._sizes = sizes
        self._most_nodes = MOST_NODES if most_nodes is None else most_nodes
        self._nodes: list[tuple[int, tuple[int, ...]]] = [(-1, ()), (-1, ())]
        self._unique: dict[tuple[int, tuple[int, ...]], int] = {}
        self._both: dict[tuple[int, int], int] = {}
        self._opposite: dict[int, int] = {FALSE: TRUE, TRUE: FALSE}

    def make(self, variable: int, children: tuple[int, ...]) -> int:
        """The node that chooses one of `children` by the value of a variable."""
        if children.count(children[0]) == len(children):
            return children[0]
        key = (variable, children)
        node = self._unique.get(key)
        if node is None:
            if len(self._nodes) >= self._most_nodes:
                limit = f"{self._most_nodes:,}"
                raise TooLarge(sentence("the decision diagram would need more than {limit} nodes", limit=limit))
            node = self._unique[key] = len(self._nodes)
            self._nodes.append(key)
        return node

    def both(self, a: int, b: int) -> int:
        """The node of ``a ∧ b``. O(nodes of a · nodes of b)."""
        if a == FALSE or b == FALSE:
            return FALSE
        if a in (TRUE, b):
            return b
        if b == TRUE:
            return a
        key = (a, b) if a < b else (b, a)
        found = self._both.get(key)
        if found is None:
            (variable, mine), (other, theirs) = self._nodes[a], self._nodes[b]
            first = min(variable, other)
            ways = self._sizes[first]
            one = mine if variable == first else (a,) * ways
            two = theirs if other == first else (b,) * ways
            found = self.make(first, tuple(map(self.both, one, two)))
            self._both[key] = found
        return found

    def opposite(self, node: int) -> int:
        """The node of ``¬node``."""
        found = self._opposite.get(node)
        if found is None:
            variable, children = self._nodes[node]
            found = self.make(variable, tuple(map(self.opposite, children)))
            self._opposite[node] = found
            self._opposite[found] = node
        return found

    def either(self, a: int, b: int) -> int:
        """The node of ``a ∨ b``."""
        return self.opposite(self.both(self.opposite(a), self.opposite(b)))

    def first_variable(self, nodes: Iterable[int]) -> int:
        """The first variable that one of some nodes chooses by. One of them is not `TRUE` or `FALSE`."""
        return min(self._nodes[node][0] for node in nodes if node > TRUE)

    def child(self, node: int, variable: int, value: int) -> int:
        """The node under a value of a variable that is not after the variable of the node."""
        own, children = self._nodes[node]
        return children[value] if own == variable else node

    def support(self, node: int) -> set[int]:
        """The variables that a node depends on."""
        seen, found, left = {FALSE, TRUE}, set(), [node]
        while left:
            at = left.pop()
            if at not in seen:
                seen.add(at)
                variable, children = self._nodes[at]
                found.add(variable)
                left += children
        return found

    def some(self, node: int, kept: set[int]) -> int:
        """The node of "some values of the variables outside `kept` make `node` true"."""
        known = {FALSE: FALSE, TRUE: TRUE}

        def walk(at: int) -> int:
            if at not in known:
                variable, children = self._nodes[at]
                projected = tuple(map(walk, children))
                if variable in kept:
                    known[at] = self.make(variable, projected)
                else:
                    joined = FALSE
                    for child in projected:
                        joined = self.either(joined, child)
                    known[at] = joined
            return known[at]

        return walk(node)

    def count(self, node: int, over: set[int]) -> int:
        """The number of values of the variables `over` that make the node true. `over` contains all variables on
        which it depends."""
        order = sorted(over)
        place = {variable: at for at, variable in enumerate(order)}
        sizes = [self._sizes[variable] for variable in order]
        known: dict[int, int] = {}

        def level(at: int) -> int:
            return place[self._nodes[at][0]] if at > TRUE else len(order)

        def walk(at: int) -> int:
            if at <= TRUE:
                return at
            if at not in known:
                here = level(at)
                known[at] = 0
                for child in self._nodes[at][1]:
                    known[at] += walk(child) * prod(sizes[here + 1 : level(child)])
            return known[at]

        return walk(node) * prod(sizes[: level(node)])
