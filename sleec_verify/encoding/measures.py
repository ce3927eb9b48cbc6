"""Measures as propositional variables: the regions that a set of comparisons distinguishes.

A number that is compared with constants is divided at these constants, and a scale between its values (order encoding:
one variable for "below this cut", each implying the next). Numbers that are compared with each other have a variable
for each ordered pair, with transitivity over a chordal completion of the comparisons. This is sufficient for every
model to be the order of some rationals, with far fewer clauses than all triples.

Only whole numbers that are compared with each other need more, because an order of rationals may leave no room for
integers. `Measures.decode` then returns a clause that excludes the model, and the caller asks again.

A calculation with several measures is a further, unconstrained measure. `encoding.arithmetic` is asked whether it can
have the result that a model chose, if the current values do not give this result. It also excludes a model by a clause.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from itertools import pairwise, permutations
from typing import NamedTuple, Union

from sleec_runtime.model import (
    Calculation,
    Comparison,
    Measure,
    MeasureRef,
    Number,
    Operator,
    Rational,
    ScaleValue,
    Term,
    measures_of,
)
from sleec_verify.encoding.chordal import triangles
from sleec_verify.encoding.regions import Cut, cut_at, cut_text, pick_between


class _Constant(NamedTuple):
    value: Rational


_Node = Union[str, _Constant]
"""A node of an order: a measure by its name, or a constant."""

MIRRORED: Mapping[Operator, Operator] = {"<": ">", "<=": ">=", ">": "<", ">=": "<=", "=": "=", "!=": "!="}


class Measures:
    """The comparisons of one formula as literals over variables of `fresh`.

    `true` is a literal that is always true. `add` receives clauses. Call `close` after the last comparison.
    """

    def __init__(
        self,
        declared: Mapping[str, Measure],
        true: Callable[[], int],
        fresh: Callable[[tuple[str, ...]], int],
        add: Callable[[list[int]], None],
        both: Callable[[int, int], int],
    ) -> None:
        self._declared = declared
        self._true = true
        self._fresh = fresh
        self._add = add
        self._both = both
        self.cuts: dict[str, dict[Cut, int]] = {}
        self.orders: dict[tuple[str, str], int] = {}
        """The variable of ``x <= y`` for each pair (x, y)."""
        self.calculations: dict[str, Calculation] = {}
        """The calculations, by their names in `cuts`, which are not names of measures."""
        self.refused_by_arithmetic = False
        """Whether `decode` has returned a clause that follows from arithmetic, not from an order."""
        self._decoded: dict[tuple[int, ...], dict[str, Rational] | list[int]] = {}
        self._seen: dict[str, None] = {}

    def mention(self, measure: str) -> None:
        """Make sure that `decode` gives a value to this measure."""
        self._seen[measure] = None

    def literal(self, comparison: Comparison) -> int:
        """The literal that is equivalent to the comparison."""
        self._seen.update(dict.fromkeys(measures_of(comparison)))
        left, operator, right = comparison.left, comparison.operator, comparison.right
        if isinstance(left, Calculation):
            name = self._name(left)
        else:
            if not isinstance(left, MeasureRef):
                left, operator, right = right, MIRRORED[operator], left
            assert isinstance(left, MeasureRef), "a comparison has a measure on one side at least"
            name = left.name
        if operator == "<":
            return self._below(name, right, inclusive=False)
        if operator == "<=":
            return self._below(name, right, inclusive=True)
        if operator == ">":
            return -self._below(name, right, inclusive=True)
        if operator == ">=":
            return -self._below(name, right, inclusive=False)
        at_most = self._below(name, right, inclusive=True)
        below = self._below(name, right, inclusive=False)
        equal = self._both(at_most, -below)
        return equal if operator == "=" else -equal

    def _name(self, calculated: Calculation) -> str:
        """The name of a calculation in `cuts`, independent of the order of its summands."""
        name = " + ".join(sorted(" * ".join((*names, str(factor))) for factor, names in calculated.terms))
        self.calculations.setdefault(name, calculated)
        return name

    def _measure(self, name: str) -> Measure:
        calculated = self.calculations.get(name)
        if calculated is None:
            return self._declared[name]
        whole = all(self._declared[one].kind == "integer" for one in calculated.measures)
        return Measure(name, "integer" if whole else "number")

    def _below(self, name: str, term: Term, inclusive: bool) -> int:
        measure = self._measure(name)
        if isinstance(term, ScaleValue):
            return self._below_rank(name, term.rank + inclusive)
        if isinstance(term, Number):
            return self._below_number(name, measure, term.value, inclusive)
        assert isinstance(term, MeasureRef), "a calculation stands on the left"
        if measure.kind == "scale":
            return self._below_other_scale(name, term.name, len(measure.values), inclusive)
        if inclusive:
            return self._at_most(name, term.name)
        return -self._at_most(term.name, name)

    def _below_rank(self, name: str, rank: int) -> int:
        if rank <= 0:
            return -self._true()
        if rank >= len(self._declared[name].values):
            return self._true()
        return self._cut(name, Cut(rank, False))

    def _below_number(self, name: str, measure: Measure, value: Rational, inclusive: bool) -> int:
        return self._cut(name, cut_at(measure, value, inclusive))

    def _below_other_scale(self, name: str, other: str, size: int, inclusive: bool) -> int:
        # x < y where some cut has x below it and y not; x <= y where no cut has y below it and x not.
        if inclusive:
            return -self._below_other_scale(other, name, size, inclusive=False)
        found = -self._true()
        for rank in range(1, size):
            between = self._both(self._below_rank(name, rank), -self._below_rank(other, rank))
            found = -self._both(-found, -between)
        return found

    def _at_most(self, name: str, other: str) -> int:
        if name == other:
            return self._true()
        if (name, other) not in self.orders:
            self.orders[name, other] = self._fresh(("at-most", name, other))
            self.orders[other, name] = self._fresh(("at-most", other, name))
            self._add([self.orders[name, other], self.orders[other, name]])
        return self.orders[name, other]

    def _cut(self, name: str, cut: Cut) -> int:
        cuts = self.cuts.setdefault(name, {})
        variable = cuts.get(cut)
        if variable is None:
            variable = cuts[cut] = self._fresh(("below", name, cut_text(self._measure(name), cut)))
        return variable

    def close(self) -> None:
        """Add the clauses about the order of the variables."""
        if self.orders:
            for a, b, c in triangles(self._graph()):
                for x, y, z in permutations((a, b, c)):
                    self._add([-self._ordered(x, y), -self._ordered(y, z), self._ordered(x, z)])
        for cuts in self.cuts.values():
            in_order = [cuts[cut] for cut in sorted(cuts)]
            for lower, higher in pairwise(in_order):
                self._add([-lower, higher])

    def _graph(self) -> dict[_Node, set[_Node]]:
        graph: dict[_Node, set[_Node]] = {}

        def join(x: _Node, y: _Node) -> None:
            graph.setdefault(x, set()).add(y)
            graph.setdefault(y, set()).add(x)

        for x, y in self.orders:
            join(x, y)
        values: set[Rational] = set()
        for name in list(graph):
            assert isinstance(name, str)
            for cut in self.cuts.get(name, ()):
                join(name, _Constant(cut.value))
                values.add(cut.value)
        in_order = sorted(values)
        for low, high in pairwise(in_order):
            join(_Constant(low), _Constant(high))
        return graph

    def _ordered(self, x: _Node, y: _Node) -> int:
        """The literal of ``x <= y``."""
        if isinstance(x, _Constant):
            if isinstance(y, _Constant):
                return self._true() if x.value <= y.value else -self._true()
            return -self._below_number(y, self._declared[y], x.value, inclusive=False)
        if isinstance(y, _Constant):
            return self._below_number(x, self._declared[x], y.value, inclusive=True)
        return self._at_most(x, y)

    def measures(self) -> Iterator[str]:
        """Every measure in a comparison."""
        yield from self._seen

    def assumptions(self, values: Mapping[str, Rational | str]) -> Iterator[int]:
        """The literals that are true for measures with these values. A measure without a value gives none."""
        known = {**values, **self._results(values)}
        for name, cuts in self.cuts.items():
            if name in known:
                measure, value = self._measure(name), known[name]
                position = measure.values.index(value) if isinstance(value, str) else value
                for (limit, inclusive), variable in cuts.items():
                    yield variable if position < limit or (inclusive and position == limit) else -variable
        for (x, y), variable in self.orders.items():
            if x in values and y in values:
                yield variable if values[x] <= values[y] else -variable  # type: ignore[operator]

    def _results(self, values: Mapping[str, Rational | str]) -> dict[str, Rational]:
        """The results of the calculations whose measures all have values."""
        numbers = {name: value for name, value in values.items() if not isinstance(value, str)}
        return {
            name: calculated.value(numbers)
            for name, calculated in self.calculations.items()
            if numbers.keys() >= set(calculated.measures)
        }

    def decode(self, model: Callable[[int], bool]) -> dict[str, Rational | str] | list[int]:
        """Values in the regions that `model` chose, whole numbers where possible.

        If the order leaves no room for integers, or calculations cannot have the chosen results, it returns a clause
        that excludes the model and holds for all whole numbers. Raises `Undecided` if this is unknown.
        """
        values = self._placed(model)
        if not self.calculations or isinstance(values, list):
            return values
        results = self._results(values)
        if all(
            (result < cut.value or (cut.inclusive and result == cut.value)) == model(variable)
            for name, result in results.items()
            for cut, variable in self.cuts.get(name, {}).items()
        ):
            return values
        found = self._calculated(model, values)
        if isinstance(found, list):
            self.refused_by_arithmetic = True
            return [-literal for literal in found]
        values.update(found)
        return values

    def refused(self, model: Callable[[int], bool], proving: bool = False) -> list[int] | None:
        """The clause that `decode` returns, if any.

        Raises `Undecided` as `decode` does, and, with `proving`, if the clause follows only from arithmetic, because
        there is no proof of it.
        """
        if not (self.orders or self.calculations):
            return None
        decoded = self.decode(model)
        if isinstance(decoded, dict):
            return None
        if proving and self.refused_by_arithmetic:
            from sleec_verify.encoding.arithmetic import unproved

            raise unproved(self.calculations.values())
        return decoded

    def _calculated(
        self, model: Callable[[int], bool], values: Mapping[str, Rational | str]
    ) -> dict[str, Rational] | list[int]:
        """Values, near `values` if possible, for the measures in calculations and those connected with them; or
        literals of the model that are inconsistent."""
        from sleec_verify.encoding.arithmetic import values_for
        from sleec_verify.encoding.local_search import search_nearby

        names = {name for one in self.calculations.values() for name in one.measures}
        names.update(name for pair in self.orders for name in pair)
        cuts = self._chosen(sorted(names), model)
        orders = [(x, y, v if model(v) else -v) for (x, y), v in self.orders.items()]
        compared = self._chosen(self.calculations, model)
        asked = (*(cut[3] for cut in cuts), *(order[2] for order in orders), *(cut[3] for cut in compared))
        if asked not in self._decoded:
            results = [
                (self.calculations[name], value, inclusive, literal) for name, value, inclusive, literal in compared
            ]
            here = {name: value for name in sorted(names) if not isinstance(value := values[name], str)}
            integral = {name: self._declared[name].kind == "integer" for name in here}
            found = search_nearby(here, cuts, orders, results) if all(integral.values()) else None
            self._decoded[asked] = found or values_for(integral, cuts, orders, results)
        return self._decoded[asked]

    def _chosen(self, names: Iterable[str], model: Callable[[int], bool]) -> list[tuple[str, Rational, bool, int]]:
        """The cuts of measures and calculations, each with its literal in the model."""
        return [
            (name, cut.value, cut.inclusive, variable if model(variable) else -variable)
            for name in names
            for cut, variable in self.cuts.get(name, {}).items()
        ]

    def _placed(self, model: Callable[[int], bool]) -> dict[str, Rational | str] | list[int]:
        """Values by the regions and orders of the measures, regardless of calculations."""
        from sleec_verify.encoding.order import place

        clustered = {name for pair in self.orders for name in pair}
        values: dict[str, Rational | str] = {}
        for name in self.measures():
            measure = self._declared[name]
            if measure.kind == "scale":
                cuts = self.cuts.get(name, {})
                rank = max((int(cut.value) for cut, v in cuts.items() if not model(v)), default=0)
                values[name] = measure.values[rank]
            elif name not in clustered:
                cuts = self.cuts.get(name, {})
                low = max((cut for cut, v in cuts.items() if not model(v)), default=None)
                high = min((cut for cut, v in cuts.items() if model(v)), default=None)
                values[name] = pick_between(low, high)
        if not clustered:
            return values
        placed = place(
            {name: self._declared[name].kind == "integer" for name in sorted(clustered)},
            self._chosen(sorted(clustered), model),
            [(x, y, v if model(v) else -v) for (x, y), v in self.orders.items()],
        )
        if isinstance(placed, list):
            return [-literal for literal in placed]
        values.update(placed)
        return values
