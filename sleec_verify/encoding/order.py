"""Values of measures that are compared with constants and with each other, for a given order."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import lcm
from typing import NamedTuple

from sleec_runtime.model import Rational
from sleec_verify.encoding.budget import spend

_ZERO = ""
"""The node of the number 0. No measure has an empty name."""

_PER_EDGE = 0.4
"""Budget steps for one visit of one constraint."""


class _Edge(NamedTuple):
    """``target - source <= length``, if `literal` is true."""

    source: str
    target: str
    length: int
    literal: int


def place(
    integral: Mapping[str, bool],
    cuts: Sequence[tuple[str, Rational, bool, int]],
    orders: Sequence[tuple[str, str, int]],
) -> dict[str, Rational] | list[int]:
    """Values for the measures `integral` (name to whether it must be whole) that satisfy every given literal.

    A cut ``(x, c, inclusive, literal)`` says ``x < c`` (``x <= c`` if inclusive) if the literal is positive, and the
    opposite if it is negative. An order ``(x, y, literal)`` says ``x <= y`` or ``x > y`` likewise. Returns the literals
    of a minimal contradiction if there are no such values. Uses difference constraints: a strict bound between two
    whole numbers is a bound of 1, and any other is strict by a step that is small enough for all chains. O(n·m), and
    O(n·c²) for a contradiction with c constraints on a cycle; c is m in the worst case.
    """
    # Lengths are integer multiples of a small unit.
    unit = 2 * (len(integral) + 1) * lcm(*(value.denominator for _, value, _, _ in cuts))
    # Prefer whole steps if they fit. The small step decides.
    for step in (unit, 1):
        edges = _edges(integral, cuts, orders, unit, step)
        found = _potentials(integral, edges, unit)
        if isinstance(found, dict):
            return {name: _number(value, unit) for name, value in found.items()}
        needed = found
    if isinstance(_potentials(integral, needed, unit), dict):
        # With rounding, a cycle may converge.
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
    """The greatest values that satisfy every edge (Bellman and Ford, rounded where they must be whole). If there
    are none, a cycle on which they decreased, which is probably the reason."""
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
