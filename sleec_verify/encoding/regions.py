"""Regions of a measure: the ranges of values that comparisons with constants distinguish."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from sleec_runtime.model import Measure, Rational

if TYPE_CHECKING:
    from fractions import Fraction


class Cut(NamedTuple):
    """The variable of ``measure < value``, or of ``measure <= value`` if `inclusive`. For a scale, the value is a
    rank."""

    value: Rational
    inclusive: bool


def pick_between(low: Cut | None, high: Cut | None) -> Rational:
    """A number not below `low` and below `high`, whole and near a bound if possible: 17 for "below 18"."""
    from math import ceil, floor

    if low is None and high is None:
        return 0
    if low is None:
        assert high is not None
        return floor(high.value) if high.inclusive or floor(high.value) < high.value else floor(high.value) - 1
    # Not below `value < c` means at least c; not below `value <= c` means more than c.
    whole = floor(low.value) + 1 if low.inclusive else ceil(low.value)
    if high is None or whole < high.value or (high.inclusive and whole == high.value):
        return whole
    if low.value == high.value:
        return low.value
    from fractions import Fraction

    return _shortest_decimal(Fraction(low.value), Fraction(high.value))


def _shortest_decimal(low: Fraction, high: Fraction) -> Fraction:
    from fractions import Fraction
    from math import floor

    scale = 10
    while True:
        candidate = Fraction(floor(low * scale) + 1, scale)
        if candidate < high:
            return candidate
        scale *= 10


def cut_at(measure: Measure, value: Rational, inclusive: bool) -> Cut:
    """The cut of ``measure < value`` (``<=`` if inclusive). Cuts that no whole number distinguishes are the same."""
    if measure.kind != "integer":
        return Cut(value, inclusive)
    from math import ceil, floor

    return Cut(floor(value) if inclusive else ceil(value) - 1, True)


def cut_text(measure: Measure, cut: Cut) -> str:
    limit = measure.values[int(cut.value)] if measure.kind == "scale" else str(cut.value)
    return f"{'<=' if cut.inclusive else '<'} {limit}"
