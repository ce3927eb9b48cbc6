"""Measure the monitor and the recorder: from a message that breaks a rule to the published deviation, and messages a
second. Within a process with threads, over DDS between two processes, and of the parts alone."""

from __future__ import annotations

import logging
import os
import subprocess
import sys
import threading
import time
from collections.abc import Mapping, Sequence
from contextlib import closing
from pathlib import Path
from statistics import median, quantiles
from tempfile import TemporaryDirectory

from sleec_runtime.audit.auditor import Auditor
from sleec_runtime.audit.mapping import Misfit
from sleec_runtime.audit.observation import RawMessage
from sleec_runtime.language import load
from sleec_runtime.ros import MonitorNode, Network, RecorderNode
from sleec_runtime.ros.dds.environment import LOOPBACK
from sleec_runtime.ros.dds.transport import DdsTransport
from sleec_runtime.ros.message import Message
from sleec_runtime.ros.messages import ConditionsUpdate, Executed, MissionEvent
from sleec_runtime.ros.monitoring.deviation_report import DeviationReport
from sleec_runtime.ros.monitoring.robot_mapping import RobotMapping
from sleec_runtime.ros.transport import Transport

RULES = Path(__file__).parents[1] / "rulesets" / "care-robot.sleec"
VIOLATIONS = 1_000
MESSAGES = 30_000


def cycle(number: int) -> Sequence[Message]:
    """What a robot does for one request: a report, the trigger, and the execution."""
    undressed = number % 2 == 0
    done = ("RefuseRequest", "ExplainWhy") if undressed else ("OpenCurtains",)
    return (
        ConditionsUpdate(conditions={"UserUndressed": undressed, "UserDistressed": False}),
        MissionEvent(trigger="CurtainOpenRequest"),
        Executed(node="n", triggered=0, time=0, executed=done),
    )


def delays(robot: Transport) -> list[float]:
    """Seconds from the publication of an execution that no rule required to the arrival of the deviation."""
    arrived = threading.Event()
    robot.subscribe(DeviationReport.topic, lambda fields: arrived.set())
    publisher = robot.publisher(Executed.topic)
    time.sleep(2)
    found = []
    for _ in range(VIOLATIONS):
        arrived.clear()
        fields = Executed(node="n", triggered=0, time=0, executed=("OpenCurtains",)).to_fields()
        begin = time.perf_counter()
        publisher.publish(fields)
        if not arrived.wait(20):
            sys.exit("the monitor does not answer")
        found.append(time.perf_counter() - begin)
    return found


def in_process() -> list[float]:
    network = Network(threads=True)
    with (
        closing(network.transport()) as watcher,
        closing(network.transport()) as robot,
        closing(MonitorNode(Auditor(load(RULES)), watcher, late=False)),
    ):
        return delays(robot)


def over_dds() -> list[float]:
    environment = {"CYCLONEDDS_URI": LOOPBACK, "ROS_DOMAIN_ID": str(1 + os.getpid() % 99)}
    os.environ.update(environment)
    command = [sys.executable, "-m", "sleec_runtime.ros", "monitor", str(RULES), "--from-start"]
    process = subprocess.Popen(command, stderr=subprocess.PIPE, text=True)
    robot = DdsTransport()
    try:
        assert process.stderr is not None
        process.stderr.readline()
        threading.Thread(target=process.stderr.read, daemon=True).start()
        return delays(robot)
    finally:
        robot.close()
        process.terminate()
        process.wait()


def messages() -> list[RawMessage]:
    found = []
    for number in range(MESSAGES // 3):
        for step, message in enumerate(cycle(number)):
            fields: Mapping[str, object] = message.to_fields()
            found.append(RawMessage(number * 3 + step, message.topic.name, message.topic.type, fields))
    return found


def rate(seconds: float) -> str:
    return f"{MESSAGES / seconds:9,.0f} messages a second"


def main() -> None:
    # Each deviation is a warning.
    logging.disable(logging.WARNING)
    for name, found in (("within a process", in_process()), ("over DDS, two processes", over_dds())):
        share = quantiles(found, n=100)
        times = f"median {median(found) * 1e3:.2f} ms, 95 % {share[94] * 1e3:.2f} ms, 99 % {share[98] * 1e3:.2f} ms"
        print(f"to the deviation, {name:24} {times} ({len(found):,} deviations)")
    sample = messages()
    auditor, mapping = Auditor(load(RULES), tolerance=2), RobotMapping()
    begin = time.perf_counter()
    for raw in sample:
        for seen in mapping.observations(raw):
            assert not isinstance(seen, Misfit)
            assert not auditor.observe(seen)
    print(f"mapping and auditor {rate(time.perf_counter() - begin)}")
    network = Network()
    robot = network.transport()
    publishers = {raw.topic: robot.publisher(kind.topic) for raw, kind in zip(sample, cycle(0), strict=False)}

    def deliver_all() -> float:
        """The seconds to deliver the sample, message by message."""
        begin = time.perf_counter()
        for raw in sample:
            publishers[raw.topic].publish(raw.fields)
            network.deliver()
        return time.perf_counter() - begin

    monitor = MonitorNode(Auditor(load(RULES)), network.transport(), late=False)
    print(f"monitor node        {rate(deliver_all())}, {monitor.published} deviations")
    monitor.close()
    with TemporaryDirectory() as folder:
        recorder = RecorderNode(network.transport(), Path(folder) / "log.jsonl")
        print(f"recorder node       {rate(deliver_all())}, {recorder.recorded:,} recorded")
        recorder.close()
