"""Local search: values for measures in calculations, found by changing one measure after the other. If it succeeds,
z3 is not needed, and the values are small."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from math import ceil, floor

from sleec_runtime.model import Calculation, Rational
from sleec_verify.encoding.arithmetic import Compared

_STEPS = 8
"""The maximal number of changes for each calculation."""


class _Range:
    """Whole numbers from `low` to `high`. None means unbounded."""

    def __init__(self) -> None:
        self.low: int | None = None
        self.high: int | None = None

    def cut(self, value: Rational, inclusive: bool, literal: int) -> None:
        """Keep the values that are at most `value` (below it if not `inclusive`), or the others if the literal is
        negative."""
        if literal > 0:
            high = floor(value) if inclusive else ceil(value) - 1
            self.high = high if self.high is None else min(self.high, high)
        else:
            low = floor(value) + 1 if inclusive else ceil(value)
            self.low = low if self.low is None else max(self.low, low)

    def nearest(self, number: int) -> int:
        if self.low is not None and number < self.low:
            return self.low
        return self.high if self.high is not None and number > self.high else number


def search_nearby(
    values: Mapping[str, Rational],
    cuts: Iterable[tuple[str, Rational, bool, int]],
    orders: Sequence[tuple[str, str, int]],
    compared: Iterable[Compared],
) -> dict[str, Rational] | None:
    """Whole numbers near the whole numbers `values` that make all the literals of `arithmetic.values_for` true.
    None if the search finds none, which proves nothing. O(calculations²)."""
    found = {name: int(value) for name, value in values.items()}
    allowed = {name: _Range() for name in found}
    for name, value, inclusive, literal in cuts:
        allowed[name].cut(value, inclusive, literal)
    wanted: dict[Calculation, _Range] = {}
    for one, value, inclusive, literal in compared:
        wanted.setdefault(one, _Range()).cut(value, inclusive, literal)
    for _ in range(_STEPS * len(wanted)):
        amiss = next((one for one in wanted if _missing(one, wanted[one], found)), None)
        if amiss is None:
            kept = all((found[x] <= found[y]) == (literal > 0) for x, y, literal in orders)
            kept = kept and all(allowed[name].nearest(value) == value for name, value in found.items())
            return dict(found) if kept else None
        if not _moved(amiss, wanted[amiss], allowed, found):
            return None
    return None


def _missing(one: Calculation, wanted: _Range, found: Mapping[str, int]) -> int:
    """By how much the result of a calculation must change."""
    result = int(one.value(found))
    return wanted.nearest(result) - result


def _moved(one: Calculation, wanted: _Range, allowed: Mapping[str, _Range], found: dict[str, int]) -> bool:
    """Change a measure so that the calculation has the wanted result; otherwise the first measure that brings it
    closer, or any. Returns whether there is one."""
    missing = _missing(one, wanted, found)
    nearer: tuple[str, int] | None = None
    for name in one.measures:
        slope = int(one.value({**found, name: found[name] + 1})) - int(one.value(found))
        if slope == 0:
            continue
        # Round away from 0, so that the step is large enough.
        steps = -(-abs(missing) // abs(slope)) * (1 if (missing > 0) == (slope > 0) else -1)
        moved = allowed[name].nearest(found[name] + steps)
        after = abs(_missing(one, wanted, {**found, name: moved}))
        if after == 0:
            found[name] = moved
            return True
        if nearer is None and after < abs(missing):
            nearer = name, moved
    if nearer is None:
        # The product stays 0 for both factors.
        moves = ((name, allowed[name].nearest(found[name] + step)) for name in one.measures for step in (1, -1))
        nearer = next(((name, moved) for name, moved in moves if moved != found[name]), None)
    if nearer is not None:
        found[nearer[0]] = nearer[1]
    return nearer is not None
