"""Rulesets with findings that have repairs, and the identifiers of these."""

from __future__ import annotations

import json
from typing import Any

from tests.support.cli import Cli
from tests.support.schemas import validator

CONFLICT = """\
RULE privacy // because
WHEN CurtainsRequested THEN OpenCurtains
UNLESS UserUndressed IN WHICH CASE NOT OpenCurtains
RULE air
WHEN CurtainsRequested AND RoomStuffy THEN OpenCurtains AND OpenWindow
"""
DEAD = "UNLESS Night AND NOT Night\n"
TWO = f"{CONFLICT}RULE quiet\nWHEN Bell THEN NOT Speak\nRULE call\nWHEN Bell AND Storm THEN Speak\n"
SHORTER = "remove `OpenCurtains` from rule `air`"
"""The title of a repair of `CONFLICT`."""


def findings(cli: Cli, text: str, *options: str) -> list[dict[str, Any]]:
    """The findings of a file a.sleec with this text, with their repairs, as JSON."""
    ran = cli("check", "--format", "json", "--fixes", *options, "a.sleec", files={"a.sleec": text})
    found = json.loads(ran.out)
    validator("check").validate(found)
    listed: list[dict[str, Any]] = found["rulesets"][0]["findings"]
    return listed


def identifiers(cli: Cli, title: str, text: str) -> list[str]:
    """The repairs of `text` with this title."""
    repairs = [repair for finding in findings(cli, text) for repair in finding.get("repairs", ())]
    return [repair["id"] for repair in repairs if repair["title"] == title]


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
