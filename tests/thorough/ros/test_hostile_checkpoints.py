"""A checkpoint with any other value in any place is refused, or the Context Manager works with it."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from sleec_runtime.errors import SleecError
from sleec_runtime.language import parse
from tests.support.hostile_json import HOSTILE, places, replaced
from tests.support.robot_nodes import Robot

RULES = parse("""
MEASURE Age: integer
MEASURE Risk: low < high
RULE fall WHEN UserFell THEN CallNurse WITHIN Age seconds OTHERWISE CallAmbulance UNLESS Night IN WHICH CASE LightOn
RULE rest WHEN UserFell THEN NOT Vacuum WITHIN 20 seconds
RULE walk WHEN UserFell THEN OfferWalk WITHIN 10 TO 30 seconds
RULE door WHEN Ring THEN OpenDoor UNLESS Risk > low IN WHICH CASE Wait
DOMAIN home
RULE tea WHEN Ring THEN MakeTea WITHIN 5 seconds
""")


def documents(checkpoint: dict[str, Any]) -> Iterator[str]:
    """The checkpoint with each other value in each place, also within the messages that it has as texts."""
    for place in places(checkpoint):
        for new in HOSTILE:
            yield replaced(checkpoint, place, new)
    update, start = json.loads(checkpoint["update"]), json.loads(checkpoint["starts"][0])
    for place in places(update):
        for new in HOSTILE:
            yield json.dumps({**checkpoint, "update": replaced(update, place, new)})
    for place in places(start):
        for new in HOSTILE:
            yield json.dumps({**checkpoint, "starts": [replaced(start, place, new)]})


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore::sleec_runtime.errors.NotEnforced")
def test_every_place_of_a_checkpoint(tmp_path: Path) -> None:
    path = tmp_path / "checkpoint.json"
    robot = Robot(RULES, checkpoint=path)
    robot.enter("home")
    robot.report({"Age": 30, "Risk": "low", "Night": False})
    robot.trigger("UserFell")
    robot.trigger("Ring")
    checkpoint = json.loads(path.read_text(encoding="utf-8"))
    refused = accepted = 0
    for text in documents(checkpoint):
        path.write_text(text, encoding="utf-8")
        try:
            robot = Robot(RULES, checkpoint=path)
        except SleecError:
            refused += 1
            continue
        accepted += 1
        robot.task()
        robot.advance(2)
        robot.report({"Age": 3})
        robot.trigger("UserFell")
        robot.enter(None)
        robot.advance(5)
    assert refused > 1_000
    assert accepted > 100
