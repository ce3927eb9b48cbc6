"""The examples of the pages on the runtime are one program, and print what the pages show."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

PAGES = [Path("docs", name) for name in ("runtime.md", "deadlines.md", "restart.md")]
"""In the order of the program."""


def blocks(language: str) -> list[str]:
    text = "".join(page.read_text(encoding="utf-8") for page in PAGES)
    return re.findall(rf"^```{language}\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)


def test_the_examples_of_the_guide_run(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    program: dict[str, object] = {}
    programs, printed = blocks("python"), "".join(blocks("text"))
    monkeypatch.chdir(tmp_path)
    for block in programs:
        exec(compile(block, "docs/runtime.md", "exec"), program)
    assert capsys.readouterr().out == printed
