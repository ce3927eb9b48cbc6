"""Monitor and recorder as processes over DDS: what the monitor publishes is what an audit finds in the recording."""

from __future__ import annotations

import json
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

from sleec_runtime.ros.dds.transport import DdsTransport
from sleec_runtime.ros.message import Message
from sleec_runtime.ros.messages import ConditionsUpdate, Executed, MissionEvent
from sleec_runtime.ros.monitoring.deviation_report import DeviationReport
from sleec_runtime.ros.transport import Topic
from tests.support.dds import PATIENCE, dds_environment, eventually, require_dds
from tests.support.dds import transports as transports

require_dds()

RULES = """
CONDITION UserUndressed
MEASURE battery: number
RULE curtains WHEN CurtainRequest THEN OpenCurtains WITHIN 1 seconds
UNLESS UserUndressed IN WHICH CASE NOT OpenCurtains
RULE dock WHEN LowBattery THEN Dock WITHIN 1 seconds UNLESS battery < 5
NEVER Dock AND OpenCurtains
"""
MAPPING = """
tolerance = 0.25
[measures]
battery = {topic = "/battery_state", field = "percentage", scale = 100}
[events]
LowBattery = {topic = "/low_battery"}
[topics]
"/battery_state" = {type = "sensor_msgs/msg/BatteryState", reliable = false}
"/low_battery" = {type = "my_msgs/msg/Charge"}
[definitions]
"my_msgs/msg/Charge" = "float32 left"
"""


@contextmanager
def node(*arguments: str | Path) -> Iterator[subprocess.Popen[str]]:
    """A node in a process of its own, which has started, and is ended by a signal."""
    process = subprocess.Popen(
        [sys.executable, "-m", "sleec_runtime.ros", *map(str, arguments)],
        stderr=subprocess.PIPE,
        text=True,
        env=dds_environment(),
    )
    try:
        assert process.stderr is not None
        assert "ready" in process.stderr.readline()
        yield process
    finally:
        process.send_signal(signal.SIGTERM)
        try:
            process.communicate(timeout=PATIENCE)
        except subprocess.TimeoutExpired:
            process.kill()
            process.communicate()


def test_processes_watch_and_record_one_mission(tmp_path: Path, transports: Callable[..., DdsTransport]) -> None:
    rules, mapping, log = tmp_path / "rules.sleec", tmp_path / "m.toml", tmp_path / "log.jsonl"
    rules.write_text(RULES)
    mapping.write_text(MAPPING)
    robot = transports(definitions={"my_msgs/msg/Charge": "float32 left"})
    received: list[DeviationReport] = []
    robot.subscribe(DeviationReport.topic, lambda fields: received.append(DeviationReport.from_fields(fields)))
    kinds = (ConditionsUpdate, MissionEvent, Executed)
    topics = [
        *(kind.topic for kind in kinds),
        Topic("/battery_state", "sensor_msgs/msg/BatteryState"),
        Topic("/low_battery", "my_msgs/msg/Charge"),
    ]
    publishers = {topic.name: robot.publisher(topic) for topic in topics}

    def publish(topic: str, fields: dict[str, object]) -> None:
        publishers[topic].publish(fields)
        # Messages on different topics may overtake each other.
        time.sleep(0.05)

    def send(message: Message) -> None:
        publish(message.topic.name, {**message.to_fields()})

    def executed(*obligations: str) -> None:
        send(Executed(node="n", triggered=time.time(), time=time.time(), executed=obligations))

    with (
        node("record", log, "--rules", rules, "--mapping", mapping),
        node("monitor", rules, "--mapping", mapping) as monitor,
    ):
        assert eventually(lambda: all(one.subscription_count() == 2 for one in publishers.values()))
        publish("/battery_state", {"percentage": 0.2, "voltage": float("nan")})
        send(ConditionsUpdate(conditions={"UserUndressed": False}))
        send(MissionEvent(trigger="CurtainRequest", id="1"))
        executed("OpenCurtains")
        assert not received
        send(MissionEvent(trigger="CurtainRequest", id="2"))
        assert eventually(lambda: [one.kind for one in received] == ["missed"])
        send(ConditionsUpdate(conditions={"UserUndressed": True}))
        send(MissionEvent(trigger="CurtainRequest", id="3"))
        publish("/low_battery", {})
        executed("OpenCurtains", "Dock")
        # A message that is none of ours, and one that is malformed.
        publish("/conditions", {"data": "hello"})
        publish("/conditions", {"data": '{"UserUndressed": {}}'})
        assert eventually(lambda: len(received) == 3)
        monitor.send_signal(signal.SIGINT)
        assert monitor.wait(PATIENCE) == 1
    assert [(one.kind, one.rule, one.clause) for one in received] == [
        ("missed", "curtains", 0),
        ("prohibited", "curtains", 1),
        ("constraint", None, None),
    ]
    options = ["--ruleset", rules, "--mapping", mapping, "--format", "json"]
    command = map(str, (sys.executable, "-m", "sleec_verify", "audit", log, *options))
    audit = subprocess.run(tuple(command), capture_output=True, text=True, check=False)
    assert audit.returncode == 1
    (checked,) = json.loads(audit.stdout)["rulesets"]
    found = checked["audit"]["missions"][0]["deviations"]
    assert [one["code"] for one in found if one["kind"] == "unreadable"] == ["SLEEC708"]
    # The recorder and the monitor receive a message at different times.
    wanted = [(one["kind"], one.get("rule"), one.get("clause")) for one in found if one["kind"] != "unreadable"]
    assert sorted(wanted, key=str) == sorted(((one.kind, one.rule, one.clause) for one in received), key=str)
