"""Robustness over DDS: processes of CO-SLEEC are killed and restarted, and a second Context Manager starts."""

from __future__ import annotations

import tempfile
import time
from collections import Counter
from pathlib import Path
from typing import NamedTuple

from benchmarks.evaluation.deployment import Deployment
from benchmarks.evaluation.situations import GroundTruth, Situation
from benchmarks.evaluation.variants.systems import CONTEXT_MANAGER
from sleec_runtime.model import Ruleset

DEAD = 4.5
"""Seconds after which all tasks know that the Context Manager is dead, or that a second one is."""


class Phase(NamedTuple):
    """What was triggered in a phase, and what was executed. `wrong` are actions that the rules do not oblige."""

    phase: str
    triggers: int
    obliged: int
    executed: int
    wrong: int


def run(ruleset: Ruleset, domain: int, situation: Situation) -> list[Phase]:
    """Runs the scenario in a DDS domain. The situation stays the same, and held triggers execute what it obliges."""
    truth = GroundTruth(ruleset)
    phases: list[Phase] = []
    with tempfile.TemporaryDirectory() as folder:
        checkpoint = Path(folder) / "context-manager.json"
        with Deployment("CO-SLEEC", domain, together=True, checkpoint=checkpoint) as robot:
            robot.await_start()
            robot.report(situation)
            time.sleep(1)
            obliged = Counter(name for task in robot.tasks for name in truth.obligations(situation, task))

            def phase(name: str, triggers: bool, executes: bool) -> None:
                """Triggers all tasks, or waits for triggers that are held."""
                for task in robot.tasks if triggers else ():
                    robot.trigger(task)
                count = obliged.total() if executes else 0
                actions = robot.await_actions(count) + robot.await_actions(1, timeout=1)
                executed = Counter(action.name for action in actions)
                wrong = executed - obliged if executes else executed
                phases.append(Phase(name, len(robot.tasks) * triggers, count, executed.total(), wrong.total()))

            manager, tasks = robot.processes
            phase("all processes run", triggers=True, executes=True)
            robot.kill(manager)
            time.sleep(DEAD)
            phase("Context Manager killed", triggers=True, executes=False)
            robot.await_ready(robot.start([CONTEXT_MANAGER]))
            phase("Context Manager restarted: triggers that were held", triggers=False, executes=True)
            robot.kill(tasks)
            robot.await_ready(robot.start(robot.tasks))
            time.sleep(DEAD)
            phase("tasks killed and restarted", triggers=True, executes=True)
            second = robot.start([CONTEXT_MANAGER])
            robot.await_ready(second)
            time.sleep(DEAD)
            phase("second Context Manager", triggers=True, executes=False)
            robot.kill(second)
            phase("second one killed: triggers that were held", triggers=False, executes=True)
    return phases
