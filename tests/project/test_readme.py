"""The README's commands print what it shows. UPDATE_DOCUMENTS=1 puts in what they print now."""

from __future__ import annotations

import os
import re
import shlex
from pathlib import Path

import pytest

from sleec_verify.cli import run

ROOT = Path(__file__).parents[2]
README = ROOT / "README.md"
SESSION = re.compile(r"```console\n\$ (sleec-verify .+)\n((?:.*\n)*?)```\n")


@pytest.fixture
def in_root(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(ROOT)


@pytest.mark.usefixtures("in_root")
def test_commands_print_what_is_shown(capfd: pytest.CaptureFixture[str]) -> None:
    def session(command: str) -> str:
        assert run(shlex.split(command)[1:]) in (0, 1)
        out, err = capfd.readouterr()
        assert err == ""
        return f"```console\n$ {command}\n{out}```\n"

    text = README.read_text(encoding="utf-8")
    shown = SESSION.sub(lambda match: session(match.group(1)), text)
    if os.environ.get("UPDATE_DOCUMENTS"):
        README.write_text(shown, encoding="utf-8")
    else:
        assert shown == text
    assert len(SESSION.findall(text)) >= 5


def test_quick_start_is_two_targets_of_the_makefile() -> None:
    quick = re.search(r"## Quick start\n.*?```\n(.*?)```", README.read_text(encoding="utf-8"), re.DOTALL)
    assert quick
    commands = quick.group(1).splitlines()
    assert len(commands) == 2
    makefile = (ROOT / "Makefile").read_text(encoding="utf-8")
    for command in commands:
        make, target = command.split()
        assert make == "make"
        assert re.search(rf"^{target}:", makefile, re.MULTILINE)


def test_what_is_linked_exists() -> None:
    for name in ("README.md", "rulesets/README.md"):
        text = (ROOT / name).read_text(encoding="utf-8")
        for link in re.findall(r"\]\(([^)#:]+)\)", text):
            assert ((ROOT / name).parent / link).exists(), f"{name} links to {link}"


def test_folders_exist() -> None:
    folders = re.findall(r"^\| `([\w_]+)/` \|", README.read_text(encoding="utf-8"), re.MULTILINE)
    assert folders
    assert all((ROOT / folder).is_dir() for folder in folders)
