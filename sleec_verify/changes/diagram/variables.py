"""The variables of a diagram over formulas, each with a few values.

A condition or trigger has two values, a scale its own, and a number one for each region that the comparisons
distinguish. Numbers that are compared with each other are one variable, whose values are their possible orders and
regions.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import product

from sleec_runtime.model import Atom, Comparison, Formula, Measure, MeasureRef, Number, Operator, leaves, measures_of
from sleec_verify.changes.diagram.decision_diagram import TooLarge
from sleec_verify.encoding.measures import MIRRORED
from sleec_verify.encoding.order import place
from sleec_verify.encoding.regions import Cut, cut_at
from sleec_verify.encoding.union_find import UnionFind
from sleec_verify.query.names import Name
from sleec_verify.wording.sentence import sentence

MOST_NAMES = 250
"""The maximal number of variables of one diagram. Operations recur once for each, and twice in `some`."""

MOST_CELLS = 2_000
"""The maximal number of combinations of regions and orders for numbers that are compared with each other."""


@dataclass(frozen=True)
class Variable:
    """The possible values of one name or of connected names: one of `ways` values.

    `names` is one name, or numbers that are compared with each other. `cuts` are the bounds between the regions of each
    number, in their order. `orders` are the pairs that are compared.
    """

    names: tuple[Name, ...]
    ways: int
    cuts: tuple[tuple[str, tuple[Cut, ...]], ...] = ()
    orders: tuple[tuple[str, str], ...] = ()


class Variables:
    """The variables of some formulas, in the order of their first use. `cells` are, for a variable of several
    numbers, the regions of each and the sign of each order, by value."""

    def __init__(self, formulas: Sequence[Formula], measures: Mapping[str, Measure]) -> None:
        """Raises `TooLarge` for too many names, or too many regions of numbers that are compared with each other."""
        self._measures = measures
        self.all: list[Variable] = []
        self._place: dict[Name, int] = {}
        self.cells: dict[int, list[tuple[tuple[int, ...], tuple[int, ...]]]] = {}
        self._collect(formulas)

    def of(self, name: Name) -> int:
        """The number of the variable of a name."""
        return self._place[name]

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
            if name not in self._place:
                self._add(name, cuts, clusters, pairs)
                if len(self.all) > MOST_NAMES:
                    raise TooLarge(sentence("it depends on more than {limit} names", limit=f"{MOST_NAMES:,}"))

    def _add(
        self,
        name: Name,
        cuts: Mapping[str, set[Cut]],
        clusters: Mapping[str, tuple[str, ...]],
        pairs: Iterable[tuple[str, str]],
    ) -> None:
        measure = self._measures.get(name[1]) if name[0] == "condition" else None
        if measure is None:
            variable = Variable((name,), 2)
        elif measure.kind == "scale":
            variable = Variable((name,), len(measure.values))
        else:
            members = clusters.get(name[1], (name[1],))
            bounds = tuple((member, tuple(sorted(cuts.get(member, ())))) for member in members)
            orders = tuple(pair for pair in pairs if pair[0] in members)
            ways = len(bounds[0][1]) + 1
            if orders:
                self.cells[len(self.all)] = cells = self._possible(bounds, orders)
                ways = len(cells)
            variable = Variable(tuple(("condition", member) for member in members), ways, bounds, orders)
        self._place.update(dict.fromkeys(variable.names, len(self.all)))
        self.all.append(variable)

    def _possible(
        self, bounds: Sequence[tuple[str, tuple[Cut, ...]]], orders: Sequence[tuple[str, str]]
    ) -> list[tuple[tuple[int, ...], tuple[int, ...]]]:
        """The possible combinations of a region for each number and -1, 0 or 1 for each pair."""
        tried = 3 ** len(orders)
        for _, cuts in bounds:
            tried *= len(cuts) + 1
        if tried > MOST_CELLS:
            limit = f"{MOST_CELLS:,}"
            raise TooLarge(
                sentence("measures that are compared with each other have more than {limit} orders", limit=limit)
            )
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
        name, operator, value = against_number(comparison)
        for inclusive in (False, True):
            if inclusive == (operator in ("<=", ">")) or operator in ("=", "!="):
                yield cut_at(self._measures[name], value.value, inclusive)


def against_number(comparison: Comparison) -> tuple[str, Operator, Number]:
    """A comparison of a measure with a number as measure, operator and number."""
    left, operator, right = comparison.left, comparison.operator, comparison.right
    if not isinstance(left, MeasureRef):
        left, operator, right = right, MIRRORED[operator], left
    assert isinstance(left, MeasureRef)
    assert isinstance(right, Number)
    return left.name, operator, right


def _clusters(pairs: Iterable[tuple[str, str]]) -> dict[str, tuple[str, ...]]:
    """For each name in a pair, all names that are connected with it, sorted."""
    sets = UnionFind()
    for x, y in pairs:
        sets.join(x, y)
    members: dict[Hashable, set[str]] = {}
    for name in (name for pair in pairs for name in pair):
        members.setdefault(sets.root(name), set()).add(name)
    return {name: tuple(sorted(names)) for names in members.values() for name in names}
