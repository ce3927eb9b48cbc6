"""Cases, certificates and assertions beside the rules, and the cache of `gate`."""

from __future__ import annotations

import shutil
from typing import Any

import pytest

from tests.support.cli import Cli
from tests.support.gates import BOTH, CASES, CLASH, config, gated, policies
from tests.support.repository import Repository

pytestmark = pytest.mark.skipif(shutil.which("git") is None, reason="there is no git on this machine")


def test_cases_that_are_gone_are_a_change(cli: Cli, repository: Repository) -> None:
    repository.commit(a_cases_toml=BOTH)
    config(repository, block="clause-coverage = 100")
    assert gated(cli)[1]["unchanged"] == 1
    for now in (CASES, None):
        repository.write(a_cases_toml=now)
        code, said = gated(cli)
        missing = {"policy-changes"} if now is None else set()
        assert (code, policies(said)) == (1, {"clause-coverage"} | missing)


def test_a_certificate_that_is_gone_is_a_change(cli: Cli, repository: Repository) -> None:
    assert cli("certify", "a.sleec", "-o", "a.certificate").code == 0
    repository.commit()
    config(repository, block="certificates = true")
    assert gated(cli)[1]["unchanged"] == 1
    shutil.rmtree(repository.folder / "a.certificate")
    code, said = gated(cli)
    assert (code, policies(said)) == (1, {"certificates", "policy-changes"})


def test_assertions_are_asked_of_what_is_the_same_and_nothing_else_is(cli: Cli, repository: Repository) -> None:
    repository.commit(b_sleec=CLASH)
    assert gated(cli, "--assert", "never p when not c")[0] == 0
    code, said = gated(cli, "--assert", "never p")
    assert (code, said["unchanged"], said["rulesets"]) == (1, 2, [])
    assert [(block["policy"], block["where"]) for block in said["blocks"]] == [
        ("assertions", "a.sleec"),
        ("assertions", "b.sleec"),
    ]
    repository.commit(b_sleec="WHEN")
    assert gated(cli)[0] == 0
    code, said = gated(cli, "--assert", "never p when not c")
    assert (code, [one["path"] for one in said["rulesets"]]) == (2, ["b.sleec"])


def test_an_assertion_is_asked_of_those_whom_it_concerns(cli: Cli, repository: Repository) -> None:
    repository.commit(b_sleec="RULE b\nWHEN u THEN x\n")
    always = ("--assert", "always x when u")
    code, said = gated(cli, *always)
    assert (code, [one["ruleset"] for one in said["assertions"]]) == (0, ["b.sleec"])
    # Nobody gets around it by taking away what it is about.
    for now in ("RULE c\nWHEN v THEN y\n", None):
        repository.write(b_sleec=now)
        code, said = gated(cli, *always)
        deleted = {"deletions"} if now is None else set()
        assert (code, policies(said), said["blocks"][0]["where"]) == (1, {"assertions"} | deleted, "b.sleec")
        assert cli("gate", "--base", "main", "--format", "sarif", *always).code == 1
    assert cli("gate", "--base", "main", "--assert", "always z when w").code == 2


def test_what_is_decided_once_is_kept(
    cli: Cli, repository: Repository, monkeypatch: pytest.MonkeyPatch, tmp_path_factory: Any
) -> None:
    kept = tmp_path_factory.mktemp("kept")
    monkeypatch.setenv("SLEEC_VERIFY_CACHE", str(kept))
    repository.write(a_sleec=CLASH)
    first = cli("gate", "--base", "main")
    (entry,) = (path for path in kept.rglob("*") if path.is_file() and path.name != ".gitignore")

    def solve(*_: object, **__: object) -> None:
        raise AssertionError("solved again")

    with monkeypatch.context() as patched:
        patched.setattr("sleec_verify.checks.run_checks", solve)
        assert cli("gate", "--base", "main") == first
        assert cli("gate", "--base", "main", "--no-cache").code == 2
    entry.write_bytes(entry.read_bytes().replace(b"SLEEC101", b"SLEEC503"))
    ran = cli("gate", "--base", "main")
    assert (ran.code, ran.out) == (1, first.out)
    assert "is damaged; its results are recomputed" in ran.err


@pytest.mark.parametrize("evidence", ["a.cases.toml", "a.certificate/manifest.json"])
@pytest.mark.parametrize("moved", [True, False])
def test_evidence_that_is_moved_away_is_listed(cli: Cli, repository: Repository, evidence: str, moved: bool) -> None:
    repository.put(evidence, CASES)
    repository.commit()
    repository.git("mv", evidence.partition("/")[0], "elsewhere")
    if moved:
        repository.git("mv", "a.sleec", "b.sleec")
    code, said = gated(cli)
    ruleset = "b.sleec" if moved else "a.sleec"
    assert (code, policies(said), said["blocks"][0]["where"]) == (1, {"policy-changes"}, ruleset)
    assert f"the base has {evidence.partition('/')[0]}" in said["blocks"][0]["what"]
    repository.git("mv", "elsewhere", ruleset.replace(".sleec", evidence.partition("/")[0][1:]))
    assert gated(cli)[0] == 0
