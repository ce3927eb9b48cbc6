"""The bounds of the benchmark, in a short run of it. Ratios of medians taken in turns, so a busy machine does not
matter."""

from __future__ import annotations

import pytest

from benchmarks import runtime_dispatch


@pytest.mark.parametrize(
    ("part", "rounds"),
    [
        (runtime_dispatch.by_size, 60),
        (runtime_dispatch.against_global_activation, 60),
        (runtime_dispatch.changes, 80),
    ],
)
def test_the_bounds_are_kept(part, rounds: int) -> None:
    _, bounds = part(rounds)
    assert bounds
    assert [bound for bound in bounds if not bound.kept] == []
