"""`diff` of files and folders, its exit codes and what it writes."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.fast.cli.test_bad_inputs import INPUTS
from tests.support.cli import Cli
from tests.support.diffs import CLASH, LESS, MORE, OLD, SAME


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
    assert "gone.sleec was deleted: it is not in two" in ran.err
    assert "new.sleec was added: it is not in one" in ran.err
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
    assert (
        "(two/b.sleec): `c` is a measure in these rules, but a condition in the rules of the assertion" in several.out
    )


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
        (["a.sleec", "nothing.sleec"], "file nothing.sleec does not exist"),
        (["a.sleec", "."], ". is a folder, but a.sleec is not"),
        (["empty", "nothing"], "folder nothing does not exist"),
        (["nothing", "empty"], "folder nothing does not exist"),
        (["-", "empty"], "empty is a folder, but - is not"),
        (["-", "-"], "standard input cannot be both sides"),
        (["-", "a.sleec", "--assertions", "-"], "standard input cannot be both rules and assertions"),
        (["empty", "empty"], "there is no .sleec file below"),
        (["a.sleec", "a.sleec", "--assertions", "nothing"], "file nothing does not exist"),
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
    assert "fault in sleec-verify" not in ran.err
    assert json.loads(ran.out)["rulesets"][0]["errors"]
