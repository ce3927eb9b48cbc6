"""What `gate` compares with, and what it examines."""

from __future__ import annotations

import json
import shutil
from collections.abc import Callable

import pytest

from tests.support.cli import Cli
from tests.support.gates import CLASH, LOST, OLD, config, gated, policies
from tests.support.repository import Repository

pytestmark = pytest.mark.skipif(shutil.which("git") is None, reason="there is no git on this machine")


def test_the_base_is_what_both_have_in_common(cli: Cli, repository: Repository) -> None:
    repository.git("checkout", "-q", "-b", "feature")
    repository.git("checkout", "-q", "main")
    repository.commit(a_sleec=LOST)
    repository.git("checkout", "-q", "feature")
    assert gated(cli)[1]["unchanged"] == 1


def test_only_what_changed_is_examined(cli: Cli, repository: Repository) -> None:
    repository.commit(b_sleec=CLASH)
    repository.write(a_sleec=OLD + "\n// the same\n")
    code, said = gated(cli)
    assert (code, [one["path"] for one in said["rulesets"]], said["unchanged"]) == (0, ["a.sleec"], 1)
    code, said = gated(cli, "--all")
    assert (code, len(said["rulesets"])) == (1, 2)


def test_added_and_deleted_files(cli: Cli, repository: Repository) -> None:
    repository.write(a_sleec=None, b_sleec="RULE b\nWHEN u THEN x\n")
    code, said = gated(cli)
    assert code == 1
    assert [(block["policy"], block["where"]) for block in said["blocks"]] == [("deletions", "a.sleec")]
    config(repository, block='lost-obligations = ["o"]\ndeletions = false')
    code, said = gated(cli)
    assert code == 1
    assert [(block["policy"], block["where"]) for block in said["blocks"]] == [("lost-obligations", "a.sleec")]
    assert [one["relation"] for one in said["rulesets"]] == ["laxer", "stricter"]


def test_the_base_and_rulesets_of_the_configuration(
    cli: Cli, repository: Repository, monkeypatch: pytest.MonkeyPatch
) -> None:
    repository.put("rules/b.sleec", OLD)
    config(repository, 'base = "main"', 'rulesets = ["rules"]')
    repository.commit()
    repository.put("rules/b.sleec", CLASH)
    repository.put("a.sleec", "no rules")
    (repository.folder / "rules" / "deep").mkdir()
    monkeypatch.chdir(repository.folder / "rules" / "deep")
    ran = cli("gate", "--format", "json")
    assert ran.code == 1
    assert [one["path"] for one in json.loads(ran.out)["rulesets"]] == ["rules/b.sleec"]


@pytest.fixture
def clone(
    repository: Repository, tmp_path_factory: pytest.TempPathFactory, monkeypatch: pytest.MonkeyPatch
) -> Repository:
    """A clone with a branch that adds a conflict to the rules of `origin/main`."""
    folder = tmp_path_factory.mktemp("clone")
    made = Repository(folder)
    made.git("remote", "add", "origin", str(repository.folder))
    made.git("fetch", "-q", "origin")
    made.git("checkout", "-q", "-b", "feature", "origin/main")
    made.commit(a_sleec=CLASH)
    monkeypatch.chdir(folder)
    return made


@pytest.mark.parametrize(
    ("base", "command"),
    [
        ("origin/main", ("tag", "origin/main", "HEAD")),
        ("origin/main", ("branch", "origin/main", "HEAD")),
        ("origin/main", ("update-ref", "refs/origin/main", "HEAD")),
        ("trunk", ("tag", "trunk", "HEAD")),
        ("trunk~0", ("tag", "trunk", "HEAD")),
        ("trunk@{0}", ("tag", "trunk", "HEAD")),
        ("origin", ("tag", "origin", "HEAD")),
    ],
)
def test_a_name_with_more_than_one_meaning_is_refused(
    cli: Cli, clone: Repository, base: str, command: tuple[str, ...]
) -> None:
    clone.git("branch", "trunk", "origin/main")
    clone.git("remote", "set-head", "origin", "main")
    assert cli("gate", "--base", base).code == 1
    clone.git(*command)
    ran = cli("gate", "--base", base)
    assert ran.code == 2
    assert "has more than one meaning" in ran.err
    assert "refs/" in ran.err


def test_a_branch_does_not_hide_an_abbreviated_hash(cli: Cli, clone: Repository) -> None:
    base = clone.git("rev-parse", "--short=7", "origin/main")
    assert cli("gate", "--base", base).code == 1
    clone.git("branch", base, "HEAD")
    assert cli("gate", "--base", base).code == 2
    whole = clone.git("rev-parse", "origin/main")
    clone.git("update-ref", f"refs/heads/{whole}", "HEAD")
    assert cli("gate", "--base", whole).code == 1


def test_a_file_in_the_git_folder_is_no_branch(cli: Cli, clone: Repository) -> None:
    place = clone.folder / ".git" / "origin"
    place.mkdir()
    (place / "main").write_text(clone.git("rev-parse", "HEAD"))
    assert cli("gate", "--base", "origin/main").code == 1


@pytest.mark.parametrize("name", ["refs/remotes/origin/main", "HEAD~1", "@~1", "feature~1", "origin", "feature@{1}"])
def test_other_names_of_the_base(cli: Cli, clone: Repository, name: str) -> None:
    clone.git("remote", "set-head", "origin", "main")
    assert cli("gate", "--base", name).code == 1


def replacement(clone: Repository) -> None:
    clone.git("replace", clone.git("rev-parse", "origin/main"), clone.git("rev-parse", "HEAD"))


def replaced_blob(clone: Repository) -> None:
    clone.git("replace", clone.git("rev-parse", "origin/main:a.sleec"), clone.git("rev-parse", "HEAD:a.sleec"))


def graft(clone: Repository) -> None:
    """The base descends from the change, so the change is the common ancestor."""
    base, own = clone.git("rev-parse", "origin/main"), clone.git("rev-parse", "HEAD")
    clone.put(".git/info/grafts", f"{own}\n{base} {own}\n")


@pytest.mark.parametrize("attack", [replacement, replaced_blob, graft])
def test_a_revision_contains_what_was_committed(
    cli: Cli, clone: Repository, attack: Callable[[Repository], None]
) -> None:
    attack(clone)
    code, said = gated(cli, base="origin/main")
    assert code == 1
    assert "findings" in policies(said)
