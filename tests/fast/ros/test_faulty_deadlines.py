"""Rules with time under faults: each start runs at most once, and everything under way ends when messages arrive."""

from __future__ import annotations

from collections import Counter
from pathlib import Path
from random import Random

import pytest

from sleec_runtime import language
from sleec_runtime.ros.faults import Faults, FaultyTransport
from sleec_runtime.ros.messages import Start
from sleec_runtime.ros.transport import Fields
from tests.support.robot_nodes import Robot

RULES = language.parse("""
RULE fall WHEN UserFell THEN CallNurse WITHIN 20 seconds OTHERWISE CallAmbulance WITHIN 20 seconds
RULE walk WHEN MorningComes THEN OfferWalk WITHIN 5 TO 15 seconds AND OpenDoor
RULE rest WHEN UserSleeps THEN NOT OfferWalk WITHIN 10 seconds
""")


@pytest.mark.parametrize("seed", [1])
@pytest.mark.parametrize(
    "faults",
    [Faults(drop=0.5), Faults(duplicate=0.7), Faults(delay=0.7, longest_delay=4), Faults(0.2, 0.3, 0.3, 0.3, 4)],
    ids=["drop", "duplicate", "delay", "all"],
)
def test_each_start_runs_at_most_once_and_ends(faults: Faults, seed: int, tmp_path: Path) -> None:
    random = Random(seed)
    path = tmp_path / "checkpoint.json"
    robot = Robot(RULES, checkpoint=path)
    links = [FaultyTransport(robot.network.transport(), faults, random.randrange(10**6), robot.clock) for _ in range(2)]
    robot.task("one", ["CallNurse", "OpenDoor"], links[0])
    robot.task("other", ["CallAmbulance", "OfferWalk"], links[1])
    started: dict[str, str] = {}

    def note(fields: Fields) -> None:
        start = Start.from_fields(fields)
        started[start.id] = start.obligation

    robot.outside.subscribe(Start.topic, note)
    for _ in range(60):
        if random.random() < 0.4:
            robot.trigger(random.choice(sorted(RULES.triggers)))
        elif random.random() < 0.05:
            robot.crash_manager()
            robot.manager_transport = robot.network.transport()
            robot.manager = robot.context_manager(transport=robot.manager_transport, checkpoint=path)
        else:
            robot.advance(random.choice((0.5, 2, 5)))
        executed, asked = Counter(robot.log), Counter(started.values())
        assert executed <= asked
    for link in links:
        link.faults = Faults()
    robot.advance(60)
    assert robot.manager_sleec.pending() == ()
    assert Counter(robot.log) <= Counter(started.values())
    assert len(robot.log) > 5
