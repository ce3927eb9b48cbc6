"""Issues of GitLab, fingerprints and paths."""

from __future__ import annotations

import json
import os
import xml.etree.ElementTree as ET
from collections.abc import Callable
from pathlib import Path
from urllib.parse import unquote

import pytest

from sleec_verify.report import FORMATS
from tests.support.cli import Cli
from tests.support.formats import CLASH, VALIDATOR, checked_text, is_complete, sarif, shown
from tests.support.paths import ROOT


def fingerprints(text: str, path: str = "a.sleec") -> list[str]:
    outcome = checked_text(text, path)
    gitlab = [issue["fingerprint"] for issue in json.loads(shown("gitlab", outcome))]
    of_sarif = [result["partialFingerprints"]["sleecFinding/v1"] for result in sarif(outcome)["results"]]
    assert gitlab == of_sarif
    return gitlab


MANY = CLASH + "EXCLUSIVE Ask, Wave\nRULE three\nWHEN Rung THEN Wave\nUNLESS Calm AND NOT Calm IN WHICH CASE Sit\n"


def test_gitlab_issues_have_what_gitlab_reads() -> None:
    issues = json.loads(shown("gitlab", checked_text(MANY, "./a.sleec")))
    assert len(issues) > 2
    for issue in issues:
        assert set(issue) == {"description", "check_name", "fingerprint", "severity", "location"}
        assert issue["severity"] in ("info", "minor", "major", "critical", "blocker")
        assert issue["location"]["path"] == "a.sleec"
        assert issue["location"]["lines"]["begin"] >= 1


@pytest.mark.parametrize(
    "moved",
    [
        lambda text: "\n\n// a comment\n\n" + text,
        lambda text: text.replace("RULE two", "\n\nRULE two"),
        lambda text: "WHEN Knocked THEN Listen\n" + text,
        lambda text: text.replace("WHEN Rung THEN Open", "WHEN   Rung\n  THEN Open"),
    ],
)
def test_fingerprints_stay_where_lines_move(moved: Callable[[str], str]) -> None:
    assert set(fingerprints(MANY)) == set(fingerprints(moved(MANY)))


def test_fingerprints_stay_where_labels_are_numbers() -> None:
    unlabelled = "WHEN Rung THEN Open\nWHEN Storm THEN NOT Open\n"
    assert fingerprints(unlabelled) == fingerprints("WHEN Knocked THEN Listen\n" + unlabelled)


def test_fingerprints_differ_where_findings_do() -> None:
    found = fingerprints(MANY)
    assert len(set(found)) == len(found)
    assert set(found).isdisjoint(fingerprints(MANY, "b.sleec"))
    twice = "WHEN Rung THEN Open\nWHEN Storm THEN NOT Open\n"
    same = fingerprints(twice + "DOMAIN home\n" + twice)
    assert len(set(same)) == len(same)


def test_paths_are_those_of_the_project(cli: Cli, tmp_path: Path) -> None:
    inside, outside = str(tmp_path / "rules" / "a b.sleec"), str(ROOT / "rulesets" / "night-watch.sleec")
    ran = cli("check", inside, outside, "--format", "sarif", files={"rules/a b.sleec": CLASH})
    VALIDATOR.validate(json.loads(ran.out))
    artifacts = [a["location"]["uri"] for a in json.loads(ran.out)["runs"][0]["artifacts"]]
    assert artifacts == ["rules/a%20b.sleec", f"file://{outside}"]
    issues = json.loads(cli("check", inside, "--format", "gitlab").out)
    assert {issue["location"]["path"] for issue in issues} == {"rules/a b.sleec"}


@pytest.mark.parametrize("form", FORMATS)
def test_a_name_that_is_no_text(form: str, cli: Cli, tmp_path: Path) -> None:
    try:
        (tmp_path / os.fsdecode(b"\xff.sleec")).write_text(CLASH)
    except OSError:
        pytest.skip("this file system has names in UTF-8 only")
    ran = cli("check", ".", "--format", form, "-o", "report")
    assert ran.code == 1
    written = (tmp_path / "report").read_bytes()
    if form == "sarif":
        log = json.loads(written)
        VALIDATOR.validate(log)
        uri = log["runs"][0]["artifacts"][0]["location"]["uri"]
        assert unquote(uri, errors="surrogateescape") == os.fsdecode(b"\xff.sleec")
    elif form == "junit":
        ET.fromstring(written)


def test_a_problem_without_a_place_is_told_in_every_format(cli: Cli) -> None:
    for form in FORMATS:
        ran = cli("check", "missing.sleec", "--format", form)
        assert ran.code == 2
        if form not in ("full", "concise"):
            assert "missing.sleec" in ran.out
            is_complete(form, ran.out, 2)
