"""Rules with time across nodes: the Context Manager follows the windows, and tasks execute what it starts."""

from __future__ import annotations

import json
import time
from collections import OrderedDict
from contextlib import suppress
from functools import partial
from pathlib import Path
from random import Random
from typing import Any

import pytest

import sleec_runtime
from sleec_runtime import Sleec, VirtualClock, language
from sleec_runtime.errors import ConflictInContext, Prohibited, SleecError, SnapshotRefused, UnknownTrigger
from sleec_runtime.ros import TaskManagerNode
from sleec_runtime.ros.faults import Faults, FaultyTransport
from sleec_runtime.ros.managed_triggers import managed_triggers
from sleec_runtime.ros.messages import Completed, MissionEvent, Start
from sleec_runtime.ros.transport import EMPTY, Fields, Topic
from tests.support.robot_nodes import Robot

NURSE = language.parse("""
RULE fall WHEN UserFell THEN CallNurse WITHIN 60 seconds OTHERWISE CallAmbulance UNLESS Night IN WHICH CASE LightOn
RULE rest WHEN UserSleeps THEN NOT Vacuum WITHIN 20 seconds
RULE dust WHEN DustSeen THEN Vacuum
RULE walk WHEN MorningComes THEN OfferWalk WITHIN 10 TO 30 seconds
RULE tea WHEN Thirst THEN MakeTea
""")
NAMES = sorted(NURSE.obligations)


class Ward:
    """A robot with a nurse task, whose call of the nurse takes time, and another task."""

    def __init__(self, **more: Any) -> None:
        self.robot = Robot(NURSE, **more)
        self.robot.advance(1)
        self.link = FaultyTransport(self.robot.network.transport(), Faults(), 0, self.robot.clock)
        self.nurse = self.start_nurse()
        self.robot.task("other", ["Vacuum", "OfferWalk", "MakeTea", "LightOn"])
        self.robot.deliver()

    def start_nurse(self) -> TaskManagerNode:
        sleec = self.robot.sleec()
        log = self.robot.log

        @sleec_runtime.obligation("CallNurse", completes=False)
        def call_nurse(fields: Fields) -> None:
            log.append(f"CallNurse {fields.get('room')}")

        sleec.implement({"CallNurse": call_nurse, "CallAmbulance": lambda fields: log.append("CallAmbulance")})
        return TaskManagerNode("nurse", sleec, self.link, on_problem=self.robot.problems.append)

    def fall(self, room: int = 1) -> None:
        event = MissionEvent(trigger="UserFell", arguments={"room": room})
        self.robot.outside.publisher(event.topic).publish(event.to_fields())
        self.robot.deliver()


class Alone:
    """The rules in one process, where each obligation is completed just after it is started."""

    def __init__(self) -> None:
        self.log: list[str] = []
        self.clock = VirtualClock()
        self.sleec = Sleec(NURSE, clock=self.clock)
        self._under_way: list[str] = []
        self.sleec.implement(
            {name: sleec_runtime.obligation(name, completes=False)(partial(self._start, name)) for name in NAMES}
        )

    def trigger(self, name: str) -> None:
        with suppress(ConflictInContext):
            self.sleec.trigger(name)
        self._complete()

    def advance(self, seconds: int) -> None:
        for _ in range(2 * seconds):
            self.clock.advance(0.5)
            self._complete()

    def _start(self, name: str) -> None:
        self.log.append(name)
        self._under_way.append(name)

    def _complete(self) -> None:
        for name in self._under_way:
            with suppress(Prohibited):
                self.sleec.completed(name)
        self._under_way.clear()


def test_the_triggers_that_share_obligations_with_rules_with_times_are_managed() -> None:
    assert managed_triggers(NURSE) == {"UserFell", "UserSleeps", "DustSeen", "MorningComes"}
    joined = language.parse(NURSE.source.text + "EXCLUSIVE MakeTea, LightOn\n")
    assert managed_triggers(joined) == joined.triggers
    assert managed_triggers(language.parse("RULE tea WHEN Thirst THEN MakeTea")) == frozenset()


def test_an_obligation_that_is_completed_in_time_is_fulfilled() -> None:
    ward = Ward()
    ward.fall(2)
    assert ward.robot.log == ["CallNurse 2"]
    ward.robot.advance(30)
    ward.nurse.completed("CallNurse")
    ward.robot.advance(60)
    assert ward.robot.log == ["CallNurse 2"]
    assert [(one.node, one.executed) for one in ward.robot.executed] == [("nurse", ("CallNurse",))]
    with pytest.raises(SleecError, match="`CallNurse` is not under way"):
        ward.nurse.completed("CallNurse")
    assert ward.robot.problems == []


def test_an_obligation_that_is_not_completed_has_its_otherwise() -> None:
    ward = Ward()
    ward.fall()
    ward.robot.advance(59)
    assert ward.robot.log == ["CallNurse 1"]
    ward.robot.advance(2)
    assert ward.robot.log == ["CallNurse 1", "CallAmbulance"]
    ward.robot.advance(60)
    assert ward.robot.log == ["CallNurse 1", "CallAmbulance"], "the ambulance has completed at once"


def test_windows_that_open_later_and_prohibitions_hold_for_all_tasks() -> None:
    ward = Ward()
    ward.robot.trigger("MorningComes")
    ward.robot.trigger("UserSleeps")
    assert ward.robot.trigger("DustSeen") == []
    assert "Vacuum" in str(ward.robot.problems[0])
    assert isinstance(ward.robot.problems[0], Prohibited)
    assert "forbids it" in str(ward.robot.executed[-1].failed)
    assert ward.robot.trigger("Thirst") == ["MakeTea"], "without times, the task decides"
    ward.robot.advance(11)
    assert ward.robot.log == ["MakeTea", "OfferWalk"]
    ward.robot.advance(11)
    assert ward.robot.trigger("DustSeen") == ["Vacuum"]


@pytest.mark.parametrize("seed", range(5))
def test_nodes_execute_what_one_process_executes(seed: int) -> None:
    random = Random(seed)
    robot = Robot(NURSE)
    robot.task("one", ["CallNurse", "Vacuum", "MakeTea"])
    robot.task("other", ["CallAmbulance", "OfferWalk", "LightOn"])
    robot.deliver()
    alone = Alone()
    for _ in range(60):
        action = random.random()
        if action < 0.5:
            trigger = random.choice(sorted(NURSE.triggers))
            robot.trigger(trigger)
            alone.trigger(trigger)
        elif action < 0.6:
            night = random.random() < 0.5
            robot.report({"Night": night})
            alone.sleec.update({"Night": night})
        else:
            seconds = random.choice((1, 5, 10, 20))
            robot.advance(seconds)
            alone.advance(seconds)
        assert robot.log == alone.log
    assert len(set(alone.log)) >= 3


def test_the_context_at_the_trigger_decides() -> None:
    ward = Ward()
    ward.robot.report({"Night": True})
    ward.fall()
    assert ward.robot.log == ["LightOn"]


def test_a_start_that_is_lost_is_repeated_and_one_that_is_repeated_runs_once() -> None:
    ward = Ward()
    ward.link.faults = Faults(drop=1)
    ward.fall()
    assert ward.robot.log == []
    ward.link.faults = Faults(duplicate=1)
    ward.robot.advance(5)
    assert ward.robot.log == ["CallNurse 1"]


def test_a_report_that_is_lost_is_repeated_and_a_late_one_does_not_fulfil_the_next_obligation() -> None:
    ward = Ward()
    reports: list[Fields] = []
    ward.robot.outside.subscribe(Completed.topic, reports.append)
    ward.fall()
    ward.nurse.completed("CallNurse")
    ward.robot.deliver()
    ward.fall()
    ward.robot.outside.publisher(Completed.topic).publish(reports[0])
    ward.robot.advance(61)
    assert ward.robot.log == ["CallNurse 1", "CallNurse 1", "CallAmbulance"]


def test_old_starts_and_those_of_another_context_manager_are_ignored() -> None:
    ward = Ward()
    ward.robot.advance(5)
    manager = ward.robot.manager.manager
    for start in (
        Start(manager=manager, number=0, beat=1, id="old", obligation="CallAmbulance", arguments={}),
        Start(manager="other", number=0, beat=9, id="other", obligation="CallAmbulance", arguments={}),
    ):
        ward.robot.outside.publisher(Start.topic).publish(start.to_fields())
        ward.robot.deliver()
    assert ward.robot.log == []


def test_deadlines_survive_a_restart_of_the_context_manager(tmp_path: Path) -> None:
    ward = Ward(checkpoint=tmp_path / "checkpoint.json")
    ward.robot.report({"Night": False})
    ward.robot.trigger("MorningComes")
    ward.fall(3)
    ward.robot.crash_manager()
    second = ward.robot.context_manager(checkpoint=tmp_path / "checkpoint.json")
    ward.robot.advance(5)
    assert ward.robot.log == ["CallNurse 3"], "the start is repeated, and the task knows it"
    ward.robot.advance(60)
    assert ward.robot.log == ["CallNurse 3", "OfferWalk", "CallAmbulance"]
    assert ward.robot.executed[-1].manager == second.manager


@pytest.mark.parametrize(
    "arguments",
    [OrderedDict(header=OrderedDict(frame="map"), at=(1, 2)), {"x": json.loads("[" * 49 + "]" * 49)}, {"x": 2**63}],
)
def test_deadlines_with_any_arguments_survive_a_restart(arguments: Fields, tmp_path: Path) -> None:
    """Through rclpy, a message is an OrderedDict of others."""
    ward = Ward(checkpoint=tmp_path / "checkpoint.json")
    ward.robot.manager.subscribe("/fallen", "UserFell")
    ward.robot.outside.publisher(Topic("/fallen", EMPTY)).publish(arguments)
    ward.robot.deliver()
    ward.robot.crash_manager()
    ward.robot.context_manager(checkpoint=tmp_path / "checkpoint.json")
    ward.robot.advance(65)
    assert ward.robot.log == ["CallNurse None", "CallAmbulance"]


def test_an_obligation_may_be_completed_after_a_restart(tmp_path: Path) -> None:
    ward = Ward(checkpoint=tmp_path / "checkpoint.json")
    ward.fall()
    ward.robot.crash_manager()
    ward.robot.context_manager(checkpoint=tmp_path / "checkpoint.json")
    ward.nurse.completed("CallNurse")
    ward.robot.advance(100)
    assert ward.robot.log == ["CallNurse 1"]


def test_a_task_that_starts_again_does_what_is_still_open() -> None:
    ward = Ward()
    ward.fall()
    ward.nurse.close()
    ward.start_nurse()
    ward.robot.advance(2)
    assert ward.robot.log == ["CallNurse 1", "CallNurse 1"]


def test_the_context_and_the_domain_survive_a_restart(tmp_path: Path) -> None:
    rules = language.parse(
        "RULE door WHEN Ring THEN OpenDoor UNLESS Temperature < 36.6 IN WHICH CASE Wait\n"
        "DOMAIN home\nRULE light WHEN Ring THEN LightOn"
    )
    robot = Robot(rules, checkpoint=tmp_path / "checkpoint.json")
    robot.report({"Temperature": 36})
    robot.enter("home")
    robot.crash_manager()
    robot.context_manager(checkpoint=tmp_path / "checkpoint.json")
    robot.task()
    robot.deliver()
    assert robot.trigger("Ring") == ["Wait", "LightOn"]


@pytest.mark.parametrize("text", ["", "{}", "[]", '{"update": "{}", "starts": [], "pending": {}}', "\xff"])
def test_a_malformed_checkpoint_is_refused(text: str, tmp_path: Path) -> None:
    path = tmp_path / "checkpoint.json"
    path.write_bytes(text.encode("latin-1"))
    with pytest.raises(SnapshotRefused, match="checkpoint") as refused:
        Robot(NURSE, checkpoint=path)
    assert refused.value.hint == "move the file away to start without it"
    assert "send " not in refused.value.message


def test_a_checkpoint_of_other_rules_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "checkpoint.json"
    Robot(NURSE, checkpoint=path).report({"Night": True})
    with pytest.raises(SnapshotRefused, match="of the rules"):
        Robot(language.parse("RULE tea WHEN Thirst THEN MakeTea"), checkpoint=path)


def test_a_checkpoint_of_a_time_to_come_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "checkpoint.json"
    Ward(checkpoint=path).fall()
    saved = json.loads(path.read_text(encoding="utf-8"))
    saved["pending"]["saved_at"] = time.time() + 1000
    path.write_text(json.dumps(saved), encoding="utf-8")
    with pytest.raises(SnapshotRefused, match="the clock was set back") as refused:
        Robot(NURSE, checkpoint=path)
    assert refused.value.hint == "move the file away to start without it"


def test_a_checkpoint_that_cannot_be_written_is_reported_and_the_node_continues(tmp_path: Path) -> None:
    ward = Ward(checkpoint=tmp_path / "folder" / "checkpoint.json")
    ward.fall()
    assert ward.robot.log == ["CallNurse 1"]
    assert "cannot be written" in str(ward.robot.problems[0])


def test_triggers_of_rules_with_times_have_topics_at_the_context_manager() -> None:
    ward = Ward()
    ward.robot.manager.subscribe("/fallen", "UserFell")
    ward.robot.outside.publisher(Topic("/fallen", EMPTY)).publish({})
    ward.robot.deliver()
    assert ward.robot.log == ["CallNurse None"]
    with pytest.raises(UnknownTrigger):
        ward.robot.manager.subscribe("/thirst", "Thirst")
    with pytest.raises(UnknownTrigger, match="UserFell"):
        ward.nurse.subscribe("/fallen", "UserFell")
    ward.robot.trigger("Unheard")
    assert isinstance(ward.robot.problems[-1], UnknownTrigger)
