"""Expected cases: shown, added without loss of comments, and compared with the rules."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from tests.support.pages import Page, page_on

TEXT = """MEASURE Age: number
RULE open
WHEN Bell THEN Open
UNLESS Asleep IN WHICH CASE NOT Open AND Wait
UNLESS Age < 16
"""
CASES = '# why these cases\n[[case]]\nname = "first" # said by the nurse\nwhen = ["Bell"]\nobligations = ["Open"]'


@pytest.fixture
def page(tmp_path: Path) -> Page:
    return page_on(tmp_path, TEXT)


def test_a_new_case_is_added_and_what_people_wrote_stays(page: Page, tmp_path: Path) -> None:
    file = tmp_path / "rules.cases.toml"
    assert page.post("cases", text=TEXT) == {"path": str(file), "cases": [], "problem": None}
    assert page.get("file")["cases"] is None
    file.write_text(CASES, encoding="utf-8")
    page.post(
        "cases/add",
        name='he "sleeps"',
        triggers=["Bell"],
        conditions={"Asleep": True, "Age": 36.6},
        obligations=["Wait"],
        prohibitions=["Open"],
    )
    assert file.read_text(encoding="utf-8").startswith(f"{CASES}\n\n[[case]]")
    first, second = page.post("cases", text=TEXT)["cases"]
    assert first["name"] == "first"
    assert second["situation"]["conditions"] == {"Asleep": True, "Age": 36.6}
    assert page.get("file")["cases"] == str(file)
    results = page.post("cases/run", text=TEXT)["results"]
    assert [(one["name"], one["passed"]) for one in results] == [("first", True), ('he "sleeps"', True)]


def test_a_first_case_creates_the_file(page: Page, tmp_path: Path) -> None:
    page.post("cases/add", name="one", triggers=["Bell"], conditions={}, obligations=["Open"])
    assert [case["name"] for case in page.post("cases", text=TEXT)["cases"]] == ["one"]
    answer = page.post("cases/add", 400, name="one", triggers=["Bell"], conditions={}, obligations=["Open"])
    assert "already" in answer["message"]


def test_a_change_of_the_rules_breaks_a_case(page: Page) -> None:
    page.post("cases/add", name="one", triggers=["Bell"], conditions={}, obligations=["Open"])
    changed = TEXT.replace("WHEN Bell THEN Open", "WHEN Bell AND Late THEN Open")
    (failed,) = page.post("cases/run", text=changed)["results"]
    assert not failed["passed"]
    assert "`Open`" in failed["sentence"]


def test_scenarios_are_compared_too(tmp_path: Path) -> None:
    text = "RULE a WHEN Fall THEN Call WITHIN 5 minutes\n"
    page = page_on(tmp_path, text)
    (tmp_path / "rules.cases.toml").write_text(
        '[[case]]\nname = "s"\nsteps = [{ at = 0, when = ["Fall"] }]\n'
        'obligations = [{ name = "Call", from = 0, to = "5 minutes" }]\n',
        encoding="utf-8",
    )
    assert page.post("cases", text=text)["cases"][0]["sentence"] == "a sequence of events with 1 step"
    assert page.post("cases/run", text=text)["results"][0]["passed"]
    (failed,) = page.post("cases/run", text=text.replace("5", "4"))["results"]
    assert not failed["passed"]


def test_a_case_that_does_not_fit_leaves_the_others(page: Page, tmp_path: Path) -> None:
    page.post("cases/add", name="one", triggers=["Bell"], conditions={}, obligations=["Open"])
    page.post("cases/add", name="two", triggers=["Bell"], conditions={"Asleep": True}, obligations=["Wait"])
    text = TEXT.replace("AND Wait", "AND Pause")
    assert page.post("check", text=text)["problems"] == []
    fits, unfit = page.post("cases", text=text)["cases"]
    assert fits["sentence"] == "`Bell` occurs. Expected: `Open` is required."
    assert unfit["situation"] is None
    assert unfit["sentence"].startswith("The case does not fit the rules: ")
    assert "`Wait`" in unfit["sentence"]
    assert str(tmp_path) not in unfit["sentence"]
    assert [one["passed"] for one in page.post("cases/run", text=text)["results"]] == [True, False]


def test_cases_need_no_file_of_rules(page: Page, tmp_path: Path) -> None:
    page.path.unlink()
    page.post("cases/add", text=TEXT, name="one", triggers=["Bell"], conditions={}, obligations=["Open"])
    page.path.write_text("half wri", encoding="utf-8")
    (tmp_path / "rules.cases.toml").write_text(CASES, encoding="utf-8")
    before = page.get("disk")["cases"]
    page.post("cases/add", text=TEXT, name="two", triggers=["Bell"], conditions={}, obligations=["Open"])
    assert page.get("disk")["cases"] != before
    assert [one["name"] for one in page.post("cases", text=TEXT)["cases"]] == ["first", "two"]
    assert page.get("cases")["problem"]


def test_the_line_breaks_of_the_file_stay(page: Page, tmp_path: Path) -> None:
    file = tmp_path / "rules.cases.toml"
    file.write_bytes(CASES.replace("\n", "\r\n").encode())
    page.post("cases/add", text=TEXT, name="two", triggers=["Bell"], conditions={}, obligations=["Open"])
    content = file.read_bytes()
    assert content.count(b"\n") == content.count(b"\r\n") == 11
    assert [case["name"] for case in page.get("cases")["cases"]] == ["first", "two"]


@pytest.mark.parametrize("content", ["case = []", "case = 1", "not toml", 'sha256 = "x"\n', "\udc80"])
def test_a_file_that_is_not_one_of_cases_is_not_changed(page: Page, tmp_path: Path, content: str) -> None:
    file = tmp_path / "rules.cases.toml"
    file.write_bytes(content.encode("utf-8", "surrogateescape"))
    assert page.post("cases", text=TEXT)["problem"]
    page.post("cases/run", 400, text=TEXT)
    if "sha256" not in content:
        page.post("cases/add", 400, name="one", triggers=["Bell"], conditions={}, obligations=[])
        assert file.read_bytes() == content.encode("utf-8", "surrogateescape")


@pytest.mark.parametrize(
    "fields",
    [
        {"name": " "},
        {"triggers": ["None"]},
        {"obligations": ["None"]},
        {"conflict": 1},
        {"domain": "home"},
        {"text": "W"},
    ],
    ids=str,
)
def test_a_case_that_does_not_fit_the_rules(page: Page, tmp_path: Path, fields: dict[str, object]) -> None:
    case = {"name": "one", "triggers": ["Bell"], "conditions": {}, "obligations": ["Open"]}
    answer = page.client.post("/api/cases/add", json={**case, **fields}, headers=page.headers)
    assert answer.status_code == 400
    assert not (tmp_path / "rules.cases.toml").exists()


CHAIN = "ASSUME NOT (a AND c)\nRULE r\nWHEN Bell THEN Open UNLESS a IN WHICH CASE Wait UNLESS b IN WHICH CASE Call\n"


@pytest.mark.parametrize(
    ("conditions", "obligations", "fields", "hint"),
    [
        ({"b": True}, ["Call"], {"reading": "priority"}, "the cases use the reading cascade"),
        ({"a": True}, ["Open"], {}, None),
        ({"a": True, "c": True}, ["Wait"], {}, None),
    ],
)
def test_a_case_that_the_rules_do_not_meet_is_not_added(
    page: Page, tmp_path: Path, conditions: object, obligations: object, fields: dict[str, object], hint: str | None
) -> None:
    case = {"name": "one", "triggers": ["Bell"], "conditions": conditions, "obligations": obligations, **fields}
    answer = page.post("cases/add", 400, text=CHAIN, **case)
    assert answer["message"].startswith("the rules do not meet this case: ")
    assert answer["hint"] == hint
    assert not (tmp_path / "rules.cases.toml").exists()


def test_a_new_case_has_the_reading_that_the_file_states(page: Page, tmp_path: Path) -> None:
    (tmp_path / "rules.cases.toml").write_text('reading = "priority"\n', encoding="utf-8")
    case: dict[str, Any] = {"name": "one", "triggers": ["Bell"], "conditions": {"b": True}}
    answer = page.post("cases/add", 400, text=CHAIN, **case, obligations=["Open"])
    assert answer["hint"] == "the cases use the reading priority"
    page.post("cases/add", text=CHAIN, **case, obligations=["Call"], reading="priority")
    assert [one["passed"] for one in page.post("cases/run", text=CHAIN)["results"]] == [True]
