"""Links in a folder: one that leaves it is skipped with a note, and nothing of its target is shown or changed."""

from __future__ import annotations

import os
import shutil
from pathlib import Path

import pytest

from tests.support.cli import Cli
from tests.support.repository import Repository

pytestmark = [
    pytest.mark.skipif(shutil.which("git") is None, reason="git is not installed"),
    pytest.mark.skipif(os.name != "posix", reason="links need no rights"),
]

RULES = "RULE a\nWHEN t THEN o\n"
SECRET = "hunter2 is the password\n"
COMMANDS = {
    "check": ("check", "."),
    "check --format json": ("check", ".", "--format", "json"),
    "fmt --write": ("fmt", "--write", "."),
    "diff": ("diff", ".", "."),
    "diff --git": ("diff", "--git", "main"),
    "gate": ("gate", "--base", "main", "--all"),
    "gate --write-baseline": ("gate", "--write-baseline", "--baseline", "known.json"),
}


@pytest.fixture
def repository(tmp_path: Path, tmp_path_factory: pytest.TempPathFactory) -> Repository:
    made = Repository(tmp_path)
    made.commit(a_sleec=RULES, a_sleec_txt=SECRET)
    made.put(".git/description", SECRET)
    outside = tmp_path_factory.mktemp("outside")
    (outside / "secret").write_text(SECRET)
    (outside / "secret.sleec").write_text(SECRET)
    (tmp_path / "outside").symlink_to(outside)
    return made


TARGETS = {
    "a file outside": "outside/secret",
    "a ruleset outside": "outside/secret.sleec",
    "a file that git keeps": ".git/description",
    "a file inside that is not a ruleset": "a.sleec.txt",
    "a path with two dots": "../outside0/secret",
    "an absolute path": "/etc/passwd",
    "a device": "/dev/zero",
}


@pytest.mark.parametrize("target", TARGETS)
@pytest.mark.parametrize("command", COMMANDS)
def test_a_link_that_leaves_the_folder_is_skipped(command: str, target: str, cli: Cli, repository: Repository) -> None:
    real = os.path.realpath(repository.folder / TARGETS[target])
    (repository.folder / "b.sleec").symlink_to(real if target.startswith("an absolute") else TARGETS[target])
    ran = cli(*COMMANDS[command])
    assert ran.code == 0, ran
    assert "note: the link " in ran.err
    assert "b.sleec is skipped: its target is not a ruleset below the same folder\n" in ran.err
    assert ran.err.count("b.sleec") == (2 if command == "diff" else 1)
    assert "b.sleec" not in ran.out
    assert "hunter2" not in ran.out + ran.err
    if os.path.isfile(real) and not real.startswith("/etc"):
        assert Path(real).read_text() == SECRET


@pytest.mark.parametrize("command", COMMANDS)
def test_a_link_to_a_ruleset_of_the_folder_is_no_news(command: str, cli: Cli, repository: Repository) -> None:
    (repository.folder / "b.sleec").symlink_to("a.sleec")
    repository.commit()
    ran = cli(*COMMANDS[command])
    assert (ran.code, "note" in ran.err) == (0, False), ran


def test_a_file_below_a_linked_folder_is_not_read(cli: Cli, repository: Repository) -> None:
    """Git still knows the file by the name that it had in the folder."""
    repository.put("sub/secret.sleec", RULES)
    repository.commit()
    shutil.rmtree(repository.folder / "sub")
    (repository.folder / "sub").symlink_to("outside")
    ran = cli("gate", "--base", "main")
    assert "note: the link sub/secret.sleec is skipped" in ran.err
    assert "hunter2" not in ran.out + ran.err


def test_a_link_that_is_named_is_followed(cli: Cli, repository: Repository) -> None:
    (repository.folder / "rules").mkdir()
    (repository.folder / "rules" / "b.sleec").symlink_to("../a.sleec")
    assert cli("check", "rules/b.sleec").code == 0
    ran = cli("check", "rules")
    assert ran.code == 2
    assert "there is no .sleec file below rules" in ran.err
    (repository.folder / "linked").symlink_to(repository.folder)
    assert cli("check", "linked").code == 0


@pytest.mark.parametrize("path", [".git/config", ".GIT/config", ".git", "../outside0/secret", "outside/secret"])
def test_a_path_outside_the_working_tree_is_refused(path: str, cli: Cli, repository: Repository) -> None:
    for command in (("gate", "--base", "main"), ("diff", "--git", "main")):
        ran = cli(*command, "--", path)
        assert (ran.code, ran.out) == (2, "")
        assert f"{path} is not in the working tree of" in ran.err or "there is no .sleec file" in ran.err


@pytest.mark.parametrize("target", TARGETS)
def test_a_link_in_a_folder_of_code_is_refused(target: str, cli: Cli, repository: Repository) -> None:
    """To skip it could hide code from the verdict."""
    repository.put("robot/robot.py", "import sleec_runtime\n")
    path = repository.folder / TARGETS[target]
    (repository.folder / "robot" / "more.py").symlink_to(path)
    ran = cli("conform", "robot", "--ruleset", "a.sleec")
    assert (ran.code, ran.out) == (2, "")
    assert "the link robot/more.py does not lead to a Python file below robot" in ran.err
    assert "hunter2" not in ran.err
