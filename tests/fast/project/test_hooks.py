"""The hooks for pre-commit, run as it runs them."""

from __future__ import annotations

import os
import re
import shlex
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
import yaml

from tests.support.hostile import plant
from tests.support.paths import ROOT

HOOKS: list[dict[str, Any]] = yaml.safe_load((ROOT / ".pre-commit-hooks.yaml").read_text(encoding="utf-8"))
CLASH = "WHEN Rung THEN Open\n\nWHEN Storm THEN NOT Open\n"


@pytest.mark.parametrize("hook", HOOKS, ids=lambda hook: hook["id"])
def test_hooks_have_what_pre_commit_asks_for(hook: dict[str, Any]) -> None:
    assert {"id", "name", "entry", "language"} <= set(hook)
    assert hook["language"] == "python"
    assert re.search(hook["files"], "rules/a.sleec")
    assert not re.search(hook["files"], "rules/a.sleec.bak")


def run_hook(name: str, folder: Path, *arguments: str, **environment: str) -> subprocess.CompletedProcess[str]:
    """Run a hook as pre-commit does: its entry, its arguments, the files."""
    (hook,) = (hook for hook in HOOKS if hook["id"] == name)
    program, *entry = shlex.split(hook["entry"])
    assert program == "python"
    return subprocess.run(
        [sys.executable, *entry, *arguments],
        cwd=folder,
        env={**os.environ, **environment},
        capture_output=True,
        text=True,
    )


def test_the_check_hook_blocks_conflicts(tmp_path: Path) -> None:
    (tmp_path / "clash.sleec").write_text(CLASH)
    (tmp_path / "fine.sleec").write_text("WHEN Rung THEN Open\n")
    assert run_hook("sleec-check", tmp_path, "fine.sleec").returncode == 0
    done = run_hook("sleec-check", tmp_path, "clash.sleec", "fine.sleec")
    assert done.returncode == 1
    assert done.stdout.startswith("clash.sleec:1:1: error[SLEEC101]")


def test_the_layout_hook_changes_what_is_not_laid_out(tmp_path: Path) -> None:
    path = tmp_path / "a.sleec"
    path.write_text("WHEN   Rung THEN Open\n")
    assert run_hook("sleec-fmt", tmp_path, "a.sleec").returncode == 0
    assert path.read_text() == "WHEN Rung THEN Open\n"
    path.write_text("WHEN")
    assert run_hook("sleec-fmt", tmp_path, "a.sleec").returncode == 2


# In a hostile checkout ---------------------------------------------------------------------------------------


def test_the_traps_are_sprung_by_what_is_not_isolated(tmp_path: Path) -> None:
    """The test of the tests with `plant`: `python -m` in the folder runs the files there."""
    marks = tmp_path / "marks"
    plant(tmp_path / "checkout", marks)
    for module in ("venv", "pip", "sleec_verify"):
        subprocess.run([sys.executable, "-m", module], cwd=tmp_path / "checkout", check=True)
    assert [line.split(" in ")[0] for line in marks.read_text().splitlines()].count("__main__") == 3


@pytest.mark.parametrize("hook", HOOKS, ids=lambda hook: hook["id"])
def test_a_hook_runs_nothing_of_the_checkout(hook: dict[str, Any], tmp_path: Path) -> None:
    environment = plant(tmp_path / "checkout", tmp_path / "marks")
    (tmp_path / "checkout" / "a.sleec").write_text("WHEN Rung THEN Open\n")
    done = run_hook(hook["id"], tmp_path / "checkout", "a.sleec", **environment)
    assert done.returncode == 0, done.stderr
    assert not (tmp_path / "marks").exists()


def test_the_command_runs_nothing_of_the_folder_that_it_is_called_in(tmp_path: Path) -> None:
    """Without -I, but without variables that point into the folder, either."""
    plant(tmp_path / "checkout", tmp_path / "marks")
    (tmp_path / "checkout" / "a.sleec").write_text("WHEN Rung THEN Open\n")
    command = [str(Path(sys.executable).with_name("sleec-verify")), "check", "."]
    done = subprocess.run(command, cwd=tmp_path / "checkout", capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert not (tmp_path / "marks").exists()
