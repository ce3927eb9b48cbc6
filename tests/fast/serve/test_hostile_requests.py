"""Every field of every request, replaced by what no page sends: an answer with words, and no file is damaged."""

from __future__ import annotations

import json
from typing import Any

import pytest

from sleec_verify.serve.application import ACTS, respond
from sleec_verify.serve.session import Session
from tests.support.hostile_json import HOSTILE, places, replaced
from tests.support.pages import Page, page_on

TEXT = """MEASURE Age: number
MEASURE Risk: low < high
DOMAIN home
RULE open
WHEN Bell THEN Open WITHIN 5 minutes
UNLESS Asleep IN WHICH CASE NOT Open AND Wait
UNLESS Age < 16 OR Risk > low IN WHICH CASE CallParents
RULE air
WHEN Bell AND Stuffy THEN Open
"""
SITUATION: dict[str, Any] = {"triggers": ["Bell"], "conditions": {"Asleep": True, "Age": 3.5, "Risk": "low"}}
SCOPE = {"reading": "priority", "domain": "home", "language": "it"}
EVENT = {"time": 9, "triggers": ["Bell"], "conditions": {"Age": 3}, "executed": ["Open"]}
QUESTIONS: list[dict[str, Any]] = [
    {"kind": "obligation", "obligation": "Open"},
    {"kind": "together", "rules": ["open", "air"]},
    {"kind": "exception", "rule": "open", "clause": 1},
    {"kind": "readings"},
]
VALID: list[tuple[str, dict[str, Any]]] = [
    ("check", {"text": TEXT, "known": "0"}),
    ("situation", {"text": TEXT, **SITUATION, **SCOPE}),
    ("timeline", {"text": TEXT, "events": [EVENT]}),
    *(("search", {"text": TEXT, "question": question}) for question in QUESTIONS),
    ("compare", {"old": TEXT, "new": TEXT.replace("16", "18")}),
    ("draft", {"text": TEXT, "based_on": "0"}),
    ("cases", {"text": TEXT}),
    ("cases/run", {"text": TEXT}),
]
REFUSED: list[tuple[str, int, dict[str, Any]]] = [
    ("repairs", 400, {"text": TEXT, "finding": "0"}),
    ("save", 409, {"text": TEXT, "based_on": "0"}),
    ("cases/add", 400, {**SITUATION, "text": TEXT, "name": "one", "obligations": ["Open"], "domain": "home"}),
]


@pytest.fixture(scope="module")
def page(tmp_path_factory: pytest.TempPathFactory) -> Page:
    page = page_on(tmp_path_factory.mktemp("served"), TEXT)
    page.post("cases/add", text=TEXT, name="one", **SITUATION, obligations=["CallParents"])
    return page


REQUESTS = [*((name, 200, fields) for name, fields in VALID), *REFUSED]


def test_the_requests_are_those_that_exist() -> None:
    assert {name for name, _, _ in REQUESTS} == set(ACTS)


@pytest.mark.parametrize(("name", "expected", "fields"), REQUESTS, ids=lambda one: one if isinstance(one, str) else "")
def test_every_field_may_have_any_value(page: Page, name: str, expected: int, fields: dict[str, Any]) -> None:
    cases = page.path.with_suffix(".cases.toml").read_text(encoding="utf-8")
    session = Session(str(page.path), str(page.path.parent / "drafts"))
    page.post(name, expected, **fields)
    for place in places(fields):
        for new in HOSTILE:
            content = replaced(fields, place, new)
            answer = respond(session, ACTS[name], content.encode())
            assert answer.status_code in (200, 400, 409), (place, new)
            found = json.loads(bytes(answer.body))
            said = found.get("message", "")
            assert bool(said) == (answer.status_code != 200)
            assert len(said) < 3_000
            assert "internal error" not in said, (place, new, said)
    assert page.path.read_text(encoding="utf-8") == TEXT
    assert page.path.with_suffix(".cases.toml").read_text(encoding="utf-8").startswith(cases)
    assert page.get("cases")["problem"] is None
