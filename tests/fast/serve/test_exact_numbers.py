"""The page sends back the numbers that it got, and they mean the same: also those that JavaScript cannot represent."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from tests.support.pages import page_on


def as_in_javascript(text: str) -> Any:
    """The values of JSON as a browser reads them: each number is a double."""
    return json.loads(text, parse_int=lambda digits: int(float(digits)))


@pytest.mark.parametrize(
    "number",
    ["0.1", "-2.5", "0.00000011", "0.1000000000000000055511151231257827", "9007199254740993", "1" + "0" * 40, "0"],
)
def test_a_number_is_the_same_after_the_way_through_the_page(number: str, tmp_path: Path) -> None:
    text = f"MEASURE x: number\nRULE a\nWHEN Bell AND x = {number} THEN Open\nRULE b\nWHEN Bell THEN NOT Open\n"
    page = page_on(tmp_path, text)
    conflict = next(one for one in page.post("check", text=text)["findings"] if one["code"] == "SLEEC101")
    answer = page.client.post(
        "/api/search",
        json={"text": text, "question": {"kind": "together", "rules": ["a"]}},
        headers=page.headers,
    )
    for found in (conflict["witness"], as_in_javascript(answer.text)["situation"]):
        assert page.post("situation", text=text, **found)["rules"][0]["label"] == "a"
    page.post("cases/add", text=text, name="one", conflict=True, **as_in_javascript(answer.text)["situation"])
    assert page.post("cases/run", text=text)["results"][0]["passed"]
    (case,) = page.get("cases")["cases"]
    assert page.post("situation", text=text, **case["situation"])["rules"][0]["label"] == "a"


@pytest.mark.parametrize("number", ["1/3", "-1/3", 1e-7])
def test_numbers_that_are_no_short_decimals(number: object, tmp_path: Path) -> None:
    text = "MEASURE x: number\nRULE a\nWHEN Bell AND x > -0.5 AND x < 0.5 THEN Open\n"
    answer = page_on(tmp_path, text).post("situation", text=text, triggers=["Bell"], conditions={"x": number})
    assert answer["obligations"] == ["Open"]
