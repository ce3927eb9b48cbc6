"""Descriptive statistics of delays, and the comparison of two samples: Mann-Whitney U and Cliff's δ.

N. Cliff, Dominance statistics: Ordinal analyses to answer ordinal questions, Psychological Bulletin 114, 1993.
E. R. DeLong et al., Comparing the areas under two or more correlated ROC curves, Biometrics 44, 1988: the variance.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.stats import mannwhitneyu

NORMAL_QUANTILE = 1.959964
"""The 97.5th percentile of the standard normal distribution, for an interval of 95 %."""

Numbers = NDArray[np.float64]


class Summary(NamedTuple):
    """A sample in numbers, in its unit. `deviation` is the standard deviation of a sample (n - 1)."""

    size: int
    mean: float
    deviation: float
    minimum: float
    median: float
    p95: float
    p99: float
    maximum: float


class Comparison(NamedTuple):
    """Two samples compared.

    `u` and `p` are of the two-sided Mann-Whitney U test. `delta` is Cliff's δ: the probability that a value of the
    first sample is larger, minus the probability that it is smaller. `low` and `high` bound it with 95 % confidence.
    """

    u: float
    p: float
    delta: float
    low: float
    high: float


def summarise(sample: Sequence[float]) -> Summary:
    """The statistics of a sample of at least two values. Percentiles are interpolated linearly."""
    values = np.asarray(sample, dtype=float)
    p50, p95, p99 = (float(value) for value in np.percentile(values, (50, 95, 99)))
    deviation = float(values.std(ddof=1))
    return Summary(
        len(values), float(values.mean()), deviation, float(values.min()), p50, p95, p99, float(values.max())
    )


def compare(first: Sequence[float], second: Sequence[float]) -> Comparison:
    """Compares two independent samples of at least two values each."""
    one, other = np.asarray(first, dtype=float), np.asarray(second, dtype=float)
    test = mannwhitneyu(one, other, alternative="two-sided", method="asymptotic")
    delta = 2 * float(test.statistic) / (len(one) * len(other)) - 1
    variance = dominance(one, other).var(ddof=1) / len(one) + dominance(other, one).var(ddof=1) / len(other)
    margin = NORMAL_QUANTILE * float(variance) ** 0.5
    return Comparison(float(test.statistic), float(test.pvalue), delta, delta - margin, delta + margin)


def dominance(values: Numbers, others: Numbers) -> Numbers:
    """For each of `values`, the share of `others` that is smaller, minus the share that is larger."""
    ordered = np.sort(others)
    smaller = np.searchsorted(ordered, values, side="left")
    larger = len(ordered) - np.searchsorted(ordered, values, side="right")
    return np.asarray((smaller - larger) / len(ordered), dtype=float)
