"""The clock of nodes that write times."""

from __future__ import annotations

import threading
import time

import pytest

from sleec_runtime.ros.monitoring.wall_clock import WallClock


def test_it_counts_seconds_since_1970_with_alarms() -> None:
    clock = WallClock()
    before, rang = clock.now(), threading.Event()
    assert abs(float(before) - time.time()) < 20
    clock.wake(before + 0.01, rang.set)
    assert rang.wait(20)
    assert clock.now() >= before + 0.01


def test_a_correction_of_the_wall_clock_does_not_change_durations(monkeypatch: pytest.MonkeyPatch) -> None:
    clock = WallClock()
    before = clock.now()
    monkeypatch.setattr(time, "time", lambda: 0.0)
    assert 0 <= clock.now() - before < 60
