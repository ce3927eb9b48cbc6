"""A person who answers `sleec-verify resolve`."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from sleec_verify.cli.commands import sleec_verify
from tests.support.fixes import TWO

Answer = Callable[..., Result]


@pytest.fixture
def answer(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Answer:
    """Runs `resolve` on a file with these lines as the input of a person."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("sleec_verify.cli.resolve.is_terminal", lambda: True)

    def call(*lines: str, text: str | bytes = TWO) -> Result:
        (tmp_path / "a.sleec").write_bytes(text.encode() if isinstance(text, str) else text)
        typed = "".join(f"{line}\n" for line in lines)
        return CliRunner().invoke(sleec_verify, ["resolve", "a.sleec"], input=typed, standalone_mode=False)

    return call


def left(tmp_path: Path) -> str:
    return (tmp_path / "a.sleec").read_bytes().decode()
