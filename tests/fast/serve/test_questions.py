"""Questions to the solver: situations, repairs, comparisons."""

from __future__ import annotations

from pathlib import Path

import pytest

from sleec_verify.encoding.budget import Undecided, spend
from sleec_verify.serve.interest import Superseded
from tests.support.pages import Page, page_on

TEXT = """MEASURE Age: number
RULE open
WHEN Bell THEN Open
UNLESS Asleep IN WHICH CASE NOT Open
UNLESS Age < 16 IN WHICH CASE CallParents
RULE air
WHEN Bell AND Stuffy THEN Open
RULE night
WHEN Bell AND false THEN Dream
"""


@pytest.fixture
def page(tmp_path: Path) -> Page:
    return page_on(tmp_path, TEXT)


@pytest.mark.parametrize(
    ("question", "expected"),
    [
        ({"kind": "obligation", "obligation": "CallParents"}, "found"),
        ({"kind": "obligation", "obligation": "Dream"}, "none"),
        ({"kind": "together", "rules": ["open", "air"]}, "found"),
        ({"kind": "together", "rules": ["open", "night"]}, "none"),
        ({"kind": "exception", "rule": "open", "clause": 2}, "found"),
        ({"kind": "readings"}, "found"),
    ],
    ids=str,
)
def test_a_situation_is_found_or_excluded(page: Page, question: object, expected: str) -> None:
    answer = page.post("search", text=TEXT, question=question)
    assert answer["answer"] == expected
    assert answer["sentence"]
    if expected == "found":
        shown = page.post("situation", text=TEXT, **answer["situation"])
        assert shown["rules"]


def test_an_obligation_that_is_always_forbidden_too(page: Page) -> None:
    text = "RULE a WHEN Bell THEN Open\nRULE b WHEN Bell THEN NOT Open\n"
    answer = page.post("search", text=text, question={"kind": "obligation", "obligation": "Open"})
    assert answer["sentence"] == (
        "No situation exists in which `Open` is required without a contradiction. This is proved."
    )


@pytest.mark.parametrize(
    "text",
    [
        "RULE a WHEN Bell THEN Open WITHIN 1 minute\nRULE b WHEN Bell THEN NOT Open WITHIN 2 minutes\n",
        "RULE a WHEN Bell THEN Open AND Greet\nRULE b WHEN Open THEN NOT Greet\n",
    ],
)
def test_a_situation_with_a_contradiction_over_time_is_no_answer(page: Page, text: str) -> None:
    """The rules contradict each other in every situation, but not at one instant without the chain."""
    answer = page.post("search", text=text, question={"kind": "obligation", "obligation": "Open"})
    assert (answer["answer"], answer["situation"]) == ("unknown", None)
    assert answer["sentence"].startswith("in the situations that were tried, the rules contradict each other")


def test_unknown_stays_unknown(page: Page, monkeypatch: pytest.MonkeyPatch) -> None:
    def undecided(*_: object) -> None:
        raise Undecided("the solver reached its limit of conflicts")

    monkeypatch.setattr("sleec_verify.serve.answers.search.with_rules", undecided)
    answer = page.post("search", text=TEXT, question={"kind": "together", "rules": ["open"]})
    assert answer == {"answer": "unknown", "situation": None, "sentence": "the solver reached its limit of conflicts"}


@pytest.mark.parametrize(
    "question",
    [
        {},
        {"kind": "all"},
        {"kind": "obligation", "obligation": "None"},
        {"kind": "together", "rules": []},
        {"kind": "together", "rules": ["none"]},
        {"kind": "exception", "rule": "open", "clause": 9},
        {"kind": "exception", "rule": "open", "clause": True},
    ],
    ids=str,
)
def test_a_question_about_what_is_not_there(page: Page, question: object) -> None:
    assert page.post("search", 400, text=TEXT, question=question)["message"]


def test_a_repair_removes_its_conflict(page: Page) -> None:
    findings = page.post("check", text=TEXT)["findings"]
    (conflict,) = (one for one in findings if one["code"] == "SLEEC101")
    answer = page.post("repairs", text=TEXT, finding=conflict["id"])
    assert answer["unknown"] is None
    repair = answer["repairs"][0]
    assert "conflict" in repair["effect"][0]
    assert repair["diff"].startswith("@@")
    assert "SLEEC101" not in [one["code"] for one in page.post("check", text=repair["text"])["findings"]]
    assert "no such finding" in page.post("repairs", 400, text=repair["text"], finding=conflict["id"])["message"]


def test_two_versions_are_compared_by_meaning(page: Page) -> None:
    answer = page.post("compare", old=TEXT, new=TEXT.replace("< 16", "< 18"))
    assert answer["relation"] == "incomparable"
    assert {change["obligation"] for change in answer["changes"]} == {"CallParents", "NOT Open"}
    assert any("CallParents" in line for line in answer["sentences"])
    assert page.post("compare", old=TEXT, new=f"// more\n{TEXT}")["relation"] == "equivalent"
    assert page.post("compare", 400, old=TEXT, new="WHEN")["problems"]


@pytest.mark.parametrize("work", ["search.with_rules", "repairs.RepairSearch", "compare.compared"])
def test_a_closed_request_ends_its_work(page: Page, monkeypatch: pytest.MonkeyPatch, work: str) -> None:
    def closed() -> None:
        raise Superseded

    findings = page.post("check", text=TEXT)["findings"]
    question = {"kind": "together", "rules": ["open", "air"]}
    finding = next(one["id"] for one in findings if one["code"] == "SLEEC101")
    fields = {"text": TEXT, "old": TEXT, "new": TEXT, "question": question, "finding": finding}
    name = work.partition(".")[0]
    monkeypatch.setattr(f"sleec_verify.serve.answers.{name}.require_interest", closed)
    monkeypatch.setattr(f"sleec_verify.serve.answers.{work}", lambda *_: spend(1))
    assert page.client.post(f"/api/{name}", json=fields, headers=page.headers).status_code == 204
