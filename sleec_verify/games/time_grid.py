"""The times that the instants of a play may have.

Rules compare differences of times with the lengths of their windows. So only sums and differences of these lengths
matter, and the order of instants between two such sums. A gap that is longer than every window is equivalent to one
that is slightly longer than the longest window.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterable
from math import gcd

from sleec_verify.encoding.solver import Undecided
from sleec_verify.wording.phrases import grouped
from sleec_verify.wording.sentence import sentence

MOST_SLOTS = 480
"""The maximal number of distinct times of a question."""


class TimeGrid:
    """The times, in seconds, from which the instants of a play are chosen."""

    def __init__(self, lengths: Iterable[int], instants: int, sums: int) -> None:
        """`lengths` are those with which differences of times are compared, in seconds. A play has `instants` instants.
        The times of two of them are related by at most `sums` lengths.

        Raises `Undecided` if there are more than `MOST_SLOTS` times.
        """
        found = sorted({abs(length) for length in lengths} - {0})
        unit = gcd(*found) if found else 1
        # This many instants fit, in any order, between two multiples of the unit.
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
                sentence(
                    "windows with lengths from {shortest} to {longest} seconds have more than {limit} distinct times "
                    "with up to {instants} instants",
                    shortest=grouped(found[0]),
                    longest=grouped(found[-1]),
                    limit=MOST_SLOTS,
                    instants=instants,
                )
            )

    def __len__(self) -> int:
        return len(self.times)

    def reach(self, earlier: int) -> int:
        """The last slot that an instant needs if `earlier` instants precede it. It leaves room for the later ones."""
        return self.up_to(earlier * self._gap) - 1

    def up_to(self, time: int) -> int:
        """The number of slots at or before `time`."""
        return bisect_right(self.times, time)


def _sums(lengths: Iterable[int], terms: int, last: int) -> set[int]:
    """The sums and differences of up to `terms` of these lengths, from 0 to `last`. Stops soon after there are too
    many."""
    steps = {sign * length for length in lengths for sign in (1, -1)}
    found = fresh = {0}
    for _ in range(terms):
        fresh = {s for s in (a + b for a in fresh for b in steps) if -last <= s <= last} - found
        found = found | fresh
        if not fresh or len(found) > 2 * MOST_SLOTS:
            break
    return {time for time in found if time >= 0}
