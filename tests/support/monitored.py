"""Missions that a monitor watches and a recorder records at once, on a network within the process."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path

from sleec_runtime.audit.auditor import Auditor
from sleec_runtime.audit.deviation import Deviation
from sleec_runtime.audit.mapping import Misfit, TopicMapping
from sleec_runtime.audit.mapping_file import LiveTopic, MappingFile, parse_mapping
from sleec_runtime.audit.observation import Entered, Executed, Observation, Occurred, RawMessage, Reported
from sleec_runtime.errors import SleecError
from sleec_runtime.evaluation.trace import Untimed
from sleec_runtime.model import Rational, Ruleset
from sleec_runtime.ros import Network, Topic
from sleec_runtime.ros.monitoring.deviation_report import DeviationReport, report_of
from sleec_runtime.ros.monitoring.live_topics import RECORDED, live_topics
from sleec_runtime.ros.monitoring.monitor_node import MonitorNode
from sleec_runtime.ros.monitoring.recorder_node import RecorderNode
from sleec_runtime.ros.monitoring.robot_mapping import RobotMapping
from sleec_runtime.timed.clocks import VirtualClock
from sleec_verify.audit.readers.json_lines import JsonLines

ANY = "example_msgs/msg/Any"
"""The type of all topics: a transport within the process does not look at it."""


def mapping_text(ruleset: Ruleset) -> str:
    """A mapping of a topic of its own to each name of the rules."""
    events = sorted(ruleset.triggers | ruleset.obligations)
    tables = {
        "conditions": [f'{one} = {{topic = "/conditions/{one}", field = "data"}}' for one in ruleset.conditions],
        "measures": [f'{one} = {{topic = "/conditions/{one}", field = "data"}}' for one in ruleset.measures],
        "events": [f'{one} = {{topic = "/event/{one}"}}' for one in events],
        "obligations": [f'{one} = {{topic = "/done/{one}"}}' for one in events],
    }
    lines = ['domain = {topic = "/mode", field = "data"}']
    return "\n".join(lines + [line for title, entries in tables.items() for line in (f"[{title}]", *entries)])


class MonitoredMission:
    """A mission of `ruleset` with a monitor and a recorder, and a clock that the test moves."""

    def __init__(
        self,
        ruleset: Ruleset,
        log: Path,
        *,
        mapping: str | None = None,
        start: Rational = 0,
        tolerance: Rational = 0,
        untimed: Untimed = "at",
        period: float = 0.75,
        late: bool = False,
    ) -> None:
        self.ruleset, self.log = ruleset, log
        self.options = {"tolerance": tolerance, "untimed": untimed}
        self.sources = parse_mapping(mapping or mapping_text(ruleset), "m.toml", ruleset).sources
        names = sorted(TopicMapping(self.sources).topics)
        live = MappingFile(self.sources, None, {name: LiveTopic(ANY) for name in names}, {})
        self.clock = VirtualClock(start)
        self.network = Network()
        self.received: list[DeviationReport] = []
        self.deviations: list[Deviation] = []
        self.problems: list[SleecError] = []
        self.outside = self.network.transport()
        self.outside.subscribe(
            DeviationReport.topic, lambda fields: self.received.append(DeviationReport.from_fields(fields))
        )
        topics = live_topics(RECORDED, live)
        self.recorder = RecorderNode(self.network.transport(), log, topics, clock=self.clock)
        self.monitor = MonitorNode(
            self.auditor(),
            self.network.transport(),
            live,
            late=late,
            clock=self.clock,
            period=period,
            on_deviation=self.deviations.append,
            on_problem=self.problems.append,
        )

    def auditor(self) -> Auditor:
        return Auditor(self.ruleset, **self.options)  # type: ignore[arg-type]

    def send(self, topic: str, fields: object, kind: str = ANY) -> None:
        """Publishes a message, and delivers it."""
        self.outside.publisher(Topic(topic, kind)).publish(fields)  # type: ignore[arg-type]
        self.network.deliver()

    def advance(self, seconds: Rational | float) -> None:
        """Lets time pass, and delivers what this publishes."""
        self.clock.advance(seconds)
        self.network.deliver()

    def happen(self, mission: Iterable[Observation]) -> None:
        """What is observed in a mission happens on this robot."""
        for one in mission:
            self.advance(one.time - self.clock.now())
            if isinstance(one, Entered):
                self.send("/mode", {"data": one.domain or ""})
            elif isinstance(one, Reported):
                for name, value in one.conditions.items():
                    self.send(f"/conditions/{name}", {"data": value})
            elif isinstance(one, Occurred):
                self.send(f"/event/{one.event}", {})
            else:
                assert isinstance(one, Executed)
                self.send(f"/done/{one.obligation}", {"data": "done"})

    def end(self) -> None:
        self.monitor.close()
        self.network.deliver()
        self.recorder.close()

    def audited(self) -> list[DeviationReport]:
        """The deviations that an audit finds in the recording, which ends when the monitor ended."""
        auditor, mapping = self.auditor(), RobotMapping(self.sources)
        found = []
        for _, item in JsonLines(self.log).read():
            assert isinstance(item, RawMessage)
            if item.topic == DeviationReport.topic.name:
                continue
            for observation in mapping.observations(item):
                if not isinstance(observation, Misfit):
                    found += auditor.observe(observation)
        found += auditor.finish(self.monitor.auditor.time)
        return [report_of(deviation, "", 0, 0) for deviation in found]


def contents(reports: Iterable[DeviationReport]) -> list[str]:
    """Reports without what differs between two runs, in an order that does not depend on that of discovery."""
    return sorted(replace(one, monitor="", number=0, found=0).to_json() for one in reports)
