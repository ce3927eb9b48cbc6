"""Messages on every topic, with any other value in any place: every kind of node reports them, and continues."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from sleec_runtime import VirtualClock
from sleec_runtime.audit.auditor import Auditor
from sleec_runtime.errors import SleecError
from sleec_runtime.evaluation.due import due
from sleec_runtime.model import Context
from sleec_runtime.ros import MissionManagerNode, MonitorNode, RecorderNode
from sleec_runtime.ros.message import Message
from sleec_runtime.ros.messages import Executed
from sleec_runtime.ros.monitoring.deviation_report import DeviationReport
from tests.fuzz.messages import KINDS, RULES, seeds
from tests.support.hostile_json import HOSTILE, places, replaced
from tests.support.robot_nodes import Robot


class Nodes(Robot):
    """A node of each kind. What the test itself cannot read on /executed is no problem of a node."""

    def __init__(self, folder: Path) -> None:
        super().__init__(RULES)
        self.wall_clock = VirtualClock(1_790_000_000)
        self.reports: list[DeviationReport] = []
        network, problems = self.network, self.problems
        self.task(obligations=[name for name in RULES.obligations if name != "Help"])
        MissionManagerNode(network.transport(), on_executed=lambda report: None, on_problem=problems.append)
        self.monitor = MonitorNode(
            Auditor(RULES), network.transport(), clock=self.wall_clock, on_problem=problems.append
        )
        self.recorder = RecorderNode(
            network.transport(), folder / "log.jsonl", clock=self.wall_clock, on_problem=problems.append
        )
        self.outside.subscribe(
            DeviationReport.topic, lambda fields: self.reports.append(DeviationReport.from_fields(fields))
        )
        self.report({"Age": 30, "Night": False, "Risk": "low"})
        self.trigger("Fall")

    def take(self, kind: type[Message], text: str) -> None:
        self.outside.publisher(kind.topic).publish({"data": text})
        try:
            self.deliver()
        except SleecError:
            assert kind is Executed
            self.deliver()
        self.wall_clock.advance(0.5)
        self.advance(1)


def documents() -> list[tuple[type[Message], object]]:
    """The valid messages of the fuzzer."""
    found = []
    for seed in seeds():
        topic, _, text = seed.decode().partition("\n")
        try:
            KINDS[topic].from_json(text)
        except SleecError:
            continue
        found.append((KINDS[topic], json.loads(text)))
    return found


@pytest.mark.slow
@pytest.mark.parametrize("number", range(len(documents())))
def test_every_place_of_a_message(number: int, tmp_path: Path) -> None:
    kind, document = documents()[number]
    nodes = Nodes(tmp_path)
    for place in places(document):
        for new in HOSTILE:
            nodes.take(kind, replaced(document, place, new))
        assert all(isinstance(problem, SleecError) for problem in nodes.problems)
        # A Context Manager that the messages name is silent by then.
        nodes.advance(8)
        known = Context(frozenset(["Ring"]), nodes.manager_sleec.conditions)
        rules = RULES if nodes.manager_sleec.domain is None else RULES.in_domain(nodes.manager_sleec.domain)
        assert nodes.trigger("Ring") == list(due(rules, known).obligations)
    assert nodes.problems
    nodes.monitor.close()
    nodes.recorder.close()
    nodes.deliver()
    assert nodes.recorder.recorded > len(HOSTILE)
    assert len(nodes.reports) == nodes.monitor.published
