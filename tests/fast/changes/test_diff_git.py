"""`diff` of revisions."""

from __future__ import annotations

import json
import os
import shutil
from pathlib import Path
from typing import Any

import pytest

from tests.support.cli import Cli
from tests.support.diffs import CLASH, LESS, MORE, OLD, SAME
from tests.support.repository import Repository

needs_git = pytest.mark.skipif(shutil.which("git") is None, reason="git is not installed")


@pytest.fixture
def repository(tmp_path: Path) -> Repository:
    return Repository(tmp_path)


@needs_git
def test_the_files_against_a_revision(cli: Cli, repository: Repository) -> None:
    repository.commit(a_sleec=OLD, b_sleec=OLD)
    repository.write(a_sleec=MORE)
    ran = cli("diff", "--git", "main", "--", ".")
    assert ran.code == 1
    assert ran.out.startswith("main:a.sleec -> a.sleec: stricter")
    assert ran.out.endswith(
        "2 rulesets (1 unchanged): stricter: the new rules require more in some situations, and less in none\n"
    )
    assert "before  o, by rule `a` (main:a.sleec:2)" in ran.out
    assert repository.git("status", "--porcelain") == "M a.sleec"


@needs_git
def test_the_folder_is_the_current_one_unless_told(
    cli: Cli, repository: Repository, monkeypatch: pytest.MonkeyPatch
) -> None:
    repository.put("rules/a.sleec", OLD)
    repository.put("other/b.sleec", OLD)
    repository.commit()
    repository.put("rules/a.sleec", MORE)
    repository.put("other/b.sleec", LESS)
    monkeypatch.chdir(repository.folder / "rules")
    said = json.loads(cli_at(cli, "diff", "--git", "HEAD", "--format", "json").out)
    assert [one["path"] for one in said["rulesets"]] == ["rules/a.sleec"]
    both = json.loads(cli_at(cli, "diff", "--git", "HEAD", "--format", "json", ".", "../other/b.sleec").out)
    assert [one["path"] for one in both["rulesets"]] == ["rules/a.sleec", "other/b.sleec"]


def cli_at(cli: Cli, *arguments: str) -> Any:
    """As `cli`, wherever the test is by now."""
    return cli(*arguments)


@needs_git
def test_two_revisions(cli: Cli, repository: Repository) -> None:
    repository.commit(a_sleec=OLD)
    repository.git("checkout", "-q", "-b", "feature")
    repository.commit(a_sleec=MORE)
    repository.git("checkout", "-q", "main")
    repository.commit(a_sleec=LESS)
    repository.write(a_sleec="no rules")
    relation = {
        "main..feature": "stricter",
        "main...feature": "stricter",
        "feature...main": "laxer",
        "main~1..main": "laxer",
        "main~1..": "laxer",
    }
    for written, word in relation.items():
        said = json.loads(cli("diff", "--git", written, "--format", "json").out)
        assert said["relation"] == word, written


@needs_git
def test_equal_files_of_two_revisions_are_not_read(cli: Cli, repository: Repository) -> None:
    repository.commit(a_sleec="no rules at all", b_sleec=OLD)
    repository.write(b_sleec=SAME)
    ran = cli("diff", "--git", "main")
    assert (ran.code, ran.err) == (0, "")
    assert "2 rulesets (1 unchanged): equivalent" in ran.out


@needs_git
def test_files_that_came_and_went(cli: Cli, repository: Repository) -> None:
    repository.commit(a_sleec=OLD)
    repository.write(a_sleec=None, b_sleec="RULE b\nWHEN u THEN x\n")
    ran = cli("diff", "--git", "main")
    assert ran.code == 2
    assert "a.sleec was deleted: it is not in the current files" in ran.err
    assert "b.sleec was added: it is not in main" in ran.err
    assert cli("diff", "--git", "main", "--", "b.sleec").code == 2
    assert cli("diff", "--git", "main", "--missing-as-empty").code == 1


@needs_git
def test_a_file_that_moved_is_compared_with_what_it_was(cli: Cli, repository: Repository) -> None:
    repository.commit(a_sleec=OLD)
    repository.write(a_sleec=None, b_sleec=OLD)
    assert "main:a.sleec -> b.sleec: equivalent" in cli("diff", "--git", "main").out
    repository.commit(b_sleec=MORE)
    ran = cli("diff", "--git", "main~..main")
    assert (ran.code, ran.err) == (1, "")
    assert "main~:a.sleec -> main:b.sleec: stricter" in ran.out


@needs_git
@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--git", "mian"], "there is no revision mian in this repository\n  = help: did you mean main?"),
        (["--git", "0123456789"], "there is no revision 0123456789"),
        (["--git", "-q"], "there is no revision -q"),
        (["--git", ""], "there is no revision (empty)"),
        (["--git", "main..nowhere"], "there is no revision nowhere"),
        (["--git", "main...alone"], "error: main and alone have no common commit"),
        (
            ["--git", "main~7"],
            "there is no revision main~7 in this repository\n  = help: in CI, fetch the whole history",
        ),
        (["--git", "main:a.sleec"], "name a commit and then the file: --git main a.sleec"),
        (["--git", ":/nothing"], "no commit message in the history of HEAD or of a branch contains this text"),
        (["--git", "x\ty"], "name a branch, a tag or a commit"),
        (["--git", "nowhere"], "in CI, fetch it first (git fetch origin nowhere)"),
        (["--git", "main", "--", "c.sleec"], "there is no .sleec file at or below c.sleec, neither in main nor in"),
        (["--git", "main", "--", ".."], ".. is not in the working tree of"),
    ],
)
def test_what_git_cannot_do(cli: Cli, repository: Repository, arguments: list[str], message: str) -> None:
    repository.commit(a_sleec=OLD)
    repository.git("checkout", "-q", "--orphan", "alone")
    repository.commit("another root")
    repository.git("checkout", "-q", "main")
    ran = cli("diff", *arguments)
    assert ran.code == 2
    assert message in ran.err


@needs_git
@pytest.mark.parametrize("command", [("gate", "--base"), ("diff", "--git")])
@pytest.mark.parametrize(
    ("revision", "code"),
    [
        (":/second", 0),
        (":/first", 1),
        (":/first..draft", 1),
        ("HEAD^{/first}", 1),
        ("marked", 1),
        ("main^", 1),
        (":/third", 2),
        ("main:a.sleec", 2),
        ("main^{tree}", 2),
        ("^main", 2),
        ("main main", 2),
    ],
)
def test_revisions_are_read_alike(
    cli: Cli, repository: Repository, command: tuple[str, ...], revision: str, code: int
) -> None:
    repository.commit("the first..draft", a_sleec=OLD)
    repository.git("tag", "-a", "-m", "a tag with a message", "marked")
    repository.commit("the second one", a_sleec=CLASH)
    ran = cli(*command, revision)
    assert ran.code == code, ran
    if code == 2:
        assert f"there is no revision {revision} in this repository" in ran.err


@needs_git
def test_a_repository_without_commits(cli: Cli, repository: Repository) -> None:
    repository.write(a_sleec=OLD)
    ran = cli("diff", "--git", "HEAD")
    assert ran.code == 2
    assert "there is no revision HEAD in this repository\n  = help: the repository has no commits" in ran.err


@needs_git
@pytest.mark.parametrize("side", ["old", "new"])
def test_a_side_that_is_no_ruleset(cli: Cli, repository: Repository, side: str) -> None:
    repository.commit(a_sleec="WHEN" if side == "old" else OLD, b_sleec=OLD)
    repository.write(a_sleec=OLD if side == "old" else "WHEN", b_sleec=MORE)
    ran = cli("diff", "--git", "main")
    assert ran.code == 2
    assert ("main:a.sleec:1:" if side == "old" else "\na.sleec:1:") in "\n" + ran.err
    assert "b.sleec: stricter" in ran.out  # the others are compared all the same
    assert "(1 unusable)" in ran.out


def test_no_repository(cli: Cli, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv("GIT_CEILING_DIRECTORIES", os.fspath(tmp_path.parent))
    ran = cli("diff", "--git", "main")
    assert ran.code == 2
    assert "not in a git repository" in ran.err


def test_no_git(cli: Cli, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", "")
    ran = cli("diff", "--git", "main")
    assert ran.code == 2
    assert "git is not installed" in ran.err
