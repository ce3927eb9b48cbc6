"""`check` honours suppressions and a baseline: what they allow is a note with its reason, and does not count."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.support.cli import Cli
from tests.support.gates import CLASH, with_fingerprints

ALLOWED = with_fingerprints(CLASH.replace("RULE b", "# sleec: allow SLEEC101@? because the nurse decides\nRULE b"))


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def conflicts(cli: Cli, *arguments: str) -> list[tuple[str, str | None]]:
    said = json.loads(cli("check", *arguments, "--format", "json").out)
    found = (one for ruleset in said["rulesets"] for one in ruleset["findings"])
    return [(one["severity"], one.get("allowed")) for one in found if one["code"] == "SLEEC101"]


def test_a_suppressed_finding_is_a_note(cli: Cli, folder: Path) -> None:
    (folder / "a.sleec").write_text(ALLOWED)
    assert conflicts(cli, "a.sleec") == [("note", "the nurse decides")]
    ran = cli("check", "a.sleec", "--fail-level", "note")
    assert "note[SLEEC101]" in ran.out
    assert "= note: allowed: the nurse decides" in ran.out
    sarif = json.loads(cli("check", "a.sleec", "--format", "sarif").out)
    results = {one["ruleId"]: one for one in sarif["runs"][0]["results"]}
    assert results["SLEEC101"]["suppressions"][0]["justification"] == "the nurse decides"
    assert cli("check", "a.sleec").code == 0
    (check,) = (
        one
        for one in json.loads(cli("check", "a.sleec", "--format", "json").out)["rulesets"][0]["checks"]
        if one["name"] == "conflict"
    )
    assert check["verdict"] == "refuted", "what is allowed is not proved"


def test_a_changed_rule_is_allowed_no_longer(cli: Cli, folder: Path) -> None:
    (folder / "a.sleec").write_text(ALLOWED.replace("UNLESS c IN WHICH CASE p\n", ""))
    assert conflicts(cli, "a.sleec") == [("error", None)]
    ran = cli("check", "a.sleec")
    assert ran.code == 1
    assert "to allow this finding, write: # sleec: allow SLEEC101@" in ran.out


def test_a_baseline_is_honoured(cli: Cli, folder: Path) -> None:
    from sleec_runtime.language import load
    from sleec_verify.changes.gate.baseline import baseline_text, key
    from sleec_verify.checks import run_checks

    (folder / "rules").mkdir()
    (folder / "rules" / "a.sleec").write_text(CLASH)
    ruleset = load("rules/a.sleec")
    findings = [finding for result in run_checks(ruleset) for finding in result.findings]
    (folder / "known.json").write_text(baseline_text(key("rules/a.sleec", ruleset, one) for one in findings))
    assert cli("check", "rules", "--baseline", "known.json").code == 0
    assert conflicts(cli, "rules", "--baseline", "known.json") == [("note", "it is in the baseline")]
    (folder / "rules" / "a.sleec").rename(folder / "rules" / "b.sleec")
    assert cli("check", "rules", "--baseline", "known.json").code == 1
    assert cli("check", "rules", "--baseline", "nothing.json").code == 2
    (folder / "known.json").write_text("{}")
    assert "is not a baseline" in cli("check", "rules", "--baseline", "known.json").err
