"""E2: the delay from a trigger to the execution of its task, over DDS, in interleaved runs."""

from __future__ import annotations

import json
import random
import subprocess
import sys
import time
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import NamedTuple

from benchmarks.evaluation.deployment import ROOT, Action, Deployment, end, wait_until
from benchmarks.evaluation.situations import GroundTruth, Situation
from sleec_runtime.model import Ruleset

SETTLING = 0.03
"""Seconds that a change of context may take until it has reached every task."""
LATE = 1.0
"""Seconds that the second action of a trigger may come after the first."""
CHANGES = 100
"""Changes of context in each second while the context changes constantly."""
PAUSE = 0.0005
"""Seconds between an execution and the next trigger."""


class Delay(NamedTuple):
    """A trigger, and the milliseconds until the first action of its task."""

    system: str
    situation: int
    trigger: str
    milliseconds: float


@dataclass
class Delays:
    """The delays of all systems. `late` counts the triggers that executed what the situation before obliged, because a
    change had not arrived yet, and `wrong` those that executed something else."""

    samples: list[Delay] = field(default_factory=list)
    late: Counter[str] = field(default_factory=Counter)
    wrong: Counter[str] = field(default_factory=Counter)

    def of(self, system: str) -> list[float]:
        return [sample.milliseconds for sample in self.samples if sample.system == system]


def measure(
    systems: Mapping[str, Deployment],
    ruleset: Ruleset,
    situations: Sequence[Situation],
    repeats: int = 1,
    settling: float = SETTLING,
) -> Delays:
    """Triggers each task of each system `repeats` times in each situation, `settling` seconds after the change.

    All systems get the same triggers, each time in another order. Triggers of rules that oblige nothing in the domain
    are left out.
    """
    draw = random.Random(0)
    truth = GroundTruth(ruleset)
    found = Delays()
    order = list(systems)
    for deployment in systems.values():
        _warm_up(deployment, situations[0], truth)
    for number, situation in enumerate(situations):
        for deployment in systems.values():
            deployment.report(situation)
        time.sleep(settling)
        before = situations[max(0, number - 1)]
        for trigger in next(iter(systems.values())).tasks * repeats:
            expected = truth.obligations(situation, trigger)
            outdated = {tuple(truth.obligations(before, trigger))}
            draw.shuffle(order)
            for name in order if expected else ():
                _sample(found, name, systems[name], number, trigger, {tuple(expected)}, outdated)
    return found


def measure_while_changing(
    systems: Mapping[str, Deployment], ruleset: Ruleset, situations: Sequence[Situation], triggers: int
) -> Delays:
    """Triggers each task of each system `triggers` times, while a sensor reports one situation after the other.

    The situations have one domain. An execution is right if one of the situations obliges it.
    """
    draw = random.Random(0)
    truth = GroundTruth(ruleset)
    found = Delays()
    tasks = next(iter(systems.values())).tasks
    allowed = {task: {tuple(truth.obligations(situation, task)) for situation in situations} for task in tasks}
    order = list(systems)
    for deployment in systems.values():
        _warm_up(deployment, situations[0], truth)
    with _sensor([deployment.domain for deployment in systems.values()], situations):
        for number in range(triggers):
            for trigger in tasks:
                draw.shuffle(order)
                for name in order if allowed[trigger] != {()} else ():
                    _sample(found, name, systems[name], number, trigger, allowed[trigger], set())
    return found


def _warm_up(deployment: Deployment, situation: Situation, truth: GroundTruth) -> None:
    """Waits until each task executes what the first situation obliges. The change of domain may take a second."""

    def executes() -> bool:
        deployment.trigger(trigger)
        actions = deployment.await_actions(len(expected))
        return sorted(action.name for action in actions) == list(expected)

    deployment.report(situation)
    time.sleep(SETTLING)
    for trigger in deployment.tasks:
        expected = truth.obligations(situation, trigger)
        wait_until(executes)


@contextmanager
def _sensor(domains: Sequence[int], situations: Sequence[Situation]) -> Iterator[None]:
    """Runs the process that reports one situation after the other."""
    process = subprocess.Popen(
        [sys.executable, "-m", "benchmarks.evaluation.sensor_process", str(CHANGES), *map(str, domains)],
        cwd=ROOT,
        stdin=subprocess.PIPE,
        text=True,
    )
    assert process.stdin is not None
    process.stdin.write(json.dumps([situation.conditions for situation in situations]) + "\n")
    process.stdin.flush()
    try:
        yield
    finally:
        end(process)


def _sample(
    found: Delays,
    name: str,
    deployment: Deployment,
    number: int,
    trigger: str,
    allowed: set[tuple[str, ...]],
    outdated: set[tuple[str, ...]],
) -> None:
    """Triggers one task, and waits for its actions."""
    started = deployment.trigger(trigger)
    actions = deployment.await_actions(1)
    while actions and _names(actions) not in allowed:
        further = deployment.await_actions(1, timeout=LATE)
        if not further:
            break
        actions += further
    if _names(actions) in allowed:
        milliseconds = (min(action.time for action in actions) - started) / 1e6
        found.samples.append(Delay(name, number, trigger, milliseconds))
    elif _names(actions) in outdated:
        found.late[name] += 1
    else:
        found.wrong[name] += 1
    time.sleep(PAUSE)


def _names(actions: Sequence[Action]) -> tuple[str, ...]:
    return tuple(sorted(action.name for action in actions))
