"""The statistics of the evaluation, compared with values that were computed by hand."""

from __future__ import annotations

import pytest

pytest.importorskip("scipy", reason="`make evaluation` installs scipy (requirements/evaluation.lock)")

from benchmarks.evaluation.statistics import compare, summarise  # after the check that scipy is there


def test_summary_by_hand() -> None:
    summary = summarise([4.0, 1.0, 3.0, 2.0, 10.0])
    assert summary.size == 5
    assert summary.mean == 4
    assert summary.deviation == pytest.approx(12.5**0.5)  # (0 + 9 + 1 + 4 + 36) / 4
    assert (summary.minimum, summary.median, summary.maximum) == (1, 3, 10)
    assert summary.p95 == pytest.approx(8.8)  # 0.95 * 4 = 3.8: four fifths of the way from 4 to 10
    assert summary.p99 == pytest.approx(9.76)


def test_cliffs_delta_by_hand() -> None:
    # Of nine pairs, 1 is larger in four cases and smaller in three, and two are ties.
    comparison = compare([1.0, 3.0, 5.0], [1.0, 2.0, 5.0])
    assert comparison.u == 5  # a tie counts a half
    assert comparison.delta == pytest.approx((4 - 3) / 9)


def test_separate_samples_have_the_largest_effect() -> None:
    larger = compare([7.0, 8.0, 9.0], [1.0, 2.0, 3.0])
    assert (larger.u, larger.delta, larger.low, larger.high) == (9, 1, 1, 1)
    assert compare([1.0, 2.0, 3.0], [7.0, 8.0, 9.0]).delta == -1


def test_p_value_and_interval_by_hand() -> None:
    # U is 2 + 3 + 4 + 5 + 5. 12.5 is expected, with the variance 25 * 11 / 12. With the correction for continuity,
    # z = (19 - 12.5 - 0.5) / 4.787 = 1.2534, and the two tails have p = 0.2101.
    comparison = compare([3.0, 5.0, 7.0, 9.0, 10.0], [1.0, 2.0, 4.0, 6.0, 8.0])
    assert comparison.u == 19
    assert comparison.delta == pytest.approx(19 / 25 * 2 - 1)
    assert comparison.p == pytest.approx(0.2101, abs=1e-4)
    assert comparison.low < 0 < comparison.high


def test_equal_samples_do_not_differ() -> None:
    comparison = compare([1.0, 2.0, 3.0, 4.0], [1.0, 2.0, 3.0, 4.0])
    assert (comparison.delta, comparison.p) == (0, 1)
    assert comparison.low == -comparison.high
