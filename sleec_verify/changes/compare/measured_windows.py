"""The order of literals whose windows have lengths that measures give: the situations in which one requires more."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import groupby
from math import prod

from sleec_runtime.model import Comparison, Formula, MeasureRef, Number, Obligation, Truth, Value
from sleec_verify.changes.compare.timing_order import implies
from sleec_verify.encoding.equation import conjunction, disjunction
from sleec_verify.encoding.measure_ranges import MeasureRanges
from sleec_verify.encoding.trace_scope import Untimed
from sleec_verify.encoding.window_lengths import MOST_VALUES, lengths_of, with_value


def implied_where(one: Obligation, other: Obligation, untimed: Untimed, ranges: MeasureRanges) -> Formula | None:
    """The situations in which meeting `one` meets `other`; None if that is unknown."""
    names = [] if one == other else sorted({*_measures(one), *_measures(other)})
    values: list[range] = []
    for name in names:
        least, greatest = ranges.bounds(name)
        if least is None or greatest is None:
            return _where(one, other, untimed, (), ())
        values.append(range(least, max(least, greatest) + 1))
    if prod(map(len, values)) > MOST_VALUES:
        names = []
    return _where(one, other, untimed, names, values)


def in_context(obligation: Obligation, conditions: Mapping[str, Value]) -> Obligation:
    """The obligation with the values of a situation in the lengths of its windows."""
    for name in _measures(obligation):
        value = conditions.get(name)
        if isinstance(value, int):
            obligation = with_value(obligation, name, value)
    return obligation


def _measures(obligation: Obligation) -> Iterator[str]:
    return (name for length in lengths_of(obligation) for name in length.measures)


def _where(
    one: Obligation, other: Obligation, untimed: Untimed, names: Sequence[str], values: Sequence[range]
) -> Formula | None:
    if not names:
        follows = implies(one, other, untimed)
        return None if follows is None else Truth(follows)
    name, own = names[0], values[0]
    found = [
        _where(with_value(one, name, value), with_value(other, name, value), untimed, names[1:], values[1:])
        for value in own
    ]
    parts = []
    # Neighboring values with the same answer become one interval.
    for where, group in groupby(zip(own, found), key=lambda entry: entry[1]):
        interval = [value for value, _ in group]
        if where is None:
            return None
        if where != Truth(False):
            measure = MeasureRef(name)
            lower = [Comparison(measure, ">=", Number(interval[0]))] if interval[0] != own[0] else []
            upper = [Comparison(measure, "<=", Number(interval[-1]))] if interval[-1] != own[-1] else []
            parts.append(conjunction([where, *lower, *upper]))
    return disjunction(parts)
