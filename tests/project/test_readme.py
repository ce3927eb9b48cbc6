"""The commands of the README and of docs/ci.md print what is shown there. UPDATE_DOCUMENTS=1 puts in what they print
now."""

from __future__ import annotations

import os
import re
import shlex
from pathlib import Path

import pytest

from sleec_verify.cli import run

ROOT = Path(__file__).parents[2]
README = ROOT / "README.md"
SESSION = re.compile(r"```console\n(\$ sleec-verify (?:.*\n)*?)```\n")


@pytest.fixture
def in_root(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(ROOT)


@pytest.mark.usefixtures("in_root")
@pytest.mark.parametrize(("path", "least"), [(README, 5), (ROOT / "docs" / "ci.md", 2)], ids=["README", "ci"])
def test_commands_print_what_is_shown(path: Path, least: int, capfd: pytest.CaptureFixture[str]) -> None:
    def session(match: re.Match[str]) -> str:
        """The commands of one block, each with what it prints."""
        shown = []
        for command in re.findall(r"^\$ (.+)$", match.group(1), re.MULTILINE):
            assert run(shlex.split(command)[1:]) in (0, 1)
            out, err = capfd.readouterr()
            if "fmt --check" not in command:  # which counts the files there
                assert err == ""
            shown.append(f"$ {command}\n{out}")
        return f"```console\n{''.join(shown)}```\n"

    text = path.read_text(encoding="utf-8")
    shown = SESSION.sub(session, text)
    if os.environ.get("UPDATE_DOCUMENTS"):
        path.write_text(shown, encoding="utf-8")
    else:
        assert shown == text
    assert len(SESSION.findall(text)) >= least


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
    for name in ("README.md", "rulesets/README.md", "docs/ci.md"):
        text = (ROOT / name).read_text(encoding="utf-8")
        for link in re.findall(r"\]\(([^)#:]+)\)", text):
            assert ((ROOT / name).parent / link).exists(), f"{name} links to {link}"


def test_folders_exist() -> None:
    folders = re.findall(r"^\| `([\w_]+)/` \|", README.read_text(encoding="utf-8"), re.MULTILINE)
    assert folders
    assert all((ROOT / folder).is_dir() for folder in folders)
