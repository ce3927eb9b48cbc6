"""The obligations in a situation, and the clauses that decide."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from tests.support.pages import page_on

TEXT = """MEASURE Age: number
RULE open
WHEN Bell THEN Open
UNLESS Asleep IN WHICH CASE NOT Open AND Wait
UNLESS Age < 16 IN WHICH CASE CallParents
RULE greet
WHEN Bell AND Known THEN Greet
RULE always_open
WHEN Bell AND Fire THEN Open
"""


def asked(folder: Path, text: str = TEXT, **fields: Any) -> Any:
    return page_on(folder).post("situation", text=text, triggers=["Bell"], **fields)


def test_each_rule_says_which_clause_decides_and_why(tmp_path: Path) -> None:
    answer = asked(tmp_path, conditions={"Asleep": True, "Age": 15.5})
    assert answer["consistent"]
    assert answer["obligations"] == ["CallParents"]
    decided, guarded, other = answer["rules"]
    assert (decided["label"], decided["clause"], decided["layer"]) == ("open", 2, "open.hc2")
    assert TEXT[decided["start"] : decided["end"]].startswith("UNLESS Age < 16")
    assert decided["steps"] == [
        "`Bell` occurs",
        "`Asleep` is true (line 4)",
        "`age is below 16` is true, as `Age` is 15.5 (line 5)",
        "so `CallParents` is required",
    ]
    assert (guarded["label"], guarded["clause"]) == ("greet", None)
    assert guarded["steps"] == ["`Bell` occurs", "`Known` is false (line 7)", "so the rule does not apply"]
    assert other["label"] == "always_open"
    assert "CallParents" in answer["sentence"]


def test_conditions_inside_a_condition_have_quotation_marks_only_once(tmp_path: Path) -> None:
    text = "RULE a\nWHEN Bell THEN Open UNLESS Night AND NOT (Asleep OR Ill) IN WHICH CASE Wait"
    (rule,) = asked(tmp_path, text, conditions={"Night": True, "Ill": True})["rules"]
    assert rule["steps"][1] == (
        "(“night” is true and it is not true that (“asleep” is true or “ill” is true)) is false, "
        "as `Night` is true, `Asleep` is false and `Ill` is true (line 2)"
    )


def test_a_conflict_is_shown_in_its_situation(tmp_path: Path) -> None:
    answer = asked(tmp_path, conditions={"Asleep": True, "Fire": True, "Age": 20})
    assert not answer["consistent"]
    (conflict,) = answer["conflicts"]
    assert "`open`" in conflict["sentence"]
    assert "`always_open`" in conflict["sentence"]


def test_the_reading_and_the_domain_can_be_chosen(tmp_path: Path) -> None:
    text = "DOMAIN home\nRULE a\nWHEN Bell THEN Open UNLESS x IN WHICH CASE Wait UNLESS y IN WHICH CASE Call\n"
    text += "DOMAIN ward\nRULE b\nWHEN Bell THEN Ring\n"
    assert asked(tmp_path, text, conditions={"y": True}, domain="home")["obligations"] == ["Open"]
    assert asked(tmp_path, text, conditions={"y": True}, reading="priority")["obligations"] == ["Call", "Ring"]


def test_switches_of_other_domains_stay_as_they_are(tmp_path: Path) -> None:
    text = "MEASURE Age: number\nDOMAIN home\nRULE a\nWHEN Ring THEN Open UNLESS Dark AND Age < 3 IN WHICH CASE Wait\n"
    text += "DOMAIN ward\nRULE b\nWHEN Bell THEN Call\n"
    page = page_on(tmp_path)
    situation: dict[str, Any] = {"triggers": ["Bell", "Ring"], "conditions": {"Dark": True, "Age": 2}}
    required = {
        domain: page.post("situation", text=text, domain=domain, **situation)["obligations"]
        for domain in (None, "home", "ward")
    }
    assert required == {None: ["Call", "Wait"], "home": ["Wait"], "ward": ["Call"]}
    event = {"time": 0, "executed": ["Open"], **situation}
    answer = page.post("timeline", text=text, domain="ward", events=[event])
    assert [window["obligation"] for window in answer["windows"]] == ["Call"]


def test_windows_are_told(tmp_path: Path) -> None:
    answer = asked(tmp_path, "RULE a WHEN Bell THEN Open WITHIN 5 minutes\n")
    assert answer["rules"][0]["obligations"] == ["Open within 5 minutes"]
    assert "`Open` is due within 5 minutes" in answer["notes"]


def test_remarks_are_about_the_situation_only(tmp_path: Path) -> None:
    text = """MEASURE Age: number
MEASURE Risk: number
ASSUME Known OR NOT Bell
RULE a
WHEN Bell THEN Open
UNLESS Age < 16 IN WHICH CASE Wait
RULE b
WHEN Open THEN Greet
RULE c
WHEN Fall AND Risk > 3 THEN Call
"""
    assert asked(tmp_path, text)["notes"] == [
        "An assumption excludes this situation (line 3), so the checks ignore it.",
        "It becomes possible if `Known` is true.",
        "once the robot does `Open`, rule `b` applies: `Greet` is required",
        "`Age` is not given, so every comparison with it counts as false",
    ]
    assert len(asked(tmp_path, text, conditions={"Known": True, "Age": 20})["notes"]) == 1


def test_a_text_that_was_checked_need_not_be_sent_again(tmp_path: Path) -> None:
    page = page_on(tmp_path)
    digest = page.post("check", text=TEXT)["of"]
    assert page.post("situation", of=digest, triggers=["Bell"]) == page.post("situation", text=TEXT, triggers=["Bell"])
    assert "send the text" in page_on(tmp_path).post("situation", 410, of=digest, triggers=["Bell"])["hint"]


def test_rules_with_time_refer_to_the_findings(tmp_path: Path) -> None:
    text = "RULE a\nWHEN Bell THEN Open WITHIN 9 seconds\n"
    said = "This supposes that no response from before is pending. The findings look at all histories."
    assert said in asked(tmp_path, text)["notes"]
    assert said not in asked(tmp_path)["notes"]


def test_a_contradiction_at_later_times_is_told(tmp_path: Path) -> None:
    text = "RULE a\nWHEN Bell THEN Open WITHIN 9 seconds\nRULE b\nWHEN Bell THEN NOT Open WITHIN 1 minute\n"
    answer = asked(tmp_path, text)
    assert answer["consistent"] is False
    assert answer["obligations"] == []
    assert len(answer["conflicts"]) == 1


def test_alternatives_are_told_as_a_whole(tmp_path: Path) -> None:
    answer = asked(tmp_path, "RULE a\nWHEN Bell THEN Open WITHIN 9 seconds OTHERWISE NOT Ring\n")
    assert (answer["obligations"], answer["prohibitions"]) == ([], [])
    assert answer["alternatives"] == ["`Open within 9 seconds`, or else `NOT Ring`"]


def test_what_nothing_confirms_is_unknown(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sleec_verify.entailment.over_time.none_complies", lambda *_: None)
    answer = asked(tmp_path, "RULE a\nWHEN Bell THEN Open\nRULE b\nWHEN Bell THEN NOT Open WITHIN 1 minute\n")
    assert answer["consistent"] is None
    assert answer["notes"][0].startswith("it is not known whether the rules contradict each other here")
