"""A cache in a folder of its own."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from sleec_verify.checks import run_checks
from sleec_verify.results.finding import CheckResult


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The folder of a cache that is in use, and empty."""
    kept = tmp_path / "kept"
    monkeypatch.setenv("SLEEC_VERIFY_CACHE", str(kept))
    return kept


@pytest.fixture
def solves(monkeypatch: pytest.MonkeyPatch) -> Callable[[], int]:
    """How often rules were checked since it was asked last."""
    calls: list[None] = []

    def counted(*arguments: object, **named: object) -> tuple[CheckResult, ...]:
        calls.append(None)
        return run_checks(*arguments, **named)  # type: ignore[arg-type]

    monkeypatch.setattr("sleec_verify.checks.run_checks", counted)

    def since() -> int:
        number = len(calls)
        calls.clear()
        return number

    return since
