"""A job for tests of the action."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.project.action import Runner


@pytest.fixture
def runner(tmp_path: Path) -> Runner:
    job = Runner(tmp_path / "checkout", tmp_path / "temp")
    job.checkout.mkdir()
    job.temp.mkdir()
    return job
