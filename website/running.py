"""Run commands of sleec-verify and capture their output."""

from __future__ import annotations

import io
import os
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, redirect_stderr, redirect_stdout
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import NamedTuple

from sleec_verify.cli import run


class Ran(NamedTuple):
    """The output of a command (both streams in the order of a terminal) and its exit code."""

    out: str
    code: int


def printed(*arguments: str) -> Ran:
    """Run `sleec-verify` with these arguments in the current folder."""
    # click writes bytes where a stream has a buffer.
    out = io.TextIOWrapper(io.BytesIO(), encoding="utf-8", newline="", write_through=True)
    with redirect_stdout(out), redirect_stderr(out):
        code = run(arguments)
    return Ran(out.buffer.getvalue().decode("utf-8"), code)


@contextmanager
def folder_with(files: Mapping[str, str]) -> Iterator[Path]:
    """Change to a new folder with these files, for the time of the context."""
    before = Path.cwd()
    with TemporaryDirectory() as name:
        for path, text in files.items():
            (Path(name) / path).write_text(text, encoding="utf-8")
        os.chdir(name)
        try:
            yield Path(name)
        finally:
            os.chdir(before)
