"""A request that the page does not send gets an error with words, and never a traceback."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.support.pages import page_on


@pytest.mark.parametrize(
    "content",
    [
        b"",
        b"{",
        b"[]",
        b"null",
        b'"text"',
        b"\xff\xfe",
        b'{"text": NaN}',
        b'{"text": "\\ud800"}',
        b'{"text": ' + b"[" * 100_000 + b"]" * 100_000 + b"}",
        b'{"text": ' + b"9" * 5_000 + b"}",
        b'{"text": 1}',
        b'{"text": null}',
        b'{"text": ["WHEN"]}',
    ],
    ids=lambda content: repr(content[:20]),
)
@pytest.mark.parametrize("name", ["check", "situation", "save", "draft"])
def test_a_request_that_is_not_of_the_page(name: str, content: bytes, tmp_path: Path) -> None:
    page = page_on(tmp_path)
    answer = page.client.post(f"/api/{name}", content=content, headers=page.headers)
    assert answer.status_code == 400
    assert answer.json()["message"].startswith("the request") or "field `text`" in answer.json()["message"]


@pytest.mark.parametrize(
    ("fields", "said"),
    [
        ({"triggers": "DoorbellRings"}, "`triggers` of the request must be a list"),
        ({"triggers": [1]}, "`triggers` of the request must be a list"),
        ({"conditions": ["a"]}, "`conditions` of the request must be an object"),
        ({"conditions": {"Asleep": None}}, "`conditions` of the request must be an object"),
        ({"triggers": ["Doorbell"]}, "no trigger is called `Doorbell`"),
        ({"conditions": {"Asleep": 3}}, "must be true or false"),
        ({"conditions": {"Age": True}}, "must be a number"),
        ({"conditions": {"Age": 1e300}}, "must be a number"),
        ({"reading": "both"}, "a reading is"),
        ({"domain": "home"}, "no domain"),
        ({"text": "WHEN"}, "problem"),
    ],
    ids=lambda value: str(value)[:30],
)
def test_a_situation_that_does_not_fit_the_rules(fields: dict[str, object], said: str, tmp_path: Path) -> None:
    text = "WHEN DoorbellRings THEN OpenDoor\nUNLESS Asleep IN WHICH CASE Wait\nUNLESS Age < 16\n"
    answer = page_on(tmp_path).post("situation", 400, **{"text": text, "triggers": ["DoorbellRings"], **fields})
    assert said in answer["message"]


@pytest.mark.parametrize(("method", "path", "status"), [("GET", "/api/none", 404), ("PUT", "/api/save", 405)])
def test_an_unknown_request(method: str, path: str, status: int, tmp_path: Path) -> None:
    page = page_on(tmp_path)
    answer = page.client.request(method, path, headers=page.headers)
    assert answer.status_code == status
    assert answer.json()["message"]


def test_a_fault_of_the_program_is_an_answer_too(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sleec_verify.serve.session.parse", lambda *_: 1 / 0)
    answer = page_on(tmp_path).post("check", 400, text="")
    assert "internal error" in answer["message"]
