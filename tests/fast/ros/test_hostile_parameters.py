"""Nodes reject parameters that they cannot work with, and leave nothing behind."""

from __future__ import annotations

from decimal import Decimal
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest

from sleec_runtime import VirtualClock, language
from sleec_runtime.audit.auditor import Auditor
from sleec_runtime.errors import SleecError, SnapshotRefused, UnknownLabel, WrongType
from sleec_runtime.ros import MissionManagerNode, MonitorNode, Network, RecorderNode, Topic
from sleec_runtime.ros.monitoring.live_topics import RECORDED
from sleec_runtime.ros.transport import DEEPEST
from tests.support.hostile_values import NO_SECONDS
from tests.support.robot_nodes import Robot

RULES = language.parse("""
RULE door WHEN Ring THEN Open UNLESS Night IN WHICH CASE Wait
RULE fall WHEN Fall THEN Help WITHIN 5 seconds OTHERWISE Shout
""")
SECONDS = (0.001, 1, 0.5, Fraction(1, 3), Decimal("0.5"), 10**12)
"""Lengths of time of all types."""


def monitor(network: Network, **more: Any) -> MonitorNode:
    return MonitorNode(Auditor(RULES), network.transport(), clock=VirtualClock(start=1_000), **more)


@pytest.mark.parametrize("value", NO_SECONDS, ids=lambda value: str(type(value)))
def test_what_is_no_length_of_time_is_refused(value: Any) -> None:
    robot = Robot(RULES)
    for name in ("timeout", "longest_hold"):
        with pytest.raises(WrongType, match=name):
            robot.task(**{name: value})
    with pytest.raises(WrongType, match="heartbeat"):
        robot.context_manager(heartbeat=value)
    for name in ("period", "patience"):
        with pytest.raises(WrongType, match="seconds"):
            monitor(Network(), **{name: value})


@pytest.mark.parametrize("value", SECONDS)
def test_a_length_of_time_may_be_any_number(value: Any) -> None:
    robot = Robot(RULES, heartbeat=value)
    robot.task(timeout=value, longest_hold=value, policy="hold")
    robot.trigger("Ring")
    robot.crash_manager()
    robot.trigger("Ring")
    # The timers of the shortest times ring often.
    robot.clock.advance(0.1)
    robot.deliver()
    assert robot.log[0] == "Open"
    watched = monitor(Network(), period=value, patience=value)
    watched.clock.advance(0.1)  # type: ignore[attr-defined]
    watched.close()


@pytest.mark.parametrize("rules", [5, "door", [["door"]], [1], ["dor"]])
def test_rules_are_a_list_of_labels(rules: Any) -> None:
    with pytest.raises((WrongType, UnknownLabel)):
        Robot(RULES).task(rules=rules)


@pytest.mark.parametrize("name", [None, 5, b"x", "\ud800", "a\nb", "\x1b[31m"])
def test_a_name_is_printable_text(name: Any) -> None:
    transport = Network().transport()
    with pytest.raises(WrongType, match="name"):
        MissionManagerNode(transport, name=name)
    with pytest.raises(WrongType, match="name"):
        Topic(name)


@pytest.mark.parametrize("depth", [0, -1, 1.5, True, None, "1", DEEPEST + 1])
def test_a_depth_is_a_number_of_messages(depth: Any) -> None:
    with pytest.raises(WrongType, match="depth"):
        Topic("/a", depth=depth)


@pytest.mark.parametrize(
    "wrong", [{"heartbeat": -1}, {"checkpoint": "."}, {"checkpoint": "damaged.json"}, {"checkpoint": "other.json"}]
)
def test_a_context_manager_that_cannot_start_is_not_followed(
    wrong: dict[str, Any], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    robot = Robot(RULES, checkpoint="other.json")
    robot.trigger("Fall")
    robot.crash_manager()
    text = Path("other.json").read_text(encoding="utf-8")
    Path("other.json").write_text(text.replace('"format": 1', '"format": 2'), encoding="utf-8")
    Path("damaged.json").write_text(text[:-9], encoding="utf-8")
    transport = robot.network.transport()
    with pytest.raises(SleecError):
        robot.context_manager(transport=transport, **wrong)
    robot.manager = robot.context_manager(transport=transport)
    robot.task()
    robot.advance(9)
    assert robot.problems == []
    assert robot.trigger("Ring") == ["Open"]


def test_nodes_that_cannot_start_take_no_messages(tmp_path: Path) -> None:
    without_text = language.parse("WHEN Ring THEN Open")
    object.__setattr__(without_text, "source", type(without_text.source)("<made>", ""))
    robot = Robot(RULES)
    robot.ruleset = without_text
    with pytest.raises(SnapshotRefused):
        robot.task()
    networks = Network(), Network()
    networks[0].transport().publisher(Topic(RECORDED[-1].name, "std_msgs/msg/Bool"))
    with pytest.raises(SleecError, match="has the type"):
        RecorderNode(networks[0].transport(), tmp_path / "log.jsonl", clock=VirtualClock())
    networks[1].transport().publisher(Topic("/executed", "std_msgs/msg/Bool"))
    with pytest.raises(SleecError, match="has the type"):
        monitor(networks[1], on_deviation=robot.log.append)
    for network in networks:
        network.transport().publisher(Topic("/mission")).publish({"data": '{"trigger": "Rung"}'})
        network.deliver()
    robot.problems.clear()
    robot.advance(9)
    assert robot.problems == []
    assert robot.log == []
    assert (tmp_path / "log.jsonl").read_text(encoding="utf-8") == ""


def test_a_closed_context_manager_starts_and_saves_nothing(tmp_path: Path) -> None:
    robot = Robot(RULES, checkpoint=tmp_path / "checkpoint.json")
    robot.task()
    robot.trigger("Fall")
    robot.manager.close()
    saved = (tmp_path / "checkpoint.json").read_bytes()
    robot.log.clear()
    robot.manager_sleec.update({"Night": True})
    robot.advance(9)
    assert robot.log == []
    assert (tmp_path / "checkpoint.json").read_bytes() == saved
