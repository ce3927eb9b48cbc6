"""Values for orders of measures, beside a search over a grid."""

from __future__ import annotations

from fractions import Fraction
from itertools import product

from hypothesis import given, settings
from hypothesis import strategies as st

from sleec_verify.encoding.order import place
from sleec_verify.encoding.regions import Cut, pick_between

NAMES = ("x", "y", "z")


def holds(values, cuts, orders) -> bool:
    for name, limit, inclusive, literal in cuts:
        below = values[name] <= limit if inclusive else values[name] < limit
        if below != (literal > 0):
            return False
    return all((values[a] <= values[b]) == (literal > 0) for a, b, literal in orders)


def constraints():
    sign = st.sampled_from((1, -1))
    cut = st.tuples(st.sampled_from(NAMES), st.sampled_from((0, 1, Fraction(1, 2))), st.booleans(), sign)
    order = st.tuples(st.sampled_from(NAMES), st.sampled_from(NAMES), sign).filter(lambda t: t[0] != t[1])
    return st.tuples(
        st.fixed_dictionaries({name: st.booleans() for name in NAMES}),
        st.lists(cut, max_size=5),
        st.lists(order, max_size=5),
    )


@settings(max_examples=400, deadline=None)
@given(constraints())
def test_place_finds_values_or_a_true_contradiction(drawn):
    integral, cuts, orders = drawn
    cuts = [(name, limit, inclusive, sign * (i + 1)) for i, (name, limit, inclusive, sign) in enumerate(cuts)]
    orders = [(a, b, sign * (100 + i)) for i, (a, b, sign) in enumerate(orders)]
    grid = {
        name: range(-4, 6) if whole else [Fraction(n, 12) for n in range(-18, 31)] for name, whole in integral.items()
    }
    solvable = (
        any(holds(dict(zip(NAMES, values)), cuts, orders) for values in product(*(grid[name] for name in NAMES)))
        if len(cuts) + len(orders) <= 4
        else None
    )
    placed = place(integral, cuts, orders)
    if isinstance(placed, dict):
        assert holds(placed, cuts, orders)
        assert all(value.denominator == 1 for name, value in placed.items() if integral[name])
        assert solvable is not False
    else:
        assert not solvable
        kept = set(placed)
        part = [c for c in cuts if c[3] in kept], [o for o in orders if o[2] in kept]
        assert isinstance(place(integral, *part), list), "the contradiction is one by itself"


LIMITS = [
    None,
    *(Cut(value, inclusive) for value in (-1, 0, Fraction(1, 3), Fraction(1, 2), 18) for inclusive in (False, True)),
]


def test_a_value_between_two_cuts_lies_between_them():
    for low, high in product(LIMITS, LIMITS):
        if low is not None and high is not None and not low < high:
            continue
        value = pick_between(low, high)
        if low is not None:
            assert value > low.value if low.inclusive else value >= low.value
        if high is not None:
            assert value <= high.value if high.inclusive else value < high.value


def test_values_are_those_that_people_would_name():
    assert pick_between(None, Cut(18, False)) == 17
    assert pick_between(Cut(18, False), None) == 18
    assert pick_between(Cut(20, True), None) == 21
    assert pick_between(Cut(18, False), Cut(Fraction(37, 2), False)) == 18
    assert pick_between(Cut(18, True), Cut(19, False)) == Fraction(181, 10)
    assert pick_between(None, None) == 0
