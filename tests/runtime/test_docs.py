"""The guide's examples, run as the one program that they are."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

GUIDE = Path("docs/runtime.md")


def blocks(language: str) -> list[str]:
    return re.findall(rf"^```{language}\n(.*?)^```$", GUIDE.read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL)


def test_the_examples_of_the_guide_run(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    program: dict[str, object] = {}
    programs, printed = blocks("python"), "".join(blocks("text"))
    monkeypatch.chdir(tmp_path)
    for block in programs:
        exec(compile(block, str(GUIDE), "exec"), program)
    assert capsys.readouterr().out == printed
