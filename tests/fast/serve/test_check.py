"""The analysis of the text while it is written."""

from __future__ import annotations

from pathlib import Path
from threading import Lock
from time import sleep

import anyio
import pytest
from starlette.concurrency import run_in_threadpool
from starlette.requests import Request
from starlette.types import Message

from benchmarks.random_rules import random_rules
from sleec_runtime.language import parse
from sleec_verify.checks import run_checks
from sleec_verify.report.outcome import CheckedRuleset
from sleec_verify.serve.interest import Superseded, held, require_interest, watched
from tests.support.pages import assert_page_knows_what_is_new, page_on
from tests.support.text_edits import edited_texts

GOOD = """MEASURE Age: number
RULE a
WHEN Bell THEN Open
UNLESS Age < 16 IN WHICH CASE NOT Open
RULE b
WHEN Bell THEN Open
"""


def test_a_conflict_has_its_place_its_situation_and_repairs(tmp_path: Path) -> None:
    answer = page_on(tmp_path).post("check", text=GOOD)
    assert answer["of"] == answer["sha256"]
    assert answer["problems"] == []
    (conflict,) = (one for one in answer["findings"] if one["code"] == "SLEEC101")
    assert GOOD[conflict["start"] : conflict["end"]].startswith("UNLESS Age < 16")
    assert conflict["witness"]["triggers"] == ["Bell"]
    assert conflict["witness"]["conditions"]["Age"] < 16
    assert conflict["repairs"] is True
    assert "1 error" in answer["verdict"]
    assert answer["names"]["conditions"] == [
        {"name": "Age", "kind": "number", "whole": False, "values": [16], "minimum": 0, "maximum": 32}
    ]
    assert [clause["condition"] for clause in answer["rules"][0]["clauses"]] == [None, "Age < 16"]


def test_a_half_written_text_keeps_the_last_verdict(tmp_path: Path) -> None:
    page = page_on(tmp_path)
    assert page.post("check", text="WHEN Bell THEN")["of"] is None
    good = page.post("check", text=GOOD)
    half = page.post("check", text=f"{GOOD}RULE c WHEN")
    assert half["of"] == good["sha256"] != half["sha256"]
    assert half["findings"] == good["findings"]
    (problem,) = half["problems"]
    assert problem["start"] >= len(GOOD)


def test_after_edits_the_findings_are_those_of_the_whole_text(tmp_path: Path) -> None:
    page = page_on(tmp_path)
    text = random_rules(30, seed=3)
    for changed in (text, text.replace("Obligation7\n", "Obligation8\n", 1), f"// new\n{text}"):
        outcome = CheckedRuleset(parse(changed), run_checks(parse(changed)))
        found = page.post("check", text=changed)["findings"]
        assert [(one["sentence"], one["start"]) for one in found] == [
            (finding.message, finding.span.start) for finding in outcome.deduplicated
        ]
        assert len({one["id"] for one in found}) == len(found)


@pytest.mark.parametrize("seed", range(3))
def test_a_page_with_an_earlier_analysis_gets_what_is_new(tmp_path: Path, seed: int) -> None:
    assert_page_knows_what_is_new(tmp_path, edited_texts(seed, edits=6, timed=False))


def test_what_a_page_has_is_not_sent_again(tmp_path: Path) -> None:
    page = page_on(tmp_path)
    text = random_rules(30, seed=3)
    first = page.post("check", text=text)
    again = page.post("check", text=f"// new\n{text}", since=first["version"])
    assert again["names"] == {}
    assert {tuple(one) for one in again["findings"]} == {("id", "start", "end")}
    assert {tuple(one) for one in again["rules"]} == {("label", "start", "end")}
    changed = page.post("check", text=text.replace("RULE r7\n", "RULE renamed\n"), since=again["version"])
    assert [one["label"] for one in changed["rules"] if "trigger" in one] == ["renamed"]
    assert page.post("check", text=text, since="unknown")["findings"] == first["findings"]
    german = page.post("check", text=text, since=changed["version"], language="de")
    assert all("sentence" in one for one in german["findings"])


def test_script_text_in_names_and_comments_stays_text(tmp_path: Path) -> None:
    text = "// <script>alert(1)</script>\nWHEN <script> THEN Open\n"
    page = page_on(tmp_path, text)
    answer = page.client.post("/api/check", json={"text": text}, headers=page.headers)
    assert answer.headers["content-type"] == "application/json"
    assert answer.json()["problems"]
    assert page.get("file")["text"] == text


def test_a_closed_request_ends_the_checks(tmp_path: Path) -> None:
    async def closed() -> Message:
        return {"type": "http.disconnect"}

    def work() -> None:
        for _ in range(20_000):  # 20 seconds at most
            require_interest()
            sleep(0.001)

    async def request() -> None:
        async with watched(Request({"type": "http", "headers": []}, closed)):
            with pytest.raises(Superseded):
                await run_in_threadpool(work)

    anyio.run(request)
    require_interest()


def test_a_closed_request_does_not_wait_for_its_turn() -> None:
    async def closed() -> Message:
        return {"type": "http.disconnect"}

    def wait() -> None:
        with held(lock):
            pass

    async def request() -> None:
        async with watched(Request({"type": "http", "headers": []}, closed)):
            with pytest.raises(Superseded):
                await run_in_threadpool(wait)

    lock = Lock()
    with lock:
        anyio.run(request)
    wait()
    assert not lock.locked()


def test_sentences_are_in_the_language_of_the_page(tmp_path: Path) -> None:
    page = page_on(tmp_path)
    question = {"kind": "together", "rules": ["a", "b"]}
    english, german = (page.post("search", text=GOOD, question=question, language=one) for one in ("en", "de"))
    assert english["situation"] == german["situation"]
    assert "gelten gleichzeitig" in german["sentence"]
    assert page.post("check", 400, text=GOOD, language="xx")["message"]
