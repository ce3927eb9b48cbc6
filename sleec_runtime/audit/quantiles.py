"""Quantiles of a stream in bounded memory: the sketch DDSketch.

Source: C. Masson, J. E. Rim, H. K. Lee, DDSketch: a fast and fully-mergeable quantile sketch with relative-error
guarantees, PVLDB 12(12), 2019.
"""

from __future__ import annotations

from collections import Counter
from math import ceil, log

ERROR = 0.01
"""The relative error of a quantile. The minimum and the maximum are exact."""

_GAMMA = (1 + ERROR) / (1 - ERROR)
_LEAST = 1e-9
"""Smaller values count as 0."""


class Quantiles:
    """The quantiles of numbers from 0 on. Sketches of parts of a stream can be added."""

    def __init__(self) -> None:
        self.buckets: Counter[int | None] = Counter()
        self.least: float | None = None
        self.greatest: float | None = None

    @property
    def count(self) -> int:
        """How many numbers there are."""
        return sum(self.buckets.values())

    def insert(self, value: float) -> None:
        """Adds a number."""
        self.buckets[ceil(log(value, _GAMMA)) if value >= _LEAST else None] += 1
        self._extend(value)

    def add(self, other: Quantiles) -> None:
        """Adds the numbers of another sketch."""
        self.buckets.update(other.buckets)
        for value in (other.least, other.greatest):
            if value is not None:
                self._extend(value)

    def quantile(self, share: float) -> float:
        """The number below which this share of the numbers is. Raises ValueError if there are none."""
        if self.least is None or self.greatest is None:
            raise ValueError("there are no numbers")
        rank = share * (self.count - 1)
        seen = 0
        for bucket in sorted(self.buckets, key=lambda bucket: (bucket is not None, bucket)):
            seen += self.buckets[bucket]
            if seen > rank:
                middle = 0.0 if bucket is None else 2 * _GAMMA**bucket / (_GAMMA + 1)
                return min(max(middle, self.least), self.greatest)
        return self.greatest

    def _extend(self, value: float) -> None:
        self.least = value if self.least is None else min(self.least, value)
        self.greatest = value if self.greatest is None else max(self.greatest, value)
