"""`fmt` changes files only if it is asked to, and atomically. Its output is in documents/good/fmt.txt."""

from __future__ import annotations

import os
import stat
from pathlib import Path

import pytest

from tests.support.cli import Cli

MESSY = "RULE   one WHEN Rung THEN  OpenDoor\n"
NEAT = "RULE one\nWHEN Rung THEN OpenDoor\n"


def test_prints_and_changes_nothing(cli: Cli, tmp_path: Path) -> None:
    assert cli("fmt", "a.sleec", files={"a.sleec": MESSY}).out == NEAT
    assert (tmp_path / "a.sleec").read_text() == MESSY


def test_write_keeps_rights_and_links(cli: Cli, tmp_path: Path) -> None:
    target = tmp_path / "there" / "a.sleec"
    target.parent.mkdir()
    target.write_text(MESSY)
    target.chmod(0o640)
    (tmp_path / "link.sleec").symlink_to(target)
    assert cli("fmt", "--write", "link.sleec").code == 0
    assert (tmp_path / "link.sleec").is_symlink()
    assert target.read_text() == NEAT
    assert stat.S_IMODE(target.stat().st_mode) == 0o640
    assert os.listdir(target.parent) == ["a.sleec"]


def test_write_keeps_line_breaks(cli: Cli, tmp_path: Path) -> None:
    path = tmp_path / "a.sleec"
    path.write_bytes(MESSY.replace("\n", "\r\n").encode())
    assert cli("fmt", "--write", "a.sleec").code == 0
    assert path.read_bytes() == NEAT.replace("\n", "\r\n").encode()
    assert cli("fmt", "--check", "a.sleec").code == 0


def test_write_changes_the_sound_files_among_others(cli: Cli, tmp_path: Path) -> None:
    ran = cli("fmt", "--write", ".", files={"a.sleec": "WHEN", "b.sleec": MESSY, "c.sleec": NEAT})
    assert ran.code == 2
    assert (tmp_path / "a.sleec").read_text() == "WHEN"
    assert (tmp_path / "b.sleec").read_text() == NEAT
    assert ran.err.endswith("3 files, 1 changed, 1 unusable\n")


def test_failing_write_leaves_the_file(cli: Cli, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(*_: object) -> None:
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr("os.replace", fail)
    ran = cli("fmt", "--write", "a.sleec", files={"a.sleec": MESSY})
    assert ran.code == 2
    assert "a.sleec cannot be written: Permission denied" in ran.err
    assert os.listdir(tmp_path) == ["a.sleec"]
    assert (tmp_path / "a.sleec").read_text() == MESSY


def test_layout_that_would_change_the_rules_is_not_written(
    cli: Cli, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("sleec_verify.cli.fmt.print_ruleset", lambda _: "WHEN Rung THEN LockDoor\n")
    ran = cli("fmt", "--write", "a.sleec", files={"a.sleec": MESSY})
    assert ran.code == 2
    assert "would change what its rules say" in ran.err
    assert (tmp_path / "a.sleec").read_text() == MESSY


def test_diff_tells_of_a_missing_line_break_at_the_end(cli: Cli) -> None:
    ran = cli("fmt", "--diff", "a.sleec", files={"a.sleec": MESSY.rstrip()})
    assert "\\ No newline at end of file" in ran.out
