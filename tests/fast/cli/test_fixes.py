"""`check --fixes` lists repairs in every format for which it is defined. The text is in documents/good/fixes.txt."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from tests.support.cli import Cli
from tests.support.formats import VALIDATOR
from tests.support.schemas import validator

RULES = """\
RULE privacy
WHEN CurtainsRequested THEN OpenCurtains
UNLESS UserUndressed IN WHICH CASE NOT OpenCurtains
UNLESS Night AND NOT Night

RULE air
WHEN CurtainsRequested AND RoomStuffy THEN OpenCurtains AND OpenWindow
"""


def findings(cli: Cli, *options: str, text: str = RULES) -> list[dict[str, Any]]:
    ran = cli("check", "--format", "json", "--fixes", *options, "a.sleec", files={"a.sleec": text})
    found = json.loads(ran.out)
    validator("check").validate(found)
    listed: list[dict[str, Any]] = found["rulesets"][0]["findings"]
    return listed


def changed(text: str, repair: dict[str, Any]) -> str:
    """The text with the edits of a repair, by their lines and columns."""
    lines = text.splitlines(keepends=True)

    def offset(line: int, column: int) -> int:
        return sum(map(len, lines[: line - 1])) + column - 1

    for edit in sorted(repair["edits"], key=lambda edit: (edit["span"]["line"], edit["span"]["column"]), reverse=True):
        span = edit["span"]
        start, end = offset(span["line"], span["column"]), offset(span["end_line"], span["end_column"])
        text = text[:start] + edit["text"] + text[end:]
    return text


def test_each_listed_repair_removes_its_finding(cli: Cli) -> None:
    before = findings(cli)
    codes = sorted(finding["code"] for finding in before)
    repairs = [(finding["code"], repair) for finding in before for repair in finding.get("repairs", ())]
    assert len(repairs) > 5
    for code, repair in repairs:
        after = json.loads(cli("check", "--format", "json", "b.sleec", files={"b.sleec": changed(RULES, repair)}).out)
        left = [finding["code"] for finding in after["rulesets"][0]["findings"]]
        assert left.count(code) < codes.count(code)
        assert all(left.count(one) <= codes.count(one) for one in left)


def test_identifiers_count_the_repairs_of_a_code(cli: Cli) -> None:
    text = RULES + "RULE quiet\nWHEN Bell THEN NOT Speak\nRULE call\nWHEN Bell AND Storm THEN Speak\n"
    names = [repair["id"] for finding in findings(cli, text=text) for repair in finding.get("repairs", ())]
    conflicts = [name for name in names if name.startswith("SLEEC101:")]
    assert conflicts == [f"SLEEC101:{number}" for number in range(1, len(conflicts) + 1)]
    assert len(set(names)) == len(names)


def test_the_smallest_change_is_first(cli: Cli) -> None:
    for finding in findings(cli):
        sizes = [repair["situations"] for repair in finding.get("repairs", ())]
        assert sizes == sorted(sizes)


def test_repairs_are_only_computed_on_request(cli: Cli, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sleec_verify.repairs.search.RepairSearch.repairs", None)
    ran = cli("check", "--format", "json", "a.sleec", files={"a.sleec": RULES})
    assert ran.code == 1
    assert "repairs" not in json.loads(ran.out)["rulesets"][0]["findings"][0]


def test_repairs_of_cached_findings(cli: Cli, folder: Path, solves: Callable[[], int]) -> None:
    assert cli("check", "a.sleec", files={"a.sleec": RULES}).code == 1
    assert solves() == 1
    first = findings(cli)
    assert solves() == 0
    assert first == findings(cli, "--no-cache")
    assert folder.exists()


def test_sarif_has_fixes(cli: Cli) -> None:
    log = json.loads(cli("check", "--fixes", "--format", "sarif", "a.sleec", files={"a.sleec": RULES}).out)
    VALIDATOR.validate(log)
    shown = [fix for result in log["runs"][0]["results"] for fix in result.get("fixes", ())]
    assert len(shown) == sum(len(finding.get("repairs", ())) for finding in findings(cli))
    assert shown[0]["description"]["text"].startswith("SLEEC101:1: ")


HOME = "DOMAIN home\nRULE a\nWHEN Bell THEN Speak\nRULE b\nWHEN Bell AND Late THEN NOT Speak\n"
DOMAINS = f"{HOME}{HOME.replace('home', 'ward').replace('RULE a', 'RULE c').replace('RULE b', 'RULE d')}"
CHAIN = "WHEN Bell THEN Rise\nRULE up\nWHEN Rise THEN Speak\nRULE still\nWHEN Bell AND Late THEN NOT Speak\n"
NESTED = "WHEN Bell THEN Speak UNLESS Late IN WHICH CASE Sing UNLESS Storm IN WHICH CASE Wave\n"
OVERLAPPING = f"{NESTED}RULE still\nWHEN Bell AND Storm THEN NOT Wave\n"
OVERRIDDEN = f"READING cascade\n{NESTED}RULE still\nWHEN Bell AND Storm AND NOT Late THEN NOT Wave\n"
TIMED = "WHEN Bell THEN Speak WITHIN 5 minutes\nRULE b\nWHEN Bell THEN Wave\nRULE c\nWHEN Bell THEN NOT Wave\n"


@pytest.mark.parametrize(
    ("text", "options", "expected"),
    [
        (DOMAINS, ("--domain", "ward"), {("c", "d")}),
        (DOMAINS, (), {("a", "b"), ("c", "d")}),
        (CHAIN, (), {("up", "still")}),
        (CHAIN, ("--no-chains",), {("up", "still")}),
        (OVERLAPPING, ("--reading", "priority"), {("rule_1", "still")}),
        (OVERRIDDEN, ("--reading", "priority"), {("rule_1", "still")}),
        (TIMED, ("--untimed", "eventually"), {("b", "c")}),
    ],
)
def test_repairs_under_each_option(
    text: str, options: tuple[str, ...], expected: set[tuple[str, ...]], cli: Cli
) -> None:
    conflicts = [finding for finding in findings(cli, *options, text=text) if finding["code"] == "SLEEC101"]
    assert {frozenset(finding["rules"]) for finding in conflicts} == set(map(frozenset, expected))
    for finding in conflicts:
        assert finding["repairs"]
        for repair in finding["repairs"]:
            after = findings(cli, *options, text=changed(text, repair))
            assert finding["rules"] not in [one["rules"] for one in after if one["code"] == "SLEEC101"]


def test_a_finding_without_a_repair_says_so(cli: Cli) -> None:
    assert "= repairs: none found" in cli("check", "--fixes", "a.sleec", files={"a.sleec": "WHEN Bell THEN Bell"}).out
