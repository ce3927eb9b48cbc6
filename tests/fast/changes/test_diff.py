"""`diff` from end to end: files, folders, git, its exit codes and what it writes."""

from __future__ import annotations

import json
import os
import shutil
from pathlib import Path
from typing import Any

import pytest

from tests.fast.cli.test_bad_inputs import INPUTS
from tests.support.cli import Cli
from tests.support.repository import Repository

OLD = "RULE a\nWHEN t THEN o\nUNLESS c IN WHICH CASE p\n"
SAME = "RULE z\nWHEN t THEN o\nUNLESS NOT NOT c IN WHICH CASE p\n"
MORE = "RULE a\nWHEN t THEN o AND q\nUNLESS c IN WHICH CASE p\n"
LESS = "RULE a\nWHEN t AND NOT c THEN o\n"
CLASH = OLD + "RULE b\nWHEN t THEN NOT o\n"

needs_git = pytest.mark.skipif(shutil.which("git") is None, reason="there is no git on this machine")


@pytest.fixture
def repository(tmp_path: Path) -> Repository:
    return Repository(tmp_path)


# Files and folders ----------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("new", "arguments", "code"),
    [
        (OLD, [], 0),
        (SAME, [], 0),
        (MORE, [], 1),
        (LESS, [], 1),
        (CLASH, [], 1),
        (MORE, ["--fail-on", "loss"], 0),
        (LESS, ["--fail-on", "loss"], 1),
        (CLASH, ["--fail-on", "loss"], 1),
        (LESS, ["--fail-on", "conflict"], 0),
        (CLASH, ["--fail-on", "conflict"], 1),
        (CLASH, ["--fail-on", "nothing"], 0),
        (OLD, ["--assert", "never q"], 2),
        (OLD, ["--assert", "never p when not c"], 0),
        (OLD, ["--assert", "never p"], 1),
        (MORE, ["--fail-on", "nothing", "--assert", "never q"], 1),
        ("RULE a\nWHEN t THEN o UNLESS c > 3\n", [], 3),
        ("RULE a\nWHEN", [], 2),
    ],
)
def test_exit_codes(cli: Cli, new: str, arguments: list[str], code: int) -> None:
    ran = cli("diff", "old.sleec", "new.sleec", *arguments, files={"old.sleec": OLD, "new.sleec": new})
    assert ran.code == code, ran


@pytest.mark.parametrize("form", ["full", "concise", "json"])
@pytest.mark.parametrize("new", [OLD, SAME, MORE, LESS, CLASH])
def test_every_format_names_the_relation(cli: Cli, form: str, new: str) -> None:
    relation = {OLD: "equivalent", SAME: "equivalent", MORE: "stricter", LESS: "laxer", CLASH: "incomparable"}[new]
    ran = cli("diff", "old.sleec", "new.sleec", "--format", form, files={"old.sleec": OLD, "new.sleec": new})
    assert relation in ran.out
    assert ran.err == ""


def test_json_is_that_of_the_design(cli: Cli) -> None:
    files = {"old.sleec": OLD, "new.sleec": MORE}
    said = json.loads(
        cli("diff", "old.sleec", "new.sleec", "--format", "json", "--assert", "never q when c", files=files).out
    )
    assert said["relation"] == "stricter"
    (change,) = said["changes"]
    assert (change["obligation"], change["change"], change["rules"]) == ("q", "added", ["a"])
    assert change["witness"] == {"triggers": ["t"], "conditions": {"c": False}}
    assert change["before"] == [
        {
            "rule": "a",
            "clause": 0,
            "obligations": ["o"],
            "span": {"line": 2, "column": 13, "end_line": 2, "end_column": 14},
        }
    ] or change["before"][0]["obligations"] == ["o"]
    assert change["situations"] == {
        "affected": 1,
        "possible": 2,
        "given": ["t"],
        "over": [{"names": ["c"], "ways": 2}],
        "reason": None,
    }
    assert said["names"] == [{"change": "added", "kind": "obligation", "name": "q", "ruleset": "new.sleec"}]
    assert [one["holds"] for one in said["assertions"]] == [True]
    assert said["summary"] == {"rulesets": 1, "unchanged": 0, "added": 1, "removed": 0, "new_conflicts": 0}


def test_folders_are_compared_file_by_file(cli: Cli) -> None:
    files = {"one/a.sleec": OLD, "one/deep/b.sleec": OLD, "two/a.sleec": MORE, "two/deep/b.sleec": SAME}
    ran = cli("diff", "one", "two", files=files)
    assert ran.code == 1
    assert "two/a.sleec: stricter" in ran.out
    assert "two/deep/b.sleec: equivalent" in ran.out
    assert "2 rulesets: stricter" in ran.out


def test_a_file_that_only_one_folder_has_is_told(cli: Cli) -> None:
    files = {"one/a.sleec": OLD, "one/gone.sleec": OLD, "two/a.sleec": OLD, "two/new.sleec": MORE}
    ran = cli("diff", "one", "two", files=files)
    assert ran.code == 2
    assert "gone.sleec is not in two: it was deleted" in ran.err
    assert "new.sleec is not in one: it was added" in ran.err
    assert "two/a.sleec: equivalent" in ran.out


def test_a_missing_file_can_count_as_no_rules(cli: Cli) -> None:
    files = {"one/gone.sleec": OLD, "two/new.sleec": MORE}
    ran = cli("diff", "one", "two", "--missing-as-empty", "--format", "json", files=files)
    assert ran.code == 1
    assert {(c["obligation"], c["change"]) for c in json.loads(ran.out)["changes"]} == {
        ("o", "removed"),
        ("p", "removed"),
        ("o", "added"),
        ("p", "added"),
        ("q", "added"),
    }


def test_readings_of_the_sides(cli: Cli) -> None:
    text = "RULE a\nWHEN t THEN o UNLESS c IN WHICH CASE p UNLESS d IN WHICH CASE q\n"
    assert cli("diff", "a.sleec", "a.sleec", "--new-reading", "priority", files={"a.sleec": text}).code == 1
    assert cli("diff", "a.sleec", "a.sleec", "--reading", "priority").code == 0
    both = cli("diff", "a.sleec", "a.sleec", "--old-reading", "priority", "--new-reading", "priority")
    assert both.code == 0


def test_standard_input_is_one_side(cli: Cli, monkeypatch: pytest.MonkeyPatch) -> None:
    import io

    class Stdin:
        buffer = io.BytesIO(MORE.encode())

    monkeypatch.setattr("sys.stdin", Stdin())
    ran = cli("diff", "a.sleec", "-", files={"a.sleec": OLD})
    assert ran.code == 1
    assert "a.sleec -> <stdin>: stricter" in ran.out


def test_an_assertion_about_names_of_an_unreadable_side_is_not_blamed(cli: Cli) -> None:
    line = ("diff", "old.sleec", "new.sleec", "--assert", "never p when c", "--format", "json")
    ran = cli(*line, files={"old.sleec": "WHEN", "new.sleec": OLD})
    assert ran.code == 2
    assert "old.sleec:1:" in ran.err
    assert "never p" not in ran.err
    assert json.loads(ran.out)["assertions"] == []


def test_an_assertion_is_read_as_the_new_rules_take_its_names(cli: Cli) -> None:
    measured = "MEASURE c: number\nRULE a\nWHEN t THEN o\nUNLESS c > 2 IN WHICH CASE p\n"
    files = {"old.sleec": OLD, "new.sleec": measured}
    wrong = cli("diff", "old.sleec", "new.sleec", "--assert", "never p when c", files=files)
    assert wrong.code == 2
    assert "--assert:1:14: error: `c` is a measure, neither true nor false" in wrong.err
    right = cli("diff", "old.sleec", "new.sleec", "--assert", "never p when c <= 2")
    assert "holds: never p when c <= 2" in right.out
    # Of several rulesets, one may take the name for something else: nobody can say what the assertion means to it.
    both = {f"{side}/{name}.sleec": text for side in ("one", "two") for name, text in (("a", OLD), ("b", measured))}
    several = cli("diff", "one", "two", "--assert", "never q when c", "--assert", "never o when c", files=both)
    assert several.code == 2
    several = cli("diff", "one", "two", "--assert", "never o when c")
    assert several.code == 3
    assert "(two/b.sleec): c is a measure in these rules, and a condition where the assertion was read" in several.out


def test_a_file_of_assertions(cli: Cli) -> None:
    files = {"a.sleec": OLD, "must.txt": "# safety\nnever p when not c\nalways o when t\n"}
    ran = cli("diff", "a.sleec", "a.sleec", "--assertions", "must.txt", files=files)
    assert ran.code == 1
    assert "holds: never p when not c" in ran.out
    assert "broken: always o when t" in ran.out
    wrong = cli("diff", "a.sleec", "a.sleec", "--assertions", "must.txt", files={"must.txt": "never p\nnever oo\n"})
    assert wrong.code == 2
    assert "must.txt:2:7: error: `oo` is not in the rules" in wrong.err


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["a.sleec"], "two files, two folders"),
        (["a.sleec", "a.sleec", "a.sleec"], "two files, two folders"),
        (["a.sleec", "nothing.sleec"], "there is no file nothing.sleec"),
        (["a.sleec", "."], ". is a folder, and a.sleec is not"),
        (["empty", "nothing"], "there is no folder nothing"),
        (["nothing", "empty"], "there is no folder nothing"),
        (["-", "empty"], "empty is a folder, and - is not"),
        (["-", "-"], "standard input cannot be both sides"),
        (["-", "a.sleec", "--assertions", "-"], "standard input cannot be both rules and assertions"),
        (["empty", "empty"], "there is no .sleec file below"),
        (["a.sleec", "a.sleec", "--assertions", "nothing"], "there is no file nothing"),
        (["domains.sleec", "domains.sleec", "--domain", "hme"], "did you mean `home`?"),
    ],
)
def test_bad_input(cli: Cli, tmp_path: Path, arguments: list[str], message: str) -> None:
    (tmp_path / "empty").mkdir()
    ran = cli("diff", *arguments, files={"a.sleec": OLD, "domains.sleec": "DOMAIN home\n" + OLD})
    assert ran.code == 2
    assert message in ran.err
    assert "Traceback" not in ran.err


@pytest.mark.parametrize("name", INPUTS)
@pytest.mark.parametrize("side", [0, 1])
def test_what_is_no_ruleset(cli: Cli, tmp_path: Path, name: str, side: int) -> None:
    (tmp_path / "bad.sleec").write_bytes(INPUTS[name])
    paths = ["bad.sleec", "a.sleec"] if side == 0 else ["a.sleec", "bad.sleec"]
    ran = cli("diff", *paths, "--format", "json", files={"a.sleec": OLD})
    assert ran.code == 2
    assert "error: " in ran.err
    assert "mistake in sleec-verify" not in ran.err
    assert json.loads(ran.out)["rulesets"][0]["errors"]


# Git ------------------------------------------------------------------------------------------------------


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
    assert "a.sleec is not in the files as they are now: it was deleted" in ran.err
    assert "b.sleec is not in main: it was added" in ran.err
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
        (["--git", "main...alone"], "error: main and alone have no commit in common"),
        (
            ["--git", "main~7"],
            "there is no revision main~7 in this repository\n  = help: in CI, fetch the whole history",
        ),
        (["--git", "main:a.sleec"], "name a commit, and the file behind it: --git main a.sleec"),
        (["--git", ":/nothing"], "no commit that HEAD or a branch reaches has a message with this text"),
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
    assert "there is no revision HEAD in this repository\n  = help: nothing has been committed yet" in ran.err


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
    assert "no git" in ran.err


def test_no_git(cli: Cli, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", "")
    ran = cli("diff", "--git", "main")
    assert ran.code == 2
    assert "there is no git on this machine" in ran.err
