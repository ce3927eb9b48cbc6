from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

import pytest

from sleec_verify.cli import run


class Ran(NamedTuple):
    code: int
    out: str
    err: str


Cli = Callable[..., Ran]


@pytest.fixture
def cli(capfd: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Cli:
    """Runs a command line in an empty folder, where `files` are written first."""
    monkeypatch.chdir(tmp_path)

    def call(*arguments: str, files: dict[str, str] | None = None) -> Ran:
        for name, text in (files or {}).items():
            path = tmp_path / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
        code = run(arguments)
        out, err = capfd.readouterr()
        return Ran(code, out, err)

    return call
