"""`check --fixes` lists repairs in every format for which it is defined. The text is in documents/good/fixes.txt."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from sleec_verify.repairs.verification import Rejected, Verification
from tests.support.cli import Cli
from tests.support.fixes import CONFLICT, DEAD, changed, findings
from tests.support.formats import VALIDATOR
from tests.support.schemas import validator

RULES = CONFLICT + DEAD


def test_each_listed_repair_removes_its_finding(cli: Cli) -> None:
    before = findings(cli, RULES)
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
    names = [repair["id"] for finding in findings(cli, text) for repair in finding.get("repairs", ())]
    conflicts = [name for name in names if name.startswith("SLEEC101:")]
    assert conflicts == [f"SLEEC101:{number}" for number in range(1, len(conflicts) + 1)]
    assert len(set(names)) == len(names)


def test_what_takes_away_least_is_first(cli: Cli) -> None:
    for finding in findings(cli, RULES):
        lost = [repair["effect"].count("no longer required") for repair in finding.get("repairs", ())]
        assert not lost or lost[0] == min(lost)


def test_repairs_are_only_computed_on_request(cli: Cli, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sleec_verify.repairs.search.RepairSearch.repairs", None)
    ran = cli("check", "--format", "json", "a.sleec", files={"a.sleec": RULES})
    assert ran.code == 1
    assert "repairs" not in json.loads(ran.out)["rulesets"][0]["findings"][0]


def test_repairs_of_cached_findings(cli: Cli, folder: Path, solves: Callable[[], int]) -> None:
    assert cli("check", "a.sleec", files={"a.sleec": RULES}).code == 1
    assert solves() == 1
    first = findings(cli, RULES)
    assert solves() == 0
    assert first == findings(cli, RULES, "--no-cache")
    assert folder.exists()


def test_sarif_has_fixes(cli: Cli) -> None:
    log = json.loads(cli("check", "--fixes", "--format", "sarif", "a.sleec", files={"a.sleec": RULES}).out)
    VALIDATOR.validate(log)
    shown = [fix for result in log["runs"][0]["results"] for fix in result.get("fixes", ())]
    assert len(shown) == sum(len(finding.get("repairs", ())) for finding in findings(cli, RULES))
    assert shown[0]["description"]["text"].startswith("SLEEC101:1: ")


def test_a_finding_without_a_repair_says_so(cli: Cli) -> None:
    assert "= repairs: none found" in cli("check", "--fixes", "a.sleec", files={"a.sleec": "WHEN Bell THEN Bell"}).out


def test_repairs_that_cannot_be_verified_are_unknown(cli: Cli, monkeypatch: pytest.MonkeyPatch) -> None:
    checked = Verification.repaired

    def gives_up(verification: Verification, *arguments: Any) -> Any:
        checked(verification, *arguments)
        raise Rejected("the solver gave up", undecided=True)

    monkeypatch.setattr(Verification, "repaired", gives_up)
    options = ("check", "--fixes", "a.sleec", "--format")
    shown = {form: cli(*options, form, files={"a.sleec": CONFLICT}).out for form in ("full", "concise", "json")}
    assert "     unknown There may be more: the solver gave up\n" in shown["full"]
    assert "none found" not in shown["full"]
    assert "a.sleec:3:1: unknown[repairs] there may be more: the solver gave up\n" in shown["concise"]
    validator("check").validate(json.loads(shown["json"]))
    assert '"repairs_unknown": "the solver gave up"' in shown["json"]
    timed = cli(*options, "full", "--timeout", "100", files={"a.sleec": CONFLICT}).out
    assert "There may be more: the solver gave up; another run may number the repairs in another way\n" in timed
