"""Numbers for an order: values of measures that are compared with constants and with one another."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

from sleec_runtime.model import Rational

if TYPE_CHECKING:
    from fractions import Fraction

_ZERO = ""
"""The node that stands for the number 0; no measure has an empty name."""


def place(
    integral: Mapping[str, bool],
    cuts: Sequence[tuple[str, Rational, bool, int]],
    orders: Sequence[tuple[str, str, int]],
) -> dict[str, Rational] | list[int]:
    """Values for the measures `integral` (name to whether it must be whole) that satisfy every literal given.

    A cut ``(x, c, inclusive, literal)`` says ``x < c`` (``x <= c`` if inclusive) where the literal is positive and the
    opposite where it is negative; an order ``(x, y, literal)`` says ``x <= y`` or ``x > y`` likewise. Returns the
    literals of a contradiction if there are no such values. Difference constraints by Bellman-Ford, O(n·m): a strict
    bound between two whole numbers is tightened to whole, any other is strict by a step small enough for all chains.
    """
    from fractions import Fraction

    fine = Fraction(1, 2 * (len(integral) + 1))
    for _, value, _, _ in cuts:
        fine /= Fraction(value).denominator
    # Whole steps read better where they fit; the fine one decides.
    placed = _potentials(integral, _edges(integral, cuts, orders, Fraction(1)))
    return placed if isinstance(placed, dict) else _potentials(integral, _edges(integral, cuts, orders, fine))


def _edges(
    integral: Mapping[str, bool],
    cuts: Sequence[tuple[str, Rational, bool, int]],
    orders: Sequence[tuple[str, str, int]],
    step: Fraction,
) -> list[tuple[str, str, Fraction, int]]:
    """The constraints as ``(x, y, w, literal)``: y - x <= w."""
    from fractions import Fraction

    edges = []
    for x, value, inclusive, literal in cuts:
        bound = Fraction(value)
        if literal > 0:
            edges.append((_ZERO, x, bound if inclusive else bound - step, literal))
        else:
            edges.append((x, _ZERO, -(bound + step if inclusive else bound), literal))
    for x, y, literal in orders:
        if literal > 0:
            edges.append((y, x, Fraction(0), literal))
        else:
            strict = Fraction(1) if integral[x] and integral[y] else step
            edges.append((x, y, -strict, literal))
    return edges


def _potentials(
    integral: Mapping[str, bool], edges: list[tuple[str, str, Fraction, int]]
) -> dict[str, Rational] | list[int]:
    from fractions import Fraction
    from math import floor

    whole = {**integral, _ZERO: True}
    distance = dict.fromkeys(whole, Fraction(0))
    reached_by: dict[str, tuple[str, int]] = {}
    changed = None
    # A shortest walk repeats a node at most once: a number may be lowered again through a whole one.
    for _ in range(2 * len(whole) + 1):
        changed = None
        for x, y, weight, literal in edges:
            bound = distance[x] + weight
            if whole[y]:
                bound = Fraction(floor(bound))
            if bound < distance[y]:
                distance[y] = bound
                reached_by[y] = (x, literal)
                changed = y
        if changed is None:
            values = {name: distance[name] - distance[_ZERO] for name in integral}
            return {name: int(v) if v.denominator == 1 else v for name, v in values.items()}
    assert changed is not None
    node = changed
    for _ in whole:
        node = reached_by[node][0]
    start, literals = node, []
    while True:
        node, literal = reached_by[node]
        literals.append(literal)
        if node == start:
            return literals
