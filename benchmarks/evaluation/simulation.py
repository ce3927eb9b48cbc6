"""A robot in one process with the clock of a test, whose messages get lost, repeated, delayed and reordered."""

from __future__ import annotations

import json
import random
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

from benchmarks.evaluation.situations import GroundTruth, Reported, Situation
from benchmarks.evaluation.variants.cs_libs import tasks as cs_libs
from benchmarks.evaluation.variants.cs_libs.context_manager import ContextManagerNode as HandWrittenContextManager
from benchmarks.evaluation.variants.cs_libs_cm import tasks as cs_libs_cm
from benchmarks.evaluation.variants.robot import Robot
from benchmarks.evaluation.variants.topics import CONDITIONS, DOMAIN, trigger_topic
from sleec_runtime import Sleec, VirtualClock
from sleec_runtime.model import Ruleset
from sleec_runtime.ros import ContextManagerNode, MissionManagerNode, TaskManagerNode
from sleec_runtime.ros.faults import Faults, FaultyTransport
from sleec_runtime.ros.in_process import InProcessTransport, Network
from sleec_runtime.ros.messages import Executed
from sleec_runtime.ros.transport import Fields, Publisher, Receive, Topic
from sleec_runtime.timed.clock import Cancel, Time

STALE = 4.0
"""Seconds for which an execution may rest on a context that has changed since: the 3 seconds after which a silent
Context Manager counts as dead, and the longest delay of a message."""
SENSED = (DOMAIN.name, CONDITIONS.name)


class OtherClock:
    """A clock that differs from another one: it started at another time, and goes faster or slower."""

    def __init__(self, clock: VirtualClock, offset: float, rate: float) -> None:
        self._clock = clock
        self._offset = offset
        self._rate = rate

    def now(self) -> Time:
        return float(self._clock.now()) * self._rate + self._offset

    def wake(self, at: Time, call: Callable[[], object]) -> Cancel:
        return self._clock.wake((float(at) - self._offset) / self._rate, call)


class Host:
    """The transport of one node. Sensors are connected to the computer of a Context Manager, so that only messages
    between nodes have faults."""

    def __init__(self, transport: InProcessTransport, faulty: FaultyTransport, has_sensors: bool) -> None:
        self.transport = transport
        self.faulty = faulty
        self._has_sensors = has_sensors

    def publisher(self, topic: Topic) -> Publisher:
        return self.transport.publisher(topic)

    def subscribe(self, topic: Topic, receive: Receive) -> None:
        used = self.transport if self._has_sensors and topic.name in SENSED else self.faulty
        used.subscribe(topic, receive)

    def close(self) -> None:
        self.faulty.close()


class SimulatedRobot(Robot):
    """Keeps what it did, instead of logging it."""

    def __init__(self) -> None:
        self.did: list[str] = []

    def _did(self, action: str) -> None:
        self.did.append(action)


@dataclass(frozen=True)
class Execution:
    """What a task executed for one trigger, and when."""

    time: Time
    trigger: str
    actions: tuple[str, ...]


class Simulation:
    """A robot of one variant. Its sensors report each change of the world; the mission triggers tasks.

    `history` has the situations of the world, and `occurrences` the triggers, with their times. `executions` are what
    tasks did, and `reports` how often tasks of CO-SLEEC reported an execution or a refusal. `draw` is for the mission.
    """

    def __init__(
        self, variant: str, ruleset: Ruleset, world: Situation, faults: Faults, draw: random.Random, skew: bool
    ) -> None:
        self.variant = variant
        self.ruleset = ruleset
        self.clock = VirtualClock()
        self.faults = faults
        self.history: list[tuple[Time, Situation]] = [(0, world)]
        self.occurrences: list[tuple[Time, str]] = []
        self.executions: list[Execution] = []
        self.reports: Counter[str] = Counter()
        self.draw = draw
        self._random = random.Random(draw.random())
        self._skew = skew
        self._network = Network()
        self._outside = self._network.transport()
        self._outside.subscribe(Executed.topic, self._reported)
        self._mission = MissionManagerNode(self._outside)
        self._robots: dict[str, SimulatedRobot] = {}
        self.hosts: dict[str, Host] = {}
        self.triggers = sorted(ruleset.triggers)
        if variant != "CS-libs-CM":
            self.start_context_manager("context manager")
        for trigger in self.triggers:
            self.start_task(trigger)
        self.report_all()
        self.advance(1)

    # Nodes ------------------------------------------------------------------------------------------

    def start_context_manager(self, name: str) -> None:
        """Starts a Context Manager, which knows the domain and no conditions."""
        host = self._host(name, has_sensors=True)
        if self.variant == "CO-SLEEC":
            ContextManagerNode(self._sleec(self.world.domain), host, name=name)
        else:
            HandWrittenContextManager(host).domain = self.world.domain

    def start_task(self, trigger: str) -> None:
        """Starts the task of a trigger."""
        robot = self._robots[trigger] = SimulatedRobot()
        host = self._host(trigger, has_sensors=False)
        if self.variant == "CO-SLEEC":
            sleec = self._sleec()
            sleec.implement(robot)
            labels = [rule.label for rule in self.ruleset.rules if rule.trigger == trigger]
            TaskManagerNode(trigger, sleec, host, policy="hold", rules=labels)
        else:
            (cs_libs.TASKS if self.variant == "CS-libs" else cs_libs_cm.TASKS)[trigger](host, robot)

    def kill(self, name: str) -> None:
        """The process of a node ends: nothing of it is sent or received any more."""
        self.hosts.pop(name).close()

    def _host(self, name: str, has_sensors: bool) -> Host:
        transport = self._network.transport()
        faulty = FaultyTransport(transport, self.faults, self._random.randrange(2**32), self.clock)
        host = self.hosts[name] = Host(transport, faulty, has_sensors)
        return host

    def _sleec(self, domain: str | None = None) -> Sleec:
        """Strict, so that nothing is decided by conditions that nobody has reported."""
        draw = self._random
        clock = OtherClock(self.clock, draw.uniform(-1e6, 1e6), draw.uniform(0.98, 1.02)) if self._skew else self.clock
        return Sleec(self.ruleset, domain, strict=True, clock=clock)

    # The world ----------------------------------------------------------------------------------------

    @property
    def world(self) -> Situation:
        """The present situation."""
        return self.history[-1][1]

    def report_all(self) -> None:
        """The sensors report everything."""
        self._outside.publisher(DOMAIN).publish({"data": json.dumps({"domain": self.world.domain})})
        self._outside.publisher(CONDITIONS).publish({"data": json.dumps(self.world.conditions)})
        self.deliver()

    def change(self, name: str, value: Reported) -> None:
        """A condition changes, and its sensor reports it."""
        conditions = {**self.world.conditions, name: value}
        self.history.append((self.clock.now(), replace(self.world, conditions=conditions)))
        self._outside.publisher(CONDITIONS).publish({"data": json.dumps({name: value})})
        self.deliver()

    def occur(self, trigger: str) -> None:
        """The mission triggers a task."""
        self.occurrences.append((self.clock.now(), trigger))
        if self.variant == "CO-SLEEC":
            self._mission.start(trigger)
        else:
            self._outside.publisher(trigger_topic(trigger)).publish({})
        self.deliver()

    def advance(self, seconds: float) -> None:
        """Time passes."""
        for _ in range(round(seconds * 10)):
            self.clock.advance(0.1)
            self._collect()
            self.deliver()

    def deliver(self) -> None:
        """Delivers all messages."""
        while self._network.deliver(limit=1):
            self._collect()

    def _collect(self) -> None:
        for trigger, robot in self._robots.items():
            if robot.did:
                self.executions += [
                    Execution(self.clock.now(), trigger, actions) for actions in split(self.ruleset, trigger, robot.did)
                ]
                robot.did.clear()

    def _reported(self, fields: Fields) -> None:
        report = Executed.from_fields(fields)
        self.reports["refused" if report.refused or report.failed else "executed"] += 1

    # What was right -----------------------------------------------------------------------------------

    def wrong(self, truth: GroundTruth) -> list[Execution]:
        """The executions that no situation of the last seconds obliged."""
        return [one for one in self.executions if not self._is_justified(one, truth)]

    def repeated(self) -> int:
        """The executions beyond the number of triggers so far."""
        events = [(float(time), 0, trigger) for time, trigger in self.occurrences]
        events += [(float(one.time), 1, one.trigger) for one in self.executions]
        waiting: Counter[str] = Counter()
        count = 0
        for _, executed, trigger in sorted(events):
            if not executed:
                waiting[trigger] += 1
            elif waiting[trigger]:
                waiting[trigger] -= 1
            else:
                count += 1
        return count

    def late(self) -> int:
        """The executions whose trigger did not occur in the last fifth of a second: their tasks held it, or its message
        was delayed."""
        return sum(
            not any(
                trigger == one.trigger and 0 <= float(one.time) - float(time) < 0.2
                for time, trigger in self.occurrences
            )
            for one in self.executions
        )

    def _is_justified(self, execution: Execution, truth: GroundTruth) -> bool:
        ends = [time for time, _ in self.history[1:]] + [float("inf")]
        return any(
            tuple(sorted(execution.actions)) == tuple(truth.obligations(situation, execution.trigger))
            for (start, situation), end in zip(self.history, ends)
            if start <= execution.time and end >= float(execution.time) - STALE
        )


def split(ruleset: Ruleset, trigger: str, actions: Sequence[str]) -> list[tuple[str, ...]]:
    """What a task did at once, by trigger: a task may execute several held triggers, one after the other."""
    clauses = [
        tuple(obligation.name for obligation in clause.obligations)
        for rule in ruleset.rules
        if rule.trigger == trigger
        for clause in rule.clauses()
    ]
    found, rest = [], tuple(actions)
    while rest:
        known = [clause for clause in clauses if rest[: len(clause)] == clause]
        first = known[0] if known else rest
        found.append(first)
        rest = rest[len(first) :]
    return found
