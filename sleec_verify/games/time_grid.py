"""The times that the instants of a play may have.

What rules say of times compares differences of times with the lengths of their windows. So only sums and differences of
these lengths count, and between two of them the order of the instants that lie there. A gap longer than any window is
as good as one a little longer than the longest.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterable
from math import gcd

from sleec_verify.encoding.solver import Undecided

MOST_SLOTS = 480
"""Times that are told apart before a question is given up."""


class TimeGrid:
    """The times, in seconds, that the instants of one play are chosen from."""

    def __init__(self, lengths: Iterable[int], instants: int, sums: int) -> None:
        """`lengths` are those that differences of times are compared with, in seconds; a play has as many `instants`,
        and the times of two of them have to do with each other by as many `sums`.

        Raises Undecided where more than `MOST_SLOTS` times would have to be told apart.
        """
        found = sorted({abs(length) for length in lengths} - {0})
        unit = gcd(*found) if found else 1
        # So many instants find room, in any order, between two multiples of the unit.
        fine = min(unit, max(4, instants))
        self._gap = (found[-1] // unit + 1) * unit if found else 1
        last = (instants - 1) * self._gap
        whole: Iterable[int] = range(0, last + 1, unit)
        if (last // unit + 1) * fine > MOST_SLOTS:
            whole = _sums([*found, self._gap], sums, last)
            if fine < instants:
                whole = {time + unit * more for time in whole for more in range(-instants, instants + 1)}
        self.wholes = [time for time in sorted(whole) if 0 <= time <= last]
        """The times that are such sums."""
        self.times = [time + unit * part // fine for time in self.wholes for part in range(fine)]
        if len(self.times) > MOST_SLOTS:
            raise Undecided(
                f"windows of lengths from {found[0]:,} to {found[-1]:,} seconds: with up to {instants} instants, more "
                f"than {MOST_SLOTS} times would have to be told apart"
            )

    def __len__(self) -> int:
        return len(self.times)

    def reach(self, earlier: int) -> int:
        """The last slot that an instant needs, of which there are so many `earlier` ones. So there is room after it for
        those that are still to come."""
        return self.up_to(earlier * self._gap) - 1

    def up_to(self, time: int) -> int:
        """How many slots are not after `time`."""
        return bisect_right(self.times, time)


def _sums(lengths: Iterable[int], terms: int, last: int) -> set[int]:
    """What up to so many of these lengths, added or taken away, come to, from 0 to `last`; no more than a few too many
    to use."""
    steps = {sign * length for length in lengths for sign in (1, -1)}
    found = fresh = {0}
    for _ in range(terms):
        fresh = {s for s in (a + b for a in fresh for b in steps) if -last <= s <= last} - found
        found = found | fresh
        if not fresh or len(found) > 2 * MOST_SLOTS:
            break
    return {time for time in found if time >= 0}
