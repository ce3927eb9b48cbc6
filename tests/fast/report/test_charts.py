"""The chart of a timeline says what its legend says: of every second, whether an event occurs, is due, is forbidden."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import groupby, permutations, product

import pytest
from hypothesis import given
from hypothesis import strategies as st

from sleec_verify.report.timeline import chart_of
from sleec_verify.results.timeline import Due, Moment, Timeline

LATE = 100
"""Later than all that the tests speak of."""

CALLED_FOR, FORBIDDEN = False, True


def demand(negated: bool, start: int, end: int | None) -> Due:
    return Due("R1", 0, "", "Ring", negated, start, end)


def timeline(
    dues: Iterable[Due], times: Sequence[int] = (0,), rings: Iterable[int] = (), now: int | None = None
) -> Timeline:
    """Called occurs at the first moment, where all is called for; Ring at `rings`."""
    moments = []
    for time in times:
        events = (*(["Called"] if time == times[0] else []), *(["Ring"] if time in rings else []))
        moments.append(Moment(time, events, {}, (), tuple(dues) if time == times[0] else ()))
    return Timeline(tuple(moments), now)


def row(shown: Timeline, event: str = "Ring") -> str:
    """What the chart says of an event, without its name."""
    (line,) = [line for line in chart_of(shown)[1:] if line.split()[0] == event]
    label = max(len(line.split()[0]) for line in chart_of(shown)[1:])
    return line[label + 2 :]


@pytest.mark.parametrize("now", [None, 0])
@pytest.mark.parametrize(
    ("kinds", "mark"),
    [
        ((CALLED_FOR,), "-"),
        ((FORBIDDEN,), "x"),
        ((CALLED_FOR, FORBIDDEN), "!"),
        ((FORBIDDEN, CALLED_FOR), "!"),
    ],
)
def test_what_is_so_at_one_instant_is_marked_there(kinds, mark, now):
    assert row(timeline([demand(kind, 0, 0) for kind in kinds], now=now)) == mark


@pytest.mark.parametrize("now", [None, 0])
@pytest.mark.parametrize(
    ("kinds", "mark"), [((), "*"), ((CALLED_FOR,), "*"), ((FORBIDDEN,), "!"), ((CALLED_FOR, FORBIDDEN), "!")]
)
def test_what_occurs_though_it_is_forbidden_is_marked_as_both(kinds, mark, now):
    assert row(timeline([demand(kind, 0, 0) for kind in kinds], rings=[0], now=now)) == mark


@pytest.mark.parametrize("end", [60, None])
@pytest.mark.parametrize("now", [None, 0])
def test_what_goes_on_past_the_last_moment_is_marked_as_long_as_it_holds(end, now):
    for kinds, mark in [((CALLED_FOR,), "-"), ((FORBIDDEN,), "x"), ((CALLED_FOR, FORBIDDEN), "!")]:
        for ordered in permutations(kinds):
            said = row(timeline([demand(kind, 0, end) for kind in ordered], now=now))
            assert (set(said[:-1]), said[-1]) == ({mark}, ">")


def test_windows_that_end_one_after_the_other():
    due, forbidden = demand(CALLED_FOR, 0, 60), demand(FORBIDDEN, 0, 600)
    assert row(timeline([due, forbidden], now=0)) == row(timeline([forbidden, due], now=0)) == "!!!!xxx>"
    assert row(timeline([due, forbidden], [0, 60, 600], now=2)) == "!" * 13 + "x" * 12


def test_what_was_called_for_is_due_until_it_is_done():
    assert row(timeline([demand(CALLED_FOR, 0, 60)], [0, 30, 60], rings=[30])) == "--------*"
    assert row(timeline([demand(CALLED_FOR, 0, None)], [0, 30], rings=[30])) == "--------*"
    # What is not done, and has something else in its place, was due to the end.
    assert row(timeline([demand(CALLED_FOR, 0, 60)], [0, 60, 120])) == "---------"
    # What is done too early leaves it due.
    assert row(timeline([demand(CALLED_FOR, 30, 60)], [0, 60], rings=[0])) == "*    ----"


def as_it_is(dues: Sequence[Due], rings: Sequence[int], time: int) -> str:
    """What the legend says of one second."""
    forbidden = any(d.negated and d.start <= time and (d.end is None or time <= d.end) for d in dues)
    due = any(
        not d.negated
        and d.start <= time
        and (d.end is None or time <= d.end)
        and not any(d.start <= rung < time for rung in rings)
        for d in dues
    )
    if forbidden and (due or time in rings):
        return "!"
    return "*" if time in rings else "x" if forbidden else "-" if due else " "


WINDOWS = [(start, end) for start in range(4) for end in (*range(start, 6), None)]
DEMANDS = st.builds(lambda negated, window: demand(negated, *window), st.booleans(), st.sampled_from(WINDOWS))


@given(
    st.lists(DEMANDS, max_size=4),
    st.sets(st.integers(1, 8), max_size=3).map(lambda later: [0, *sorted(later)]),
    st.data(),
)
def test_every_stretch_has_its_mark(dues, times, data):
    rings = data.draw(st.lists(st.sampled_from(times), unique=True))
    if not dues and not rings:
        return
    shown = timeline(dues, times, rings, now=data.draw(st.sampled_from([None, len(times) - 1])))
    assert row(shown) == row(timeline(dues[::-1], times, rings, shown.now))
    heads = chart_of(shown)[0]
    label = len("Called") + 2
    starts, place = [], label
    for time in times:
        place = heads.index(f"{time} s", place)
        starts.append(place - label)
    said = row(shown).ljust(starts[-1] + 1)
    for time, start, behind, next_start in zip(times, starts, [*times[1:], LATE], [*starts[1:], None]):
        assert said[start] == as_it_is(dues, rings, time)
        seconds = [as_it_is(dues, rings, second) for second in range(time + 1, behind)]
        changes = "".join(mark for mark, _ in groupby(seconds))
        if next_start is None:
            assert said.endswith(">") == bool(changes.strip())
            assert squeezed(said[start + 1 :].rstrip(">")) == (changes.rstrip() or "")
        else:
            assert squeezed(said[start + 1 : next_start]) == (changes or " ")


def squeezed(marks: str) -> str:
    return "".join(mark for mark, _ in groupby(marks))


def test_every_pair_of_windows_in_either_order():
    for one, other in product(product((CALLED_FOR, FORBIDDEN), WINDOWS), repeat=2):
        dues = [demand(kind, *window) for kind, window in (one, other)]
        said = row(timeline(dues, now=0))
        assert said == row(timeline(dues[::-1], now=0))
        marks = "".join(as_it_is(dues, (), second) for second in range(LATE))
        assert said[0] == marks[0]
        assert squeezed(said[1:].rstrip(">")) == squeezed(marks[1:]).rstrip()
