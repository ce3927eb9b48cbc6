"""Configurations, arguments and rulesets that `gate` refuses."""

from __future__ import annotations

import shutil

import pytest

from tests.support.cli import Cli
from tests.support.gates import CLASH, OLD
from tests.support.repository import Repository

pytestmark = pytest.mark.skipif(shutil.which("git") is None, reason="there is no git on this machine")


@pytest.mark.parametrize(
    ("text", "message", "hint"),
    [
        ("[tool.sleec-verify]\nblok = {}", "unknown key `blok`", "did you mean `block`?"),
        (
            "[tool.sleec-verify.block]\nnew-conflict = true",
            "unknown key `block.new-conflict`",
            "did you mean `new-conflicts`?",
        ),
        ("[tool.sleec-verify.block]\nzzz = true", "unknown key `block.zzz`", "the keys are certificates, clause-"),
        ("[tool.sleec-verify]\nbase = 3", "base is 3", "it is a text"),
        ("[tool.sleec-verify]\nrulesets = [3]", "rulesets is [3]", "it is a list of texts"),
        ("[tool.sleec-verify.block]\nunknown = 1", "block.unknown is 1", "true or false"),
        ("[tool.sleec-verify.block]\nfindings = 'bad'", "block.findings is 'bad'", "one of error"),
        ("[tool.sleec-verify.block]\nclause-coverage = 101", "block.clause-coverage is 101", "0 to 100"),
        ("[tool.sleec-verify.block]\nclause-coverage = true", "block.clause-coverage is True", "0 to 100"),
        ("[tool]\nsleec-verify = 3", "the table is 3", "a table"),
        ("[[tool.sleec-verify.targets]]\ncode = 'robot.py'", "targets has no rules", "needs both code and rules"),
        ("[[tool.sleec-verify.targets]]\ncod = 'robot.py'", "unknown key `targets.cod`", "did you mean `code`?"),
    ],
)
def test_configurations_that_are_none(cli: Cli, repository: Repository, text: str, message: str, hint: str) -> None:
    repository.put("pyproject.toml", text)
    ran = cli("gate", "--base", "main")
    assert ran.code == 2
    assert f"error: pyproject.toml: [tool.sleec-verify] {message}" in ran.err
    assert hint in ran.err


def test_its_own_file_comes_first(cli: Cli, repository: Repository) -> None:
    repository.put("pyproject.toml", "[tool.sleec-verify]\nnonsense = 1\n")
    repository.put("sleec-verify.toml", 'base = "main"\n')
    repository.keep("sleec-verify.toml")
    assert cli("gate").code == 0
    repository.put("sleec-verify.toml", "bse = 1\n")
    ran = cli("gate")
    assert ran.code == 2
    assert "sleec-verify.toml: unknown key `bse`" in ran.err.replace("toml: ", "toml: ", 1)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ([], "name the base revision"),
        (["--base", "mian"], "did you mean main?"),
        (["--base", "main", "--config", "nothing.toml"], "file nothing.toml does not exist"),
        (["--base", "main", "--config", "broken.toml"], "is not TOML"),
        (["--base", "main", "--baseline", "nothing.json"], "baseline nothing.json does not exist"),
        (["--base", "main", "--summary", "a.sleec"], "exists and is not a summary"),
        (["--base", "main", "nothing.sleec"], "there is no .sleec file at or below nothing.sleec"),
        (["--write-baseline"], "name the baseline file"),
    ],
)
def test_bad_usage(cli: Cli, repository: Repository, arguments: list[str], message: str) -> None:
    repository.put("broken.toml", "= 3")
    ran = cli("gate", *arguments)
    assert ran.code == 2
    assert message in ran.err
    assert (repository.folder / "a.sleec").read_text() == OLD


def test_a_ruleset_that_is_none_now(cli: Cli, repository: Repository) -> None:
    repository.write(a_sleec="WHEN", b_sleec=CLASH)
    ran = cli("gate", "--base", "main", "--summary", "out.md")
    assert ran.code == 2
    assert "a.sleec:1:5: error" in ran.err
    assert "a and b now contradict each other about o" in ran.out  # the others are examined all the same
    assert "### Unreadable files" in (repository.folder / "out.md").read_text()


def test_a_ruleset_that_was_none_before(cli: Cli, repository: Repository) -> None:
    repository.commit(a_sleec="WHEN")
    repository.write(a_sleec=OLD)
    ran = cli("gate", "--base", "main")
    assert ran.code == 2
    assert "main:a.sleec:1:5: error" in ran.err
