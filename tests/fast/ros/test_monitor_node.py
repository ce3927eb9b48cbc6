"""The monitor node: what it publishes and when, and that bad messages neither stop it nor are guessed at."""

from __future__ import annotations

import math
import threading
from pathlib import Path
from typing import Any

import pytest

from sleec_runtime.audit.auditor import Auditor
from sleec_runtime.audit.deviation import Deviation
from sleec_runtime.audit.mapping_file import parse_mapping
from sleec_runtime.language import parse
from sleec_runtime.ros import Network, Topic
from sleec_runtime.ros.monitoring.deviation_report import DeviationReport
from sleec_runtime.ros.monitoring.monitor_node import MonitorNode
from sleec_runtime.ros.transport import EMPTY
from tests.support.monitored import MonitoredMission, contents
from tests.support.robot_nodes import Robot

CURTAINS = parse("""
CONDITION UserUndressed
RULE curtains WHEN CurtainRequest THEN OpenCurtains WITHIN 5 seconds
UNLESS UserUndressed IN WHICH CASE NOT OpenCurtains WITHIN 5 seconds
""")
START = 1_790_000_000


def mission(tmp_path: Path, text: str | None = None, **options: Any) -> MonitoredMission:
    return MonitoredMission(CURTAINS, tmp_path / "log.jsonl", mapping=text, start=START, **options)


def test_a_deviation_is_published_as_soon_as_it_is_certain(tmp_path: Path) -> None:
    robot = mission(tmp_path, period=0.5)
    robot.send("/conditions/UserUndressed", {"data": False})
    robot.send("/event/CurtainRequest", {})
    robot.advance(5)
    assert not robot.received
    robot.advance(0.5)
    (missed,) = robot.received
    assert missed == DeviationReport(
        monitor=robot.monitor.monitor,
        number=0,
        found=START + 5.5,
        time=START + 5,
        kind="missed",
        text="at 2026-09-21T14:13:25Z, `OpenCurtains` has not been executed, and rule `curtains` requires it "
        "since 2026-09-21T14:13:20Z",
        reasons=("curtains requires OpenCurtains within 5 seconds", "clause 1: UserUndressed is false"),
        rule="curtains",
        clause=0,
        obligation="OpenCurtains",
        since=START,
        first=START,
        last=START + 5,
        conditions={"UserUndressed": False},
    )
    robot.send("/conditions/UserUndressed", {"data": True})
    robot.send("/event/CurtainRequest", {})
    robot.advance(0.25)
    robot.send("/done/OpenCurtains", {})
    assert len(robot.received) == 1
    # What happens at one time is decided once the clock has moved on.
    robot.advance(0.5)
    _, prohibited = robot.received
    assert (prohibited.kind, prohibited.number, prohibited.clause) == ("prohibited", 1, 1)
    assert (prohibited.time, prohibited.found) == (START + 5.75, START + 6)
    robot.end()
    assert len(robot.received) == 2
    assert contents(robot.audited()) == contents(robot.received)


ORDERED = """
CONDITION Night
RULE alarm WHEN Fire THEN CallFireBrigade WITHIN 10 seconds UNLESS Night
RULE leave WHEN Alarm THEN OpenDoor WITHIN 10 seconds
"""
LATE_MAPPING = """
[conditions]
Night = {topic = "/night", field = "data"}
[events]
Fire = {topic = "/smoke", field = "data", above = 0.5}
Alarm = {topic = "/alarm"}
[obligations]
CallFireBrigade = {topic = "/call"}
OpenDoor = {action = "/open_door", goal = "succeeded"}
"""


@pytest.mark.parametrize("late", [True, False])
def test_after_a_late_start_what_happened_before_is_unknown(tmp_path: Path, late: bool) -> None:
    """Smoke and an open door are seen first by their state. What was required before the start is unknown."""
    robot = MonitoredMission(parse(ORDERED), tmp_path / "log", mapping=LATE_MAPPING, start=START, late=late)
    done = {"status_list": [{"status": 4, "goal_info": {"goal_id": {"uuid": [1]}}}]}
    robot.advance(1)
    robot.send("/smoke", {"data": 0.9})
    robot.send("/open_door/_action/status", done)
    robot.advance(5)
    robot.send("/call", {})
    robot.advance(30)
    seen = [report.kind for report in robot.received]
    assert seen == ([] if late else ["undetermined", "unrequired"])
    # From then on, it is as for any other.
    robot.send("/smoke", {"data": 0.1})
    robot.send("/smoke", {"data": 0.9})
    robot.send("/night", {"data": False})
    robot.send("/alarm", {})
    robot.send("/call", {})
    robot.advance(30)
    robot.send("/call", {})
    robot.advance(1)
    assert [report.kind for report in robot.received][len(seen) :] == ["undetermined", "missed", "unrequired"]


def test_before_the_domain_is_known_only_rules_of_all_domains_are_decided(tmp_path: Path) -> None:
    rules = parse(
        "RULE everywhere WHEN Call THEN Answer\n"
        "DOMAIN home\nRULE at_home WHEN Call THEN Come\nNEVER Answer AND Come\n"
        "DOMAIN ward\nRULE at_ward WHEN Call THEN Beep\n"
    )
    robot = MonitoredMission(rules, tmp_path / "log", late=True)

    def call() -> list[tuple[str, str | None]]:
        before = len(robot.received)
        robot.advance(1)
        robot.send("/event/Call", {})
        robot.send("/done/Answer", {})
        robot.send("/done/Come", {})
        robot.advance(1)
        return [(report.kind, report.rule) for report in robot.received[before:]]

    # The last one is the constraint.
    assert call() == [("undetermined", "at_home"), ("undetermined", "at_ward"), ("undetermined", None)]
    assert {report.missing for report in robot.received} == {("domain",)}
    robot.send("/mode", {"data": "home"})
    assert call() == [("constraint", None)]
    robot.send("/mode", {"data": ""})
    assert call() == [("missed", "at_ward"), ("constraint", None)]


def test_a_late_monitor_learns_the_context_from_the_context_manager() -> None:
    robot = Robot(CURTAINS)
    robot.report({"UserUndressed": False})
    robot.report({"UserUndressed": True})
    kinds: list[str] = []
    transport = robot.network.transport()
    monitor = MonitorNode(
        Auditor(CURTAINS, tolerance=0), transport, clock=robot.clock, on_deviation=lambda one: kinds.append(one.kind)
    )
    robot.deliver()
    # No task executes the rule. Without the context, it would be undetermined.
    robot.trigger("CurtainRequest")
    robot.advance(10)
    assert monitor.auditor.moment.conditions == {"UserUndressed": True}
    assert kinds == []
    robot.report({"UserUndressed": False})
    robot.trigger("CurtainRequest")
    robot.advance(10)
    assert kinds == ["missed"]
    monitor.close()


def test_an_event_before_a_late_start_may_be_the_one_that_a_relation_requires(tmp_path: Path) -> None:
    greet = "THEN Greet WITHIN 1 minutes\n"
    rules = parse(f"RELATION Open PRECEDES Enter\nRULE o WHEN Open {greet}RULE r WHEN Enter {greet}")
    for late, kind in ((True, "undetermined"), (False, "constraint")):
        robot = MonitoredMission(rules, tmp_path / f"{late}", late=late)
        robot.advance(1)
        robot.send("/event/Enter", {})
        robot.advance(1)
        assert [report.kind for report in robot.received] == [kind]


def test_values_that_do_not_fit_are_published_once_for_each_name(tmp_path: Path) -> None:
    rules = parse("MEASURE age: integer\nRULE r WHEN Enter AND age > 5 THEN Greet\n")
    robot = MonitoredMission(rules, tmp_path / "log")
    for value in (1.5, 2.5, 3.5):
        robot.send("/conditions/age", {"data": value})
        robot.advance(1)
    assert [report.kind for report in robot.received] == ["wrong-value"]
    assert robot.monitor.problems == {"age": 3}


MAPPING = """
[conditions]
UserUndressed = {topic = "/user", field = "state.undressed", above = 0.5}
[events]
CurtainRequest = {topic = "/request", field = "data", equals = "curtains"}
[obligations]
OpenCurtains = {action = "/open_curtains", goal = "succeeded"}
"""
STATUS = "/open_curtains/_action/status"


@pytest.mark.parametrize(
    ("topic", "fields"),
    [
        ("/user", {}),
        ("/user", {"state": []}),
        ("/user", {"state": {"undressed": "yes"}}),
        ("/user", {"state": {"undressed": [0.0] * 1_000_000}}),
        ("/user", {"state": {"undressed": True}}),
        ("/user", {"state": {"undressed": 10**5000}}),
        ("/user", {"state": {"undressed": b"1"}}),
        ("/user", 5),
        ("/user", None),
        ("/request", {"text": "curtains"}),
        ("/request", ["data"]),
        (STATUS, {"status_list": 4}),
        (STATUS, {"status_list": [{"status": 4}]}),
        (STATUS, {"status_list": [{"status": 4, "goal_info": {"goal_id": {"uuid": 7}}}]}),
        (STATUS, {"status_list": [{"status": [4], "goal_info": {"goal_id": {"uuid": [7]}}}]}),
    ],
)
def test_messages_that_do_not_fit_are_reported_once_and_counted(tmp_path: Path, topic: str, fields: object) -> None:
    robot = mission(tmp_path, MAPPING)
    robot.send("/user", {"state": {"undressed": 0.1}})
    for _ in range(3):
        robot.send(topic, fields)
        robot.advance(1)
    (problem,) = robot.problems
    assert str(problem).startswith("[")
    assert robot.monitor.problems.total() == 3
    # The rest works, and what the message should have said is unknown.
    robot.send("/request", {"data": "curtains"})
    robot.advance(20)
    robot.end()
    kinds = [report.kind for report in robot.received]
    # An execution that nobody could read may have been that of the obligation.
    assert kinds == (["undetermined"] if topic in ("/user", STATUS) else ["missed"])


def test_unknown_values_are_not_problems(tmp_path: Path) -> None:
    robot = mission(tmp_path, MAPPING)
    for value in (0.9, math.nan, None):
        robot.send("/user", {"state": {"undressed": value}})
        robot.advance(1)
    robot.send("/request", {"data": "curtains"})
    robot.end()
    assert [report.kind for report in robot.received] == ["undetermined"]
    assert not robot.problems


@pytest.mark.parametrize(("value", "kinds"), [(math.inf, []), (-math.inf, ["missed"])])
def test_infinity_is_a_value_that_a_condition_compares(tmp_path: Path, value: float, kinds: list[str]) -> None:
    robot = mission(tmp_path, MAPPING)
    robot.send("/user", {"state": {"undressed": value}})
    robot.send("/request", {"data": "curtains"})
    robot.advance(20)
    robot.end()
    assert [report.kind for report in robot.received] == kinds
    assert not robot.problems


def test_topics_without_messages_are_logged_once(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    robot = mission(tmp_path, MAPPING)
    robot.send("/request", {"data": "curtains"})
    robot.advance(100)
    lines = [record.getMessage() for record in caplog.records if "no message has arrived" in record.getMessage()]
    assert len(lines) == 1
    assert lines[0].startswith("monitor: no message has arrived yet on /open_curtains/_action/status, /user;")


def test_a_callback_that_fails_and_a_closed_transport_do_not_stop_it(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    robot = mission(tmp_path)

    def fail(deviation: Deviation) -> None:
        raise ValueError(deviation.kind)

    robot.monitor._on_deviation = fail
    for _ in range(2):
        robot.send("/event/CurtainRequest", {})
        robot.advance(1)
    assert [report.number for report in robot.received] == [0, 1]
    assert caplog.text.count("ValueError: undetermined") == 2
    robot.monitor.transport.close()
    robot.send("/event/CurtainRequest", {})
    robot.monitor.close()
    robot.monitor.close()


def test_with_threads_and_the_real_clock_a_deviation_arrives_by_itself() -> None:
    network = Network(threads=True)
    robot, watcher = network.transport(), network.transport()
    rules = parse("CONDITION Dark\nNEVER Drive AND Dark\nRULE go WHEN Go THEN Drive UNLESS Dark\n")
    text = """
        [conditions]
        Dark = {topic = "/dark", field = "data"}
        [events]
        Go = {topic = "/go"}
        [obligations]
        Drive = {topic = "/drive"}
        [topics]
        "/dark" = {type = "std_msgs/msg/Bool"}
        "/go" = {type = "std_msgs/msg/Empty"}
        "/drive" = {type = "std_msgs/msg/Empty"}
    """
    mapping = parse_mapping(text, "m.toml", rules)
    arrived = threading.Event()
    received: list[DeviationReport] = []

    def receive(fields: Any) -> None:
        received.append(DeviationReport.from_fields(fields))
        arrived.set()

    robot.subscribe(DeviationReport.topic, receive)
    monitor = MonitorNode(Auditor(rules, tolerance=0.05), watcher, mapping)
    robot.publisher(Topic("/dark", "std_msgs/msg/Bool")).publish({"data": False})
    robot.publisher(Topic("/go", EMPTY)).publish({})
    assert arrived.wait(20)
    assert received[0].kind == "missed"
    assert 0 < received[0].found - received[0].time < 20
    monitor.close()
    robot.close()
    watcher.close()
