"""What `gate` compares with, and what it examines."""

from __future__ import annotations

import json
import shutil

import pytest

from tests.support.cli import Cli
from tests.support.gates import CLASH, LOST, OLD, config, gated
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
    config(repository, block='lost-obligations = ["o"]')
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
