"""`gate` in repositories with moved, linked, ignored and missing files."""

from __future__ import annotations

import os
import re
import shutil
from pathlib import Path
from typing import Any

import pytest

from sleec_verify.report import FORMATS
from tests.support.cli import Cli
from tests.support.gates import CLASH, LOST, OLD, config, gated, policies, with_fingerprints
from tests.support.repository import Repository

pytestmark = pytest.mark.skipif(shutil.which("git") is None, reason="there is no git on this machine")


def test_a_ruleset_that_has_moved_is_compared_with_what_it_was(cli: Cli, repository: Repository) -> None:
    config(repository, 'baseline = "known.json"', block='lost-obligations = ["*"]')
    repository.commit(a_sleec=CLASH)
    assert cli("gate", "--write-baseline").code == 0
    repository.keep("known.json")
    repository.git("mv", "a.sleec", "b.sleec")
    code, said = gated(cli)
    assert (code, said["rulesets"], said["unchanged"]) == (0, [], 1)
    repository.write(b_sleec="# moved\n" + CLASH)
    code, said = gated(cli)
    (ruleset,) = said["rulesets"]
    assert (code, ruleset["path"], ruleset["moved_from"]) == (0, "b.sleec", "a.sleec")
    assert (ruleset["relation"], ruleset["baseline"], said["stale"]) == ("equivalent", 1, 0)
    assert cli("gate", "--base", "main", "--summary", "out.md").code == 0
    assert "| `b.sleec`, was `a.sleec` |" in (repository.folder / "out.md").read_text()
    repository.write(b_sleec=CLASH.replace("UNLESS c IN WHICH CASE p\n", ""))
    code, said = gated(cli)
    assert (code, policies(said)) == (1, {"findings", "new-conflicts"})
    repository.write(b_sleec=CLASH.replace("p\n", "o\n"))
    code, said = gated(cli)
    assert (code, policies(said)) == (1, {"findings", "new-conflicts"})
    repository.write(b_sleec="RULE other\nWHEN u THEN x\n")
    assert [one["path"] for one in gated(cli)[1]["rulesets"]] == ["a.sleec", "b.sleec"]


def test_of_what_moved_the_most_alike_belong_together(cli: Cli, repository: Repository) -> None:
    second = "RULE c\nWHEN u THEN x\nUNLESS d IN WHICH CASE y\n"
    repository.commit(b_sleec=second)
    repository.write(a_sleec=None, b_sleec=None, c_sleec=second + "RULE d\nWHEN v THEN z\n", d_sleec=OLD + "# a\n")
    said = gated(cli)[1]
    moved = [(one["path"], one["moved_from"], one["relation"]) for one in said["rulesets"]]
    assert moved == [("c.sleec", "b.sleec", "stricter"), ("d.sleec", "a.sleec", "equivalent")]


def test_a_folder_that_has_moved_is_the_same(cli: Cli, repository: Repository) -> None:
    """More of them than are compared line by line; some of them equal, some of them changed."""
    for number in range(60):
        repository.put(f"old/{number}.sleec", OLD.replace("RULE a", f"RULE r{number // 2}"))
    repository.commit()
    repository.git("mv", "old", "new")
    config(repository, block='lost-obligations = ["*"]')
    code, said = gated(cli)
    assert (code, said["unchanged"], said["rulesets"]) == (0, 61, [])
    repository.put("new/8.sleec", OLD.replace("RULE a", "RULE r4") + "\n# changed\n")
    (ruleset,) = gated(cli)[1]["rulesets"]
    assert (ruleset["path"], ruleset["relation"]) == ("new/8.sleec", "equivalent")
    assert ruleset["moved_from"] in ("old/8.sleec", "old/9.sleec")
    for number in range(60):
        repository.put(f"new/{number}.sleec", OLD.replace("RULE a", f"RULE r{number}") + "\n# changed\n")
    assert len(gated(cli)[1]["rulesets"]) == 120, "too many to be compared with one another"


def test_what_git_ignores_or_keeps_for_itself_is_not_looked_at(cli: Cli, repository: Repository) -> None:
    repository.put(".gitignore", "venv/\n")
    repository.put("venv/x.sleec", "WHEN")
    repository.commit()
    repository.git("branch", "fix.sleec")
    (repository.folder / "nested").mkdir()
    Repository(repository.folder / "nested").commit(x_sleec="WHEN")
    assert gated(cli)[1]["unchanged"] == 1
    assert cli("gate", "--write-baseline", "--baseline", "known.json").code == 0
    (repository.folder / "nested" / "x.sleec").unlink()
    (repository.folder / "venv" / "x.sleec").unlink()
    assert cli("check", ".").code == 0
    assert cli("diff", ".", ".").code == 0


def test_rulesets_that_are_not_added_yet_are_looked_at(cli: Cli, repository: Repository) -> None:
    repository.put("deep/new.sleec", CLASH)
    assert [one["path"] for one in gated(cli)[1]["rulesets"]] == ["deep/new.sleec"]


@pytest.fixture
def submodule(repository: Repository, tmp_path_factory: pytest.TempPathFactory) -> Repository:
    """The checkout of a submodule `sub`, which `main` has."""
    other = Repository(tmp_path_factory.mktemp("other"))
    other.commit(x_sleec=OLD)
    repository.git("-c", "protocol.file.allow=always", "submodule", "--quiet", "add", str(other.folder), "sub")
    repository.commit()
    made = Repository(repository.folder / "sub")
    repository.git("checkout", "-q", "-b", "feature")
    return made


def test_a_submodule_is_examined_where_it_is_checked_out(
    cli: Cli, repository: Repository, submodule: Repository
) -> None:
    assert gated(cli)[1]["unchanged"] == 2
    assert gated(cli, "sub")[1]["unchanged"] == 1
    submodule.commit(x_sleec=CLASH)
    for committed in (False, True):
        if committed:
            repository.commit()
        code, said = gated(cli)
        assert (code, policies(said)) == (1, {"findings", "new-conflicts"})
        assert [one["path"] for one in said["rulesets"]] == ["sub/x.sleec"]


def test_a_submodule_that_is_not_checked_out_blocks_if_it_changes(
    cli: Cli, repository: Repository, submodule: Repository
) -> None:
    submodule.commit(x_sleec=CLASH)
    repository.commit()
    repository.git("submodule", "--quiet", "deinit", "--force", "sub")
    code, said = gated(cli)
    assert (code, policies(said), said["blocks"][0]["where"]) == (1, {"submodules"}, "sub")
    assert "sub cannot be read" in said["blocks"][0]["what"]
    repository.git("checkout", "-q", "main")
    repository.git("submodule", "--quiet", "deinit", "--force", "sub")
    assert gated(cli, base="main")[:1] == (0,), "it has not changed"


def test_a_submodule_without_the_commit_of_the_base_blocks(
    cli: Cli, repository: Repository, submodule: Repository, tmp_path_factory: pytest.TempPathFactory
) -> None:
    submodule.commit(x_sleec=LOST)
    repository.commit()
    shutil.rmtree(submodule.folder / ".git", ignore_errors=True)
    (submodule.folder / ".git").unlink(missing_ok=True)
    Repository(submodule.folder).commit()
    code, said = gated(cli)
    assert (code, policies(said)) == (1, {"submodules"})


def test_a_folder_that_becomes_a_submodule_is_missed(
    cli: Cli, repository: Repository, tmp_path_factory: pytest.TempPathFactory
) -> None:
    repository.put("rules/b.sleec", OLD)
    repository.commit()
    repository.git("checkout", "-q", "-b", "feature")
    other = Repository(tmp_path_factory.mktemp("other"))
    other.commit(b_sleec=LOST)
    repository.git("rm", "-rq", "rules")
    repository.git("-c", "protocol.file.allow=always", "submodule", "--quiet", "add", str(other.folder), "rules")
    repository.commit()
    config(repository, block='lost-obligations = ["p"]')
    repository.git("branch", "-f", "main", "HEAD~2")
    code, said = gated(cli, "--assert", "always p when t and c")
    assert (code, policies(said) & {"assertions"}) == (1, {"assertions"})
    repository.git("submodule", "--quiet", "deinit", "--force", "rules")
    code, said = gated(cli)
    assert code == 1
    assert {"deletions", "submodules"} <= policies(said)


def test_a_ruleset_that_disappears_blocks(cli: Cli, repository: Repository) -> None:
    repository.git("mv", "a.sleec", "a.txt")
    code, said = gated(cli)
    assert (code, policies(said)) == (1, {"deletions"})
    repository.git("mv", "a.txt", "a.SLEEC")
    assert gated(cli)[:1] == (0,)
    repository.put("a.SLEEC", CLASH)
    assert policies(gated(cli)[1]) == {"findings", "new-conflicts"}


def test_a_ruleset_that_becomes_a_link_is_examined(cli: Cli, repository: Repository, outside: Path) -> None:
    repository.put("b.sleec", CLASH)
    repository.commit()
    (repository.folder / "a.sleec").unlink()
    (repository.folder / "a.sleec").symlink_to("b.sleec")
    for committed in (False, True):
        if committed:
            repository.git("checkout", "-q", "-b", "feature")
            repository.commit()
        code, said = gated(cli)
        assert (code, policies(said)) == (1, {"findings", "new-conflicts"})
        assert [one["path"] for one in said["rulesets"]] == ["a.sleec"]
    (repository.folder / "a.sleec").unlink()
    (repository.folder / "a.sleec").symlink_to(outside / "secret")
    ran = cli("gate", "--base", "main")
    assert ran.code == 1
    assert "blocks: deletions: a.sleec" in ran.out
    assert "hunter2" not in ran.out + ran.err


def test_links_in_the_base_are_followed(cli: Cli, repository: Repository) -> None:
    repository.put("rules/b.sleec", OLD)
    (repository.folder / "link").symlink_to("other")
    (repository.folder / "other").symlink_to("rules")
    (repository.folder / "b.sleec").symlink_to("link/b.sleec")
    repository.commit()
    assert gated(cli)[1]["unchanged"] == 5
    (repository.folder / "link").unlink()
    code, said = gated(cli)
    assert code == 1
    assert {block["where"] for block in said["blocks"] if block["policy"] == "deletions"} == {"b.sleec", "link/b.sleec"}


def test_links_inside_the_repository_are_followed(cli: Cli, repository: Repository) -> None:
    (repository.folder / "link.sleec").symlink_to("a.sleec")
    (repository.folder / "broken.sleec").symlink_to("nothing.sleec")
    (repository.folder / "loop").symlink_to(".")
    code, said = gated(cli)
    assert (code, said["unchanged"], [one["path"] for one in said["rulesets"]]) == (0, 1, ["link.sleec"])
    repository.commit()
    assert gated(cli)[1]["unchanged"] == 2
    assert gated(cli, "link.sleec")[1]["unchanged"] == 1


def test_what_a_sparse_checkout_leaves_out_is_not_lost(cli: Cli, repository: Repository) -> None:
    repository.put("one/b.sleec", CLASH)
    repository.put("two/c.sleec", OLD)
    repository.commit()
    repository.git("sparse-checkout", "set", "two")
    assert not (repository.folder / "one").exists()
    config(repository, block='lost-obligations = ["*"]')
    assert gated(cli)[1]["unchanged"] == 3
    assert gated(cli, "--all")[1]["rulesets"][1]["path"] == "one/b.sleec"
    assert gated(cli, "one")[1]["unchanged"] == 1


def test_file_names_are_of_any_characters(cli: Cli, repository: Repository) -> None:
    names = [
        "a b.sleec",
        "q'u\"o.sleec",
        "ünï.sleec",
        "new\nline.sleec",
        "-dash.sleec",
        "st*r.sleec",
        "[x].sleec",
        ":c.sleec",
    ]
    names += [os.fsdecode(b"bytes\xff.sleec")]
    for name in names:
        repository.put(name, OLD)
    repository.commit()
    for name in names:
        repository.put(name, CLASH)
    code, said = gated(cli, "--summary", "out.md")
    assert (code, {one["path"] for one in said["rulesets"]}, said["unchanged"]) == (1, set(names), 1)
    (repository.folder / "out.md").read_text(encoding="utf-8")
    for name in names:
        assert [one["path"] for one in gated(cli, "--", f"./{name}")[1]["rulesets"]] == [name]
    for form in FORMATS:
        assert cli("gate", "--base", "main", "--format", form, "--output", "report").code == 1
        (repository.folder / "report").read_bytes()
    assert cli("gate", "--write-baseline", "--baseline", "known.json").code == 0
    repository.keep("known.json")
    assert gated(cli, "--baseline", "known.json")[0] == 0


def test_line_breaks_and_marks_of_editors_change_nothing(cli: Cli, repository: Repository) -> None:
    text = "\ufeff" + with_fingerprints(CLASH.replace("RULE b", "# sleec: allow SLEEC101@? because fine\nRULE b"))
    (repository.folder / "a.sleec").write_bytes(text.replace("\n", "\r\n").encode())
    config(repository, block="new-suppressions = false")
    code, said = gated(cli)
    assert (code, len(said["rulesets"][0]["allowed"])) == (0, 1)
    (repository.folder / "a.sleec").write_bytes(("\ufeff" + OLD.replace("\n", "\r\n")).encode())
    assert gated(cli)[1]["rulesets"][0]["relation"] == "equivalent"


def test_from_a_folder_below(cli: Cli, repository: Repository, monkeypatch: pytest.MonkeyPatch) -> None:
    repository.put("sub/b.sleec", CLASH)
    monkeypatch.chdir(repository.folder / "sub")
    code, said = gated(cli, "--assert", "never p when not c")
    assert (code, {block["where"] for block in said["blocks"]}) == (1, {"sub/b.sleec"})
    assert said["unchanged"] == 0
    code, said = gated(cli, "..", "--assert", "never o")
    assert {block["where"] for block in said["blocks"]} == {"a.sleec", "sub/b.sleec"}
    assert {one["ruleset"] for one in said["assertions"]} == {"a.sleec", "sub/b.sleec"}


def test_detached_shallow_and_other_worktrees(
    cli: Cli, repository: Repository, monkeypatch: pytest.MonkeyPatch, tmp_path_factory: Any
) -> None:
    repository.commit()
    repository.git("checkout", "-q", "--detach")
    assert gated(cli)[1]["unchanged"] == 1
    aside = tmp_path_factory.mktemp("aside")
    repository.git("clone", "-q", "--bare", ".", str(aside / "bare"))
    repository.git("-C", str(aside / "bare"), "worktree", "add", "-q", str(aside / "tree"), "main")
    monkeypatch.chdir(aside / "tree")
    assert gated(cli)[1]["unchanged"] == 1
    for folder in (aside / "bare", repository.folder / ".git"):
        monkeypatch.chdir(folder)
        ran = cli("gate", "--base", "main")
        assert (ran.code, "is inside a git directory" in ran.err) == (2, True)
    url = (repository.folder / ".git").as_uri()
    repository.git("clone", "-q", "--depth", "1", "--branch", "main", url, str(aside / "shallow"))
    monkeypatch.chdir(aside / "shallow")
    assert gated(cli)[1]["unchanged"] == 1
    ran = cli("gate", "--base", "origin/release-2026")
    assert "in CI, fetch it first (git fetch origin release-2026), and name it origin/release-2026" in ran.err
    repository.git("-C", str(aside / "shallow"), "checkout", "-q", "--detach")
    repository.git("-C", str(aside / "shallow"), "branch", "-q", "-D", "main")
    assert "did you mean origin/main?" in cli("gate", "--base", "main").err
    alone = Repository(tmp_path_factory.mktemp("alone"))
    alone.write(a_sleec=OLD)
    monkeypatch.chdir(alone.folder)
    ran = cli("gate", "--base", "main")
    assert (ran.code, "the repository has no commits" in ran.err) == (2, True)


def test_a_repository_of_somebody_else(cli: Cli, repository: Repository, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("GIT_TEST_ASSUME_DIFFERENT_OWNER", "1")
    ran = cli("gate", "--base", "main")
    assert (ran.code, "git does not trust this repository" in ran.err) == (2, True)
    assert "safe.directory" in ran.err


@pytest.mark.parametrize("place", ["nowhere/summary", "."])
def test_a_summary_that_cannot_be_written(place: str, cli: Cli, repository: Repository, monkeypatch: Any) -> None:
    ran = cli("gate", "--base", "main", "--summary", place)
    assert (ran.code, ran.out) == (2, "")
    monkeypatch.setenv("GITHUB_STEP_SUMMARY", place)
    ran = cli("gate", "--base", "main")
    assert (ran.code, "(from $GITHUB_STEP_SUMMARY) cannot be written" in ran.err) == (2, True)


def test_a_long_summary_is_cut(cli: Cli, repository: Repository) -> None:
    rules = "".join(f"RULE r{i}\nWHEN t{i} THEN o{i} AND NOT o{i}\n" for i in range(60))
    repository.write(a_sleec=rules)
    assert cli("gate", "--base", "main", "--summary", "out.md").code == 1
    text = (repository.folder / "out.md").read_text(encoding="utf-8")
    assert re.search(r"^- … and \d+ more reasons: see the log$", text, re.MULTILINE)
    assert re.search(r"^- … and \d+ more changes: see the log$", text, re.MULTILINE)
    for number in range(60):
        repository.put(f"many/{number}.sleec", OLD)
    assert cli("gate", "--base", "main", "--summary", "out.md").code == 1
    assert "| … and 11 more rulesets: see the log | | |" in (repository.folder / "out.md").read_text(encoding="utf-8")


@pytest.mark.parametrize("data", [b"\xff\xfe\x00", b"RULE a\0", bytes(range(256))])
def test_what_is_no_text(cli: Cli, repository: Repository, data: bytes) -> None:
    (repository.folder / "a.sleec").write_bytes(data)
    assert cli("gate", "--base", "main").code == 2
    repository.commit()
    repository.write(a_sleec=OLD)
    ran = cli("gate", "--base", "main")
    assert (ran.code, "main:a.sleec" in ran.err) == (2, True)
