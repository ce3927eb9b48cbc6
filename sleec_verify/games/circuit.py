"""And-inverter circuits: formulas as conjunctions and negations, with equal parts shared.

A literal is a non-zero integer: the number of a node, or its negation. Constants are folded, so a formula shrinks with
every move that is fixed.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence

from sleec_verify.encoding.solver import Undecided
from sleec_verify.wording.phrases import grouped
from sleec_verify.wording.sentence import sentence

TRUE = 1
FALSE = -1

MOST_NODES = 4_000_000
"""The maximal number of nodes of a question. They take about a gigabyte."""


class Circuit:
    """Nodes numbered from 1, which is the constant true. The inputs of a node have smaller numbers."""

    def __init__(self) -> None:
        self._parts: list[tuple[int, int] | None] = [None, None]
        self._known: dict[tuple[int, int], int] = {}

    def __len__(self) -> int:
        return len(self._parts)

    def variable(self) -> int:
        """A new variable."""
        self._parts.append(None)
        return len(self._parts) - 1

    def variables(self, number: int) -> list[int]:
        return [self.variable() for _ in range(number)]

    def both(self, a: int, b: int) -> int:
        """The conjunction of two literals. Raises Undecided past `MOST_NODES`."""
        if a == b or b == TRUE:
            return a
        if a == TRUE:
            return b
        if FALSE in (a, b) or a == -b:
            return FALSE
        if a > b:
            a, b = b, a
        node = self._known.get((a, b))
        if node is None:
            if len(self._parts) > MOST_NODES:
                raise Undecided(sentence("the formula would need more than {limit} nodes", limit=grouped(MOST_NODES)))
            self._parts.append((a, b))
            node = self._known[a, b] = len(self._parts) - 1
        return node

    def either(self, a: int, b: int) -> int:
        return -self.both(-a, -b)

    def every(self, literals: Iterable[int]) -> int:
        """The conjunction of any number of literals."""
        found = sorted(set(literals), key=abs)
        while len(found) > 1:
            # Balanced, so that the depth is logarithmic.
            found = [self.both(*found[i : i + 2]) if i + 1 < len(found) else found[i] for i in range(0, len(found), 2)]
        return found[0] if found else TRUE

    def some(self, literals: Iterable[int]) -> int:
        """The disjunction of any number of literals."""
        return -self.every(-literal for literal in literals)

    def implies(self, a: int, b: int) -> int:
        return -self.both(a, -b)

    def same(self, a: int, b: int) -> int:
        return self.both(self.implies(a, b), self.implies(b, a))

    def choice(self, condition: int, then: int, otherwise: int) -> int:
        """`then` where `condition` holds, else `otherwise`."""
        return self.both(self.implies(condition, then), self.implies(-condition, otherwise))

    def below(self, roots: Iterable[int]) -> list[int]:
        """The nodes that some literals depend on, inputs first."""
        seen: set[int] = set()
        ahead = [abs(root) for root in roots]
        all_parts = self._parts
        while ahead:
            node = ahead.pop()
            if node not in seen:
                seen.add(node)
                parts = all_parts[node]
                if parts is not None:
                    a, b = parts
                    ahead.append(a if a > 0 else -a)
                    ahead.append(b if b > 0 else -b)
        return sorted(seen)

    def replaced(self, root: int, values: Mapping[int, int]) -> int:
        """`root` with literals in place of some variables. O(size of the part below `root`)."""
        image = {1: 1}
        for node in self.below((root,)):
            parts = self._parts[node]
            if parts is None:
                image[node] = values.get(node, node)
            else:
                a, b = parts
                left, right = image[abs(a)], image[abs(b)]
                image[node] = self.both(left if a > 0 else -left, right if b > 0 else -right)
        found = image[abs(root)] if abs(root) != 1 else 1
        return found if root > 0 else -found

    def clauses(self, nodes: Iterable[int]) -> Iterator[Sequence[int]]:
        """Clauses that define each of these nodes. Variables have no clauses."""
        for node in nodes:
            parts = self._parts[node]
            if node == TRUE:
                yield (TRUE,)
            elif parts is not None:
                a, b = parts
                yield (-node, a)
                yield (-node, b)
                yield (node, -a, -b)
