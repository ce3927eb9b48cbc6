"""Events placed on a timeline, and the windows of what rules require."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from tests.support.pages import Page, page_on

TEXT = """RULE fall
WHEN UserFell THEN CallNurse WITHIN 5 minutes OTHERWISE CallAmbulance WITHIN 2 minutes
UNLESS Trained IN WHICH CASE NOT CallNurse WITHIN 1 minute
"""


@pytest.fixture
def page(tmp_path: Path) -> Page:
    return page_on(tmp_path, TEXT)


def event(time: int, *triggers: str, executed: tuple[str, ...] = (), **conditions: object) -> dict[str, object]:
    return {"time": time, "triggers": list(triggers), "executed": list(executed), "conditions": conditions}


def windows(page: Page, *events: object) -> list[tuple[object, ...]]:
    answer = page.post("timeline", text=TEXT, events=list(events))
    return [(one["obligation"], one["from"], one["to"], one["state"]) for one in answer["windows"]]


def test_a_window_opens_and_is_fulfilled_or_missed(page: Page) -> None:
    fall = event(10, "UserFell")
    assert windows(page) == []
    assert windows(page, fall) == [("CallNurse", 10, 310, "open")]
    assert windows(page, fall, event(310, executed=("CallNurse",))) == [("CallNurse", 10, 310, "fulfilled")]
    assert windows(page, fall, event(311)) == [
        ("CallNurse", 10, 310, "missed"),
        ("CallAmbulance", 310, 430, "open"),
    ]
    answer = page.post("timeline", text=TEXT, events=[fall, event(500)])
    assert [one["state"] for one in answer["windows"]] == ["missed", "missed"]
    assert "rule `fall`" in answer["problems"][0]


def test_values_last_and_a_prohibition_is_broken(page: Page) -> None:
    found = windows(page, event(20, executed=("CallNurse",)), event(0, Trained=True), event(10, "UserFell"))
    assert found == [("CallNurse", 10, 70, "broken")]
    assert windows(page, event(0, "UserFell", Trained=True), event(61)) == [("CallNurse", 0, 60, "fulfilled")]


def test_a_length_without_a_value_is_a_problem(page: Page) -> None:
    text = "MEASURE Limit: integer\nRULE a WHEN Bell THEN Open WITHIN Limit seconds\n"
    answer: Any = page.post("timeline", text=text, events=[event(0, "Bell")])
    assert answer["windows"] == []
    assert answer["problems"] == ["`Limit` gives the length of a window, but has no value"]
    answer = page.post("timeline", text=text, events=[event(0, "Bell", Limit=4)])
    assert [one["to"] for one in answer["windows"]] == [4]


@pytest.mark.parametrize(
    "events",
    [
        None,
        {},
        [1],
        [event(-1)],
        [event(10**10)],
        [event(0, "None")],
        [{"time": "0"}],
        [event(0, X=1)],
        [event(0)] * 501,
    ],
    ids=lambda events: str(events)[:30],
)
def test_bad_events(page: Page, events: object) -> None:
    assert page.post("timeline", 400, text=TEXT, events=events)["message"]


CLASH = """ASSUME the ward is open OR the ward is closed
RULE dizzy
WHEN the patient is dizzy THEN call the nurse WITHIN 2 minutes
RULE round
WHEN the round starts THEN NOT call the nurse WITHIN 10 minutes
"""


def test_a_conflict_is_shown_as_in_the_report(tmp_path: Path) -> None:
    page = page_on(tmp_path, CLASH)
    (finding,) = (one for one in page.post("check", text=CLASH)["findings"] if one["code"] == "SLEEC101")
    events = [
        {"time": one["time"], "triggers": one["events"], "executed": [], "conditions": one["conditions"]}
        for one in finding["timeline"]
    ]
    answer: Any = page.post("timeline", text=CLASH, events=events)
    assert answer["impossible"] == 0
    assert answer["problems"] == [
        "from the first moment on, it is impossible to follow every rule: `dizzy` and `round`"
    ]
    assert [(one["rule"], one["state"]) for one in answer["windows"]] == [
        ("dizzy", "impossible"),
        ("round", "impossible"),
    ]


def test_what_can_still_be_followed_is_pending(tmp_path: Path) -> None:
    page = page_on(tmp_path, CLASH)
    dizzy, round_ = event(0, "the patient is dizzy"), event(60, "the round starts")
    answer: Any = page.post("timeline", text=CLASH, events=[dizzy])
    assert (answer["impossible"], answer["problems"]) == (None, [])
    answer = page.post("timeline", text=CLASH, events=[dizzy, round_])
    assert answer["impossible"] == 60
    assert answer["problems"] == ["after 1 minute, it is impossible to follow every rule: `dizzy` and `round`"]
    done = event(30, executed=("call the nurse",))
    answer = page.post("timeline", text=CLASH, events=[dizzy, done, round_])
    assert (answer["impossible"], answer["problems"]) == (None, [])


def test_what_nothing_confirms_is_not_said(page: Page, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr("sleec_verify.entailment.continuation.none_complies", lambda *_: None)
    events = [event(0, "the patient is dizzy", "the round starts")]
    answer: Any = page_on(tmp_path, CLASH).post("timeline", text=CLASH, events=events)
    assert answer["impossible"] is None
    assert answer["problems"][0].startswith("it is not known whether every rule can be followed")
