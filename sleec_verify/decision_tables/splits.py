"""The values of one variable of several numbers, as values of each number and of each order of two of them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

from sleec_verify.changes.diagram.formulas import FormulaDiagram
from sleec_verify.changes.diagram.variables import Variable


class Cell(NamedTuple):
    """The value or values of a variable, by their numbers: each of them leads to the same decision. An order of two
    measures is a variable, too: its values 0, 1 and 2 are less, equal and greater."""

    variable: Variable
    values: tuple[int, ...]


Split = tuple[tuple[tuple[Cell, ...], int], ...]
"""Cells, with the group of values that they lead to."""

_Aspect = tuple[Variable, Sequence[int]]
"""A variable, and its value for each value of the variable of several numbers."""


def split(diagram: FormulaDiagram, number: int, groups: Mapping[int, int]) -> Split:
    """Rows of cells that part the values of a variable into groups. `groups` has the group of each possible value."""
    variable = diagram.variables[number]
    if variable.orders:
        return _parted(tuple(groups), list(_aspects(variable, diagram.combinations(number))), groups)
    return _parted(tuple(groups), [(variable, range(variable.ways))], groups)


def _aspects(variable: Variable, combinations: Sequence[tuple[tuple[int, ...], tuple[int, ...]]]) -> Iterator[_Aspect]:
    """The orders first, because rules are about these."""
    for at, (one, other) in enumerate(variable.orders):
        names = (("condition", one), ("condition", other))
        order = Variable(names, 3, orders=((one, other),))
        yield order, [signs[at] + 1 for _, signs in combinations]
    for at, (name, cuts) in enumerate(variable.cuts):
        if cuts:
            yield (
                Variable((("condition", name),), len(cuts) + 1, ((name, cuts),)),
                [regions[at] for regions, _ in combinations],
            )


def _parted(values: Sequence[int], aspects: Sequence[_Aspect], groups: Mapping[int, int]) -> Split:
    first, *others = values
    if all(groups[one] == groups[first] for one in others):
        return (((), groups[first]),)
    (variable, aspect), *rest = aspects
    below: dict[Split, list[int]] = {}
    for at in sorted({aspect[value] for value in values}):
        below.setdefault(_parted([value for value in values if aspect[value] == at], rest, groups), []).append(at)
    if len(below) == 1:
        return next(iter(below))
    return tuple(
        ((Cell(variable, tuple(found)), *cells), group) for part, found in below.items() for cells, group in part
    )
