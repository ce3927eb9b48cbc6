"""The values of conditions and measures that rules distinguish, and every context of these values.

A measure compared with constants has a region below, at, between and above them. Each is stood for by the values at its
ends, because that is where a wrong comparison shows. Measures that are compared with each other get enough values
in each region for every order of them.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from fractions import Fraction
from itertools import pairwise, product
from math import ceil, floor, prod
from typing import NamedTuple

from sleec_runtime.model import (
    Atom,
    Comparison,
    Context,
    Formula,
    Measure,
    Number,
    Rational,
    Value,
    leaves,
    measures_of,
)
from sleec_verify.encoding.calculations import calculations_in, unsupported

LIMIT = 2**16
"""Contexts that a test goes through one by one; a rule with more is sampled. Sixteen conditions are within it."""

BESIDE = Fraction(1, 1000)


class ValueRegion(NamedTuple):
    """A condition, a measure or a trigger and its values, the plainest first: False, or None for "not reported". An
    `event` is a trigger that a condition names: True says that it occurs."""

    name: str
    values: tuple[Value | None, ...]
    event: bool = False


def constants(formulas: Iterable[Formula]) -> dict[str, set[Rational]]:
    """The numbers that each measure is compared with, directly or through measures that it is compared with."""
    found: dict[str, set[Rational]] = {}
    joined = clusters(formulas := list(formulas))
    for comparison in _comparisons(formulas):
        numbers = {side.value for side in (comparison.left, comparison.right) if isinstance(side, Number)}
        for name in measures_of(comparison):
            for other in joined[name]:
                found.setdefault(other, set()).update(numbers)
    return found


def clusters(formulas: Iterable[Formula]) -> dict[str, frozenset[str]]:
    """For each measure, those that comparisons tie it to, itself included."""
    joined: dict[str, frozenset[str]] = {}
    for comparison in _comparisons(formulas):
        names = measures_of(comparison)
        group = frozenset(names).union(*(joined.get(name, frozenset()) for name in names))
        joined.update(dict.fromkeys(group, group))
    return joined


def _comparisons(formulas: Iterable[Formula]) -> Iterator[Comparison]:
    return (leaf for formula in formulas for leaf in leaves(formula) if isinstance(leaf, Comparison))


def number_values(kind: str, cuts: Iterable[Rational], places: int = 1) -> list[Rational]:
    """Numbers in every region that `cuts` make, with room for `places` measures to be in any order within one."""
    points = sorted(set(cuts)) or [0]
    whole: set[Rational] = set()
    for low, high in pairwise(points):
        first, last = floor(low) + 1, ceil(high) - 1
        whole.update(range(first, min(first + places, last + 1)))
        whole.update(range(max(last - places + 1, first), last + 1))
    whole.update(ceil(points[0]) - step for step in range(1, places + 1))
    whole.update(floor(points[-1]) + step for step in range(1, places + 1))
    if kind == "integer":
        return sorted(whole | {point for point in points if point == floor(point)})
    near = sorted({*whole, *points})
    between = (
        low + Fraction(high - low) * step / (places + 1)
        for low, high in pairwise(near)
        if places > 1 or not {low, high} & whole
        for step in range(1, places + 1)
    )
    return sorted({*near, *between})


def values_of(measure: Measure, formulas: Sequence[Formula]) -> tuple[Value, ...]:
    """Values for `measure` from every region that `formulas` distinguish."""
    if measure.kind == "scale":
        return measure.values
    group = clusters(formulas).get(measure.name, frozenset())
    return tuple(number_values(measure.kind, constants(formulas).get(measure.name, ()), max(1, len(group))))


def beside(measure: Measure, formulas: Sequence[Formula]) -> tuple[Rational, ...]:
    """Numbers just beside those that `measure` is compared with, in regions that `values_of` has: they tell whether
    something is rounded on the way to the rules."""
    if measure.kind != "number":
        return ()
    bounds = sorted(constants(formulas).get(measure.name, ()))
    return tuple(Fraction(bound) + side for bound in bounds for side in (-BESIDE, BESIDE))


def givens(
    formulas: Sequence[Formula], measures: Mapping[str, Measure], unreported: bool = True, near: bool = False
) -> list[ValueRegion]:
    """The names in `formulas`, with the values to try: triggers, conditions, then measures, each by name.

    Raises UnsupportedCalculations: values of single measures do not distinguish the results of calculations.

    `unreported` adds that a measure has no value, in which case whatever compares with it is false; `near` adds the
    numbers `beside` the bounds.
    """
    calculated = list(dict.fromkeys(one for formula in formulas for one in calculations_in(formula)))
    if calculated:
        raise unsupported(calculated, "a test of every context that the rules distinguish")
    atoms = {(leaf.kind, leaf.name) for f in formulas for leaf in leaves(f) if isinstance(leaf, Atom)}
    compared = sorted({name for comparison in _comparisons(formulas) for name in measures_of(comparison)})
    none: tuple[None, ...] = (None,) if unreported else ()
    return [
        *(ValueRegion(name, (False, True), event=True) for kind, name in sorted(atoms) if kind == "trigger"),
        *(ValueRegion(name, (False, True)) for kind, name in sorted(atoms) if kind == "condition"),
        *(
            ValueRegion(
                name, (*none, *values_of(measures[name], formulas), *(beside(measures[name], formulas) if near else ()))
            )
            for name in compared
        ),
    ]


def size(given: Sequence[ValueRegion]) -> int:
    """How many contexts there are over these values."""
    return prod(len(one.values) for one in given)


def contexts(given: Sequence[ValueRegion], triggers: frozenset[str]) -> Iterator[Context]:
    """Every context over these values, those with the fewest facts first, so that what fails first is smallest."""
    places = sorted(
        product(*(range(len(one.values)) for one in given)), key=lambda chosen: len(chosen) - chosen.count(0)
    )
    for chosen in places:
        yield context_of(given, [one.values[place] for one, place in zip(given, chosen)], triggers)


def context_of(given: Sequence[ValueRegion], chosen: Sequence[Value | None], triggers: frozenset[str]) -> Context:
    """The context of the values that are `chosen`, one of each, in which `triggers` occur in any case."""
    pairs = list(zip(given, chosen))
    occurring = (one.name for one, value in pairs if one.event and value)
    facts = {one.name: value for one, value in pairs if not one.event and value is not None}
    return Context(triggers.union(occurring), facts)
