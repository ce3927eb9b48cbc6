"""Formulas as decision diagrams, to count the situations that make them true.

A solver finds one situation, a count needs all. Here every name is a variable of a few values: a condition or trigger
has two, a scale its values, a number one for each region that the comparisons at hand can tell apart. Numbers that are
compared with one another are one variable, whose values are the orders and regions that numbers can have. Two formulas
are equal in every situation exactly when they are the same node (reduced ordered diagrams, Bryant 1986, with many
values). The size may grow exponentially with the names: past `MOST_NAMES`, `MOST_NODES` or `MOST_CELLS` it is given up.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import product
from typing import TYPE_CHECKING

from sleec_runtime.model import (
    And,
    Atom,
    Comparison,
    Formula,
    Measure,
    MeasureRef,
    Not,
    Number,
    Operator,
    ScaleValue,
    Truth,
    leaves,
    measures_of,
)
from sleec_verify.encoding.measures import MIRRORED
from sleec_verify.encoding.regions import Cut, cut_at

if TYPE_CHECKING:
    from sleec_verify.query.names import Name

MOST_NODES = 200_000
"""Nodes of one diagram."""

MOST_NAMES = 250
"""Variables of one diagram. What is asked of it recurs once for each, and twice in `some`."""

MOST_CELLS = 2_000
"""Combinations of regions and orders that are tried for numbers compared with one another."""

FALSE, TRUE = 0, 1


class TooLarge(Exception):
    """A diagram past its bound; the message says which."""


@dataclass(frozen=True)
class Part:
    """What a situation says of some names that go together: `ways` many things.

    `names` is one name, or numbers that are compared with one another. `cuts` are the bounds between the regions of
    each number, in their order; `orders` the pairs that are compared.
    """

    names: tuple[Name, ...]
    ways: int
    cuts: tuple[tuple[str, tuple[Cut, ...]], ...] = ()
    orders: tuple[tuple[str, str], ...] = ()


class Diagram:
    """The diagrams of any formulas over the names of `formulas`, in the order in which these are first named."""

    def __init__(self, formulas: Sequence[Formula], measures: Mapping[str, Measure]) -> None:
        """Raises `TooLarge` for too many names, or where numbers compared with one another have too many regions."""
        self._measures = measures
        self._nodes: list[tuple[int, tuple[int, ...]]] = [(-1, ()), (-1, ())]
        self._unique: dict[tuple[int, tuple[int, ...]], int] = {}
        self._both: dict[tuple[int, int], int] = {}
        self._opposite: dict[int, int] = {FALSE: TRUE, TRUE: FALSE}
        self._built: dict[int, tuple[Formula, int]] = {}
        self.parts: list[Part] = []
        self._part_of: dict[Name, int] = {}
        self._cells: dict[int, list[tuple[tuple[int, ...], tuple[int, ...]]]] = {}
        self._collect(formulas)

    # Variables ---------------------------------------------------------------------------------------------

    def _collect(self, formulas: Sequence[Formula]) -> None:
        found: dict[Name, None] = {}
        cuts: dict[str, set[Cut]] = {}
        pairs: dict[tuple[str, str], None] = {}
        for formula in formulas:
            for leaf in leaves(formula):
                if isinstance(leaf, Atom):
                    found.setdefault((leaf.kind, leaf.name))
                    continue
                names = measures_of(leaf)
                found.update(dict.fromkeys(("condition", name) for name in names))
                if self._measures[names[0]].kind == "scale":
                    continue
                if len(names) == 2:
                    if names[0] != names[1]:
                        pairs.setdefault((min(names), max(names)))
                else:
                    cuts.setdefault(names[0], set()).update(self._cuts_of(leaf))
        clusters = _clusters(pairs)
        for name in found:
            if name not in self._part_of:
                self._add(name, cuts, clusters, pairs)
                if len(self.parts) > MOST_NAMES:
                    raise TooLarge(f"it concerns more than {MOST_NAMES:,} names")

    def _add(
        self,
        name: Name,
        cuts: Mapping[str, set[Cut]],
        clusters: Mapping[str, tuple[str, ...]],
        pairs: Iterable[tuple[str, str]],
    ) -> None:
        measure = self._measures.get(name[1]) if name[0] == "condition" else None
        if measure is None:
            part = Part((name,), 2)
        elif measure.kind == "scale":
            part = Part((name,), len(measure.values))
        else:
            members = clusters.get(name[1], (name[1],))
            bounds = tuple((member, tuple(sorted(cuts.get(member, ())))) for member in members)
            orders = tuple(pair for pair in pairs if pair[0] in members)
            ways = len(bounds[0][1]) + 1
            if orders:
                self._cells[len(self.parts)] = cells = self._possible(bounds, orders)
                ways = len(cells)
            part = Part(tuple(("condition", member) for member in members), ways, bounds, orders)
        self._part_of.update(dict.fromkeys(part.names, len(self.parts)))
        self.parts.append(part)

    def _possible(
        self, bounds: Sequence[tuple[str, tuple[Cut, ...]]], orders: Sequence[tuple[str, str]]
    ) -> list[tuple[tuple[int, ...], tuple[int, ...]]]:
        """The regions of each number, and -1, 0 or 1 for each pair, that numbers can have together."""
        from sleec_verify.encoding.order import place

        tried = 3 ** len(orders)
        for _, cuts in bounds:
            tried *= len(cuts) + 1
        if tried > MOST_CELLS:
            raise TooLarge(f"numbers that are compared with one another have more than {MOST_CELLS:,} orders")
        integral = {name: self._measures[name].kind == "integer" for name, _ in bounds}
        found = []
        for regions in product(*(range(len(cuts) + 1) for _, cuts in bounds)):
            limits = [
                (name, cut.value, cut.inclusive, 1 if region <= at else -1)
                for (name, cuts), region in zip(bounds, regions)
                for at, cut in enumerate(cuts)
            ]
            for signs in product((-1, 0, 1), repeat=len(orders)):
                ordered = []
                for (x, y), sign in zip(orders, signs):
                    ordered += [(x, y, 1 if sign <= 0 else -1), (y, x, 1 if sign >= 0 else -1)]
                if not isinstance(place(integral, limits, ordered), list):
                    found.append((regions, signs))
        return found

    def _cuts_of(self, comparison: Comparison) -> Iterator[Cut]:
        name, operator, value = self._against_number(comparison)
        for inclusive in (False, True):
            if inclusive == (operator in ("<=", ">")) or operator in ("=", "!="):
                yield cut_at(self._measures[name], value.value, inclusive)

    @staticmethod
    def _against_number(comparison: Comparison) -> tuple[str, Operator, Number]:
        left, operator, right = comparison.left, comparison.operator, comparison.right
        if not isinstance(left, MeasureRef):
            left, operator, right = right, MIRRORED[operator], left
        assert isinstance(left, MeasureRef)
        assert isinstance(right, Number)
        return left.name, operator, right

    # Nodes -------------------------------------------------------------------------------------------------

    def _node(self, part: int, children: tuple[int, ...]) -> int:
        if children.count(children[0]) == len(children):
            return children[0]
        key = (part, children)
        node = self._unique.get(key)
        if node is None:
            if len(self._nodes) >= MOST_NODES:
                raise TooLarge(f"a decision diagram of more than {MOST_NODES:,} nodes would be needed")
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
            (part, mine), (other, theirs) = self._nodes[a], self._nodes[b]
            first = min(part, other)
            ways = self.parts[first].ways
            one = mine if part == first else (a,) * ways
            two = theirs if other == first else (b,) * ways
            found = self._node(first, tuple(map(self.both, one, two)))
            self._both[key] = found
        return found

    def opposite(self, node: int) -> int:
        """The node of ``¬node``."""
        found = self._opposite.get(node)
        if found is None:
            part, children = self._nodes[node]
            found = self._node(part, tuple(map(self.opposite, children)))
            self._opposite[node] = found
            self._opposite[found] = node
        return found

    def either(self, a: int, b: int) -> int:
        """The node of ``a ∨ b``."""
        return self.opposite(self.both(self.opposite(a), self.opposite(b)))

    def node(self, formula: Formula) -> int:
        """The node of a formula, whose names and comparisons are among those that the diagram was made for."""
        built = self._built.get(id(formula))
        if built is None:
            # The formula is kept, so that its id stays its own.
            built = self._built[id(formula)] = (formula, self._build(formula))
        return built[1]

    def _build(self, formula: Formula) -> int:
        if isinstance(formula, Truth):
            return TRUE if formula.value else FALSE
        if isinstance(formula, Not):
            return self.opposite(self.node(formula.operand))
        if isinstance(formula, Atom):
            return self._node(self._part_of[formula.kind, formula.name], (FALSE, TRUE))
        if isinstance(formula, Comparison):
            return self._compared(formula)
        joined = TRUE
        conjunction = isinstance(formula, And)
        for operand in formula.operands:
            node = self.node(operand)
            joined = self.both(joined, node if conjunction else self.opposite(node))
        return joined if conjunction else self.opposite(joined)

    def _compared(self, comparison: Comparison) -> int:
        names = measures_of(comparison)
        if len(names) == 2 and names[0] == names[1]:
            return TRUE if comparison.operator in ("=", "<=", ">=") else FALSE
        if self._measures[names[0]].kind == "scale":
            return self._on_scale(comparison, names)
        part = self._part_of["condition", names[0]]
        ways = range(self.parts[part].ways)
        if len(names) == 2:
            pair = (min(names), max(names))
            at = self.parts[part].orders.index(pair)
            turned = 1 if pair == names else -1
            signs = (turned * self._cells[part][way][1][at] for way in ways)
            return self._node(part, tuple(int(compares(sign, comparison.operator)) for sign in signs))
        name, operator, number = self._against_number(comparison)
        member = [one for one, _ in self.parts[part].cuts].index(name)
        cuts = self.parts[part].cuts[member][1]
        cells = self._cells.get(part)
        regions = [cells[way][0][member] if cells else way for way in ways]
        below = self._measured(name, cuts, number, inclusive=False)
        at_most = self._measured(name, cuts, number, inclusive=True)
        signs = (-1 if region <= below else 0 if region <= at_most else 1 for region in regions)
        return self._node(part, tuple(int(compares(sign, operator)) for sign in signs))

    def _measured(self, name: str, cuts: Sequence[Cut], number: Number, inclusive: bool) -> int:
        """The last region that is below the number, or at most it; where no cut is there, none needs to be told."""
        wanted = cut_at(self._measures[name], number.value, inclusive)
        return max((at for at, cut in enumerate(cuts) if cut <= wanted), default=-1)

    def _on_scale(self, comparison: Comparison, names: tuple[str, ...]) -> int:
        def sides(term: object) -> list[tuple[int, int]]:
            """Each place in the scale that a side can have, with the node of "it has it"."""
            if isinstance(term, ScaleValue):
                return [(term.rank, TRUE)]
            assert isinstance(term, MeasureRef)
            part = self._part_of["condition", term.name]
            ways = self.parts[part].ways
            return [(rank, self._node(part, tuple(int(way == rank) for way in range(ways)))) for rank in range(ways)]

        found = FALSE
        for left, here in sides(comparison.left):
            for right, there in sides(comparison.right):
                if compares((left > right) - (left < right), comparison.operator):
                    found = self.either(found, self.both(here, there))
        return found

    # Answers -----------------------------------------------------------------------------------------------

    def support(self, node: int) -> set[int]:
        """The parts that a node depends on, by their places in `parts`."""
        seen, found, left = {FALSE, TRUE}, set(), [node]
        while left:
            at = left.pop()
            if at not in seen:
                seen.add(at)
                part, children = self._nodes[at]
                found.add(part)
                left += children
        return found

    def some(self, node: int, kept: set[int]) -> int:
        """The node of "the parts that are not `kept` can be chosen so that `node` is true"."""
        known = {FALSE: FALSE, TRUE: TRUE}

        def walk(at: int) -> int:
            if at not in known:
                part, children = self._nodes[at]
                projected = tuple(map(walk, children))
                if part in kept:
                    known[at] = self._node(part, projected)
                else:
                    joined = FALSE
                    for child in projected:
                        joined = self.either(joined, child)
                    known[at] = joined
            return known[at]

        return walk(node)

    def count(self, node: int, over: set[int]) -> int:
        """How many choices for the parts `over`, which hold all that `node` depends on, make it true."""
        order = sorted(over)
        place = {part: at for at, part in enumerate(order)}
        sizes = [self.parts[part].ways for part in order]
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
                    known[at] += walk(child) * _product(sizes[here + 1 : level(child)])
            return known[at]

        return walk(node) * _product(sizes[: level(node)])


def _product(sizes: Iterable[int]) -> int:
    result = 1
    for size in sizes:
        result *= size
    return result


def compares(sign: int, operator: Operator) -> bool:
    """Whether two things compare so, where `sign` is -1, 0 or 1 for less, equal or more."""
    return {"<": sign < 0, "<=": sign <= 0, "=": sign == 0, "!=": sign != 0, ">=": sign >= 0, ">": sign > 0}[operator]


def _clusters(pairs: Iterable[tuple[str, str]]) -> dict[str, tuple[str, ...]]:
    """For each name of a pair, all names that are tied to it, sorted."""
    together: dict[str, set[str]] = {}
    for x, y in pairs:
        joined = together.get(x, {x}) | together.get(y, {y})
        together.update(dict.fromkeys(joined, joined))
    return {name: tuple(sorted(members)) for name, members in together.items()}
