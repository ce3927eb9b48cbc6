"""A report takes at most three times the processor time of a check, and its page has a bounded size."""

from __future__ import annotations

import pytest

from benchmarks.reporting import BOUND, MOST_BYTES, measure


@pytest.mark.speed
def test_a_report_of_200_rules_is_fast_and_small() -> None:
    check, report, size = measure(turns=3)
    assert report < BOUND * check
    assert 100_000 < size < MOST_BYTES
