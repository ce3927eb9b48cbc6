"""The examples of each page about nodes are one program, and print what the page shows."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from tests.support.paths import ROOT


@pytest.mark.parametrize("page", ["docs/ros.md", "docs/monitor.md"])
def test_the_examples_of_the_page_run(
    page: str, capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "rulesets").symlink_to(ROOT / "rulesets")
    monkeypatch.chdir(tmp_path)
    blocks = re.findall(
        r"^```(python|text)\n(.*?)^```$", (ROOT / page).read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL
    )
    program: dict[str, object] = {}
    for kind, block in blocks:
        if kind == "python":
            exec(compile(block, page, "exec"), program)
        else:
            assert capsys.readouterr().out == block
    assert capsys.readouterr().out == ""
