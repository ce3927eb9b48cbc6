"""Robustness: what is executed while messages are lost, processes end and restart, and clocks differ."""

from __future__ import annotations

import random
from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

from benchmarks.evaluation.simulation import Simulation
from benchmarks.evaluation.situations import GroundTruth, Reported, Situation, critical_values
from sleec_runtime.model import Ruleset
from sleec_runtime.ros.faults import Faults

NONE = Faults()
Incident = Callable[[Simulation], None]
"""What happens between two phases of a mission. It ends the phase of the incident too."""


@dataclass(frozen=True)
class Scenario:
    """Faults of messages, and what happens in the middle of the mission. With `skew`, the clocks differ."""

    name: str
    faults: Faults = NONE
    skew: bool = False
    during: Incident | None = None
    after: Incident | None = None


class Result(NamedTuple):
    """Counts over all missions of a scenario.

    `late` executions are those of a trigger that was held or delayed; they count as executed. `repeated` are executions
    without a trigger of their own, and `wrong` those that no situation of the last seconds obliged. Triggers whose
    message is lost are neither executed nor refused.
    """

    scenario: str
    system: str
    triggers: int
    executed: int
    late: int
    refused: int
    repeated: int
    wrong: int


def cut_off(robot: Simulation) -> None:
    """The tasks receive nothing."""
    for name in robot.triggers:
        robot.hosts[name].faulty.faults = Faults(drop=1)


def reconnect(robot: Simulation) -> None:
    """The tasks receive messages again."""
    for name in robot.triggers:
        robot.hosts[name].faulty.faults = robot.faults


def kill_context_manager(robot: Simulation) -> None:
    if "context manager" in robot.hosts:
        robot.kill("context manager")


def restart_context_manager(robot: Simulation) -> None:
    """It starts again, and knows only the domain. The sensors report everything two seconds later."""
    if robot.variant != "CS-libs-CM":
        robot.start_context_manager("context manager")
    mission(robot, 8)
    robot.report_all()


def restart_tasks(robot: Simulation) -> None:
    for name in robot.triggers:
        robot.kill(name)
        robot.start_task(name)


def add_context_manager(robot: Simulation) -> None:
    """A second one, which knows only the domain."""
    if robot.variant != "CS-libs-CM":
        robot.start_context_manager("second")


def remove_context_manager(robot: Simulation) -> None:
    if "second" in robot.hosts:
        robot.kill("second")


SCENARIOS = (
    Scenario("no faults"),
    Scenario("20 % dropped", Faults(drop=0.2)),
    Scenario("20 % duplicated", Faults(duplicate=0.2)),
    Scenario("20 % delayed", Faults(delay=0.2)),
    Scenario("20 % reordered", Faults(reorder=0.2)),
    Scenario("all of these", Faults(drop=0.2, duplicate=0.2, delay=0.2, reorder=0.2)),
    Scenario("partition", during=cut_off, after=reconnect),
    Scenario("Context Manager killed and restarted", during=kill_context_manager, after=restart_context_manager),
    Scenario("tasks killed and restarted", during=restart_tasks),
    Scenario("two Context Managers", during=add_context_manager, after=remove_context_manager),
    Scenario("clocks differ", Faults(drop=0.2, delay=0.2), skew=True),
)


def mission(robot: Simulation, steps: int) -> None:
    """Conditions change, and tasks are triggered. A step takes a quarter of a second on average."""
    draw = robot.draw
    values = reported_values(robot.ruleset)
    for _ in range(steps):
        robot.advance(draw.choice((0.1, 0.2, 0.5)))
        if draw.random() < 0.5:
            name = draw.choice(sorted(values))
            robot.change(name, draw.choice(values[name]))
        if draw.random() < 0.7:
            robot.occur(draw.choice(robot.triggers))


def reported_values(ruleset: Ruleset) -> dict[str, list[Reported]]:
    """The values that sensors report of each condition and measure."""
    return {name: [one for one in known if one is not None] for name, known in critical_values(ruleset).items()}


def run(scenario: Scenario, variant: str, ruleset: Ruleset, missions: int) -> Result:
    """Runs missions of a minute, each in a random domain, with the scenario's incident in the middle."""
    truth = GroundTruth(ruleset)
    found = Result(scenario.name, variant, 0, 0, 0, 0, 0, 0)
    for seed in range(missions):
        draw = random.Random(seed)  # the same mission for all variants
        world = {name: draw.choice(known) for name, known in reported_values(ruleset).items()}
        situation = Situation(draw.choice(ruleset.domains), world)
        robot = Simulation(variant, ruleset, situation, scenario.faults, draw, scenario.skew)
        mission(robot, 80)
        if scenario.during is not None:
            scenario.during(robot)
        mission(robot, 80)
        if scenario.after is not None:
            scenario.after(robot)
        mission(robot, 80)
        robot.advance(15)
        found = Result(
            *found[:2],
            found.triggers + len(robot.occurrences),
            found.executed + len(robot.executions),
            found.late + robot.late(),
            found.refused + robot.reports["refused"],
            found.repeated + robot.repeated(),
            found.wrong + len(robot.wrong(truth)),
        )
    return found
