"""Nodes with threads: decisions stay consistent while the context changes, and every thread ends."""

from __future__ import annotations

import threading
import time

from sleec_runtime import Sleec, language
from sleec_runtime.ros import ContextManagerNode, MissionManagerNode, Network, TaskManagerNode, Topic
from sleec_runtime.ros.messages import ConditionsUpdate, Executed

RULES = language.parse("RULE door WHEN Ring THEN OpenDoor UNLESS Night IN WHICH CASE Whisper")
COUNT = 200


def test_each_trigger_is_decided_in_the_context_that_its_report_names() -> None:
    before = threading.active_count()
    network = Network(threads=True)
    transports = [network.transport() for _ in range(4)]
    reports: list[Executed] = []
    enough = threading.Event()

    def note(report: Executed) -> None:
        reports.append(report)
        if len(reports) == COUNT:
            enough.set()

    manager = ContextManagerNode(Sleec(RULES), transports[0])
    sleec = Sleec(RULES)
    sleec.implement({"OpenDoor": lambda fields: None, "Whisper": lambda fields: None})
    task = TaskManagerNode("task", sleec, transports[1], policy="hold")
    mission = MissionManagerNode(transports[2], on_executed=note)
    conditions = transports[3].publisher(Topic("/conditions"))
    # A task holds 100 triggers at most.
    until = time.monotonic() + 20
    while not task.layer_listener.in_step and time.monotonic() < until:
        time.sleep(0.01)
    for number in range(COUNT):
        conditions.publish(ConditionsUpdate(conditions={"Night": number % 2 == 0}).to_fields())
        mission.start("Ring")
    assert enough.wait(20)
    # Update 1 reports the first night, update 2 its end, and so on.
    assert all(one.number is not None and one.refused is None and one.failed is None for one in reports)
    for one in reports:
        assert one.executed == ("Whisper" if (one.number or 0) % 2 else "OpenDoor",)
    for node in (mission, task, manager):
        node.close()
    for transport in transports:
        transport.close()
    until = time.monotonic() + 20
    while threading.active_count() > before and time.monotonic() < until:
        time.sleep(0.01)
    assert threading.active_count() <= before
