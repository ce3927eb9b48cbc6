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
    literals of a minimal contradiction if there are no such values. Difference constraints: a strict bound between two
    whole numbers is one of at least 1, any other is strict by a step small enough for all chains. O(n·m), and O(n·m²)
    for a contradiction.
    """
    from fractions import Fraction

    fine = Fraction(1, 2 * (len(integral) + 1))
    for _, value, _, _ in cuts:
        fine /= Fraction(value).denominator
    # Whole steps read better where they fit; the fine one decides.
    for step in (Fraction(1), fine):
        edges = _edges(integral, cuts, orders, step)
        values = _potentials(integral, edges)
        if values is not None:
            return values
    needed = edges
    for edge in edges:
        without = [kept for kept in needed if kept is not edge]
        if _potentials(integral, without) is None:
            needed = without
    return [literal for *_, literal in needed]


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
    integral: Mapping[str, bool], edges: Sequence[tuple[str, str, Fraction, int]]
) -> dict[str, Rational] | None:
    """The greatest values that keep every edge, or None where there are none (Bellman-Ford, whole where they must)."""
    from fractions import Fraction
    from math import floor

    whole = {**integral, _ZERO: True}
    distance = dict.fromkeys(whole, Fraction(0))
    # A shortest walk repeats a node at most once: a number may be lowered again through a whole one.
    for _ in range(2 * len(whole) + 1):
        changed = False
        for x, y, weight, _literal in edges:
            bound = distance[x] + weight
            if whole[y]:
                bound = Fraction(floor(bound))
            if bound < distance[y]:
                distance[y] = bound
                changed = True
        if not changed:
            values = {name: distance[name] - distance[_ZERO] for name in integral}
            return {name: int(v) if v.denominator == 1 else v for name, v in values.items()}
    return None
