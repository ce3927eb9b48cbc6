"""Numbers for an order: values of measures that are compared with constants and with one another."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import lcm
from typing import NamedTuple

from sleec_runtime.model import Rational
from sleec_verify.encoding.budget import spend

_ZERO = ""
"""The node that stands for the number 0; no measure has an empty name."""

_PER_EDGE = 0.4
"""Steps of a budget to look at one constraint once."""


class _Edge(NamedTuple):
    """``target - source <= length``, as `literal` says."""

    source: str
    target: str
    length: int
    literal: int


def place(
    integral: Mapping[str, bool],
    cuts: Sequence[tuple[str, Rational, bool, int]],
    orders: Sequence[tuple[str, str, int]],
) -> dict[str, Rational] | list[int]:
    """Values for the measures `integral` (name to whether it must be whole) that satisfy every literal given.

    A cut ``(x, c, inclusive, literal)`` says ``x < c`` (``x <= c`` if inclusive) where the literal is positive and the
    opposite where it is negative; an order ``(x, y, literal)`` says ``x <= y`` or ``x > y`` likewise. Returns the
    literals of a minimal contradiction if there are no such values. Difference constraints: a strict bound between two
    whole numbers is one of at least 1, any other is strict by a step small enough for all chains. O(n·m), and O(n·c²)
    for a contradiction, with c constraints on a cycle; c is m in the worst case.
    """
    # Lengths are counted in units so fine that each is a whole number of them.
    unit = 2 * (len(integral) + 1) * lcm(*(value.denominator for _, value, _, _ in cuts))
    # Whole steps read better where they fit; the fine one decides.
    for step in (unit, 1):
        edges = _edges(integral, cuts, orders, unit, step)
        found = _potentials(integral, edges, unit)
        if isinstance(found, dict):
            return {name: _number(value, unit) for name, value in found.items()}
        needed = found
    if isinstance(_potentials(integral, needed, unit), dict):
        # Where numbers are made whole on the way, a cycle may come to rest.
        needed = edges
    for edge in tuple(needed):
        without = [kept for kept in needed if kept is not edge]
        if isinstance(_potentials(integral, without, unit), list):
            needed = without
    return [edge.literal for edge in needed]


def _number(value: int, unit: int) -> Rational:
    if value % unit == 0:
        return value // unit
    from fractions import Fraction

    return Fraction(value, unit)


def _edges(
    integral: Mapping[str, bool],
    cuts: Sequence[tuple[str, Rational, bool, int]],
    orders: Sequence[tuple[str, str, int]],
    unit: int,
    step: int,
) -> list[_Edge]:
    edges = []
    for x, value, inclusive, literal in cuts:
        bound = int(value * unit)
        if literal > 0:
            edges.append(_Edge(_ZERO, x, bound if inclusive else bound - step, literal))
        else:
            edges.append(_Edge(x, _ZERO, -(bound + step if inclusive else bound), literal))
    for x, y, literal in orders:
        if literal > 0:
            edges.append(_Edge(y, x, 0, literal))
        else:
            edges.append(_Edge(x, y, -(unit if integral[x] and integral[y] else step), literal))
    return edges


def _potentials(integral: Mapping[str, bool], edges: Sequence[_Edge], unit: int) -> dict[str, int] | list[_Edge]:
    """The greatest values that keep every edge (Bellman and Ford, made whole where they must be); if there are none, a
    cycle on which they fell, which is most likely why."""
    whole = {**integral, _ZERO: True}
    distance = dict.fromkeys(whole, 0)
    by: dict[str, _Edge] = {}
    # A shortest walk repeats a node at most once: a number may be lowered again through a whole one.
    for _ in range(2 * len(whole) + 1):
        spend(_PER_EDGE * len(edges))
        lowered = ""
        changed = False
        for edge in edges:
            source, target, length, _literal = edge
            bound = distance[source] + length
            if whole[target]:
                bound -= bound % unit
            if bound < distance[target]:
                distance[target] = bound
                by[target] = edge
                lowered, changed = target, True
        if not changed:
            return {name: distance[name] - distance[_ZERO] for name in integral}
    for _ in whole:
        lowered = by[lowered].source
    cycle = [by[lowered]]
    while cycle[-1].source != lowered:
        cycle.append(by[cycle[-1].source])
    return cycle
