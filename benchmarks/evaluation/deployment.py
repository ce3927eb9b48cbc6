"""A variant that runs in processes of its own over DDS, and the connection of the mission to it."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import time
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from queue import Empty, SimpleQueue
from types import TracebackType
from typing import NamedTuple

from benchmarks.evaluation.situations import Situation
from benchmarks.evaluation.variants.robot import ROBOT_LOG
from benchmarks.evaluation.variants.systems import CONTEXT_MANAGER, RULES, nodes
from benchmarks.evaluation.variants.topics import CONDITIONS, DOMAIN, trigger_topic
from sleec_runtime.ros.dds.environment import LOOPBACK
from sleec_runtime.ros.dds.transport import DdsTransport
from sleec_runtime.ros.transport import Fields

ROOT = Path(__file__).parent.parent.parent
NODE_PROCESS = "benchmarks.evaluation.node_process"
PATIENCE = 20.0
"""Seconds to wait for something that must happen, on a loaded machine."""


class Action(NamedTuple):
    """What the robot did, and when, in nanoseconds of the common clock."""

    name: str
    time: int


class Deployment:
    """The processes of a variant in a DDS domain of their own: one for the Context Manager, and one for each task, or
    one for all tasks with `together`. In the mission's process are a transport to publish on, and what the robot did.
    `tasks` are the triggers whose tasks run, by default all. `checkpoint` is the file of the Context Manager.
    """

    def __init__(
        self,
        variant: str,
        domain: int,
        together: bool = False,
        rules: Path = RULES,
        tasks: Sequence[str] | None = None,
        checkpoint: Path | None = None,
    ) -> None:
        self.variant = variant
        self.domain = domain
        self.actions: SimpleQueue[Action] = SimpleQueue()
        self._rules = rules
        self._environment = {**os.environ, "CYCLONEDDS_URI": LOOPBACK}
        if checkpoint is not None:
            self._environment["CHECKPOINT"] = str(checkpoint)
        self._processes: list[subprocess.Popen[str]] = []
        self.tasks = [name for name in nodes(variant) if name != CONTEXT_MANAGER] if tasks is None else list(tasks)
        self.transport = DdsTransport(domain)
        self.transport.subscribe(ROBOT_LOG, self._log)
        self._domain_publisher = self.transport.publisher(DOMAIN)
        self._conditions_publisher = self.transport.publisher(CONDITIONS)
        self._triggers = {trigger: self.transport.publisher(trigger_topic(trigger)) for trigger in self.tasks}
        managers = [[CONTEXT_MANAGER]] if CONTEXT_MANAGER in nodes(variant) else []
        for names in [*managers, *([self.tasks] if together else [[task] for task in self.tasks])]:
            self.start(names)

    def start(self, names: Sequence[str]) -> subprocess.Popen[str]:
        """Starts a process with these nodes."""
        process = subprocess.Popen(
            [sys.executable, "-m", NODE_PROCESS, self.variant, str(self._rules), str(self.domain), *names],
            cwd=ROOT,
            env=self._environment,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
        )
        self._processes.append(process)
        return process

    def kill(self, process: subprocess.Popen[str]) -> None:
        """Kills a process, so that it cannot close its transport."""
        self._processes.remove(process)
        process.kill()
        process.communicate()

    @property
    def processes(self) -> Sequence[subprocess.Popen[str]]:
        """The processes that run, the Context Manager first."""
        return tuple(self._processes)

    def __enter__(self) -> Deployment:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        for process in self._processes:
            assert process.stdin is not None
            process.stdin.close()
        for process in self._processes:
            end(process)
        self.transport.close()

    def await_start(self) -> None:
        """Waits until all nodes run, and have discovered the mission."""
        for process in self._processes:
            self.await_ready(process)
        for publisher in (self._domain_publisher, self._conditions_publisher, *self._triggers.values()):
            wait_until(lambda: publisher.subscription_count() > 0)  # noqa: B023 - called at once

    def await_ready(self, process: subprocess.Popen[str]) -> None:
        """Waits until the nodes of a process run."""
        assert process.stdout is not None
        if process.stdout.readline() != "ready\n":
            raise RuntimeError(f"a process of {self.variant} did not start")

    def report(self, situation: Situation) -> None:
        """Publishes the domain and the conditions of a situation."""
        self._domain_publisher.publish({"data": json.dumps({"domain": situation.domain})})
        self._conditions_publisher.publish({"data": json.dumps(situation.conditions)})

    def trigger(self, trigger: str) -> int:
        """Publishes a trigger. Returns when, in nanoseconds of the common clock."""
        publisher = self._triggers[trigger]
        started = time.monotonic_ns()
        publisher.publish({})
        return started

    def await_actions(self, count: int, timeout: float = PATIENCE) -> list[Action]:
        """The next `count` actions, or those that happen in `timeout` seconds."""
        deadline = time.monotonic() + timeout
        found: list[Action] = []
        while len(found) < count:
            try:
                found.append(self.actions.get(timeout=max(0.0, deadline - time.monotonic())))
            except Empty:
                break
        return found

    def _log(self, message: Fields) -> None:
        entry: Mapping[str, object] = json.loads(str(message["data"]))
        self.actions.put(Action(str(entry["action"]), int(str(entry["time"]))))


def end(process: subprocess.Popen[str]) -> None:
    """Ends a process that waits for the end of its input."""
    assert process.stdin is not None
    process.stdin.close()
    process.wait(PATIENCE)


def wait_until(condition: Callable[[], bool]) -> None:
    """Waits until a condition holds. Raises TimeoutError."""
    deadline = time.monotonic() + PATIENCE
    while not condition():
        if time.monotonic() > deadline:
            raise TimeoutError(f"the condition did not hold within {PATIENCE:g} seconds")
        time.sleep(0.01)
