"""The summary of `gate` in Markdown."""

from __future__ import annotations

import shutil

import pytest

from tests.support.cli import Cli
from tests.support.gates import CLASH, OLD
from tests.support.repository import Repository

pytestmark = pytest.mark.skipif(shutil.which("git") is None, reason="there is no git on this machine")


def test_the_summary(cli: Cli, repository: Repository, monkeypatch: pytest.MonkeyPatch) -> None:
    repository.write(a_sleec=CLASH)
    step = repository.folder / "step.md"
    step.write_text("what other steps say\n")
    monkeypatch.setenv("GITHUB_STEP_SUMMARY", str(step))
    assert cli("gate", "--base", "main", "--summary", "out.md").code == 1
    text = (repository.folder / "out.md").read_text(encoding="utf-8")
    assert step.read_text() == "what other steps say\n" + text
    assert text.startswith("<!-- written by sleec-verify gate -->\n## SLEEC rules: blocked\n")
    assert "- **new-conflicts**, `a.sleec`: a and b now contradict each other about o" in text
    assert "| `a.sleec` | incomparable: " in text
    repository.write(a_sleec=OLD)
    assert cli("gate", "--base", "main", "--summary", "out.md").code == 0
    assert "passed" in (repository.folder / "out.md").read_text()


def test_nothing_in_the_summary_is_taken_for_markdown(cli: Cli, repository: Repository) -> None:
    repository.write(a_sleec="RULE a_b\nWHEN t_x THEN o_z\nUNLESS d < 3 IN WHICH CASE p\n")
    assert cli("gate", "--base", "main", "--summary", "out.md").code == 0
    text = (repository.folder / "out.md").read_text()
    assert "o\\_z" in text
    assert "o_z" not in text.replace("\\_", "")
