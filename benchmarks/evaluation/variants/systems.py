"""The nodes of each variant, by name: `context manager`, or the trigger of a task."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from pathlib import Path

from benchmarks.evaluation.variants.co_sleec import nodes as co_sleec
from benchmarks.evaluation.variants.cs_libs import tasks as cs_libs
from benchmarks.evaluation.variants.cs_libs.context_manager import ContextManagerNode
from benchmarks.evaluation.variants.cs_libs_cm import tasks as cs_libs_cm
from benchmarks.evaluation.variants.listing_2 import tasks as listing_2
from benchmarks.evaluation.variants.robot import Robot
from sleec_runtime.ros.transport import Transport

CONTEXT_MANAGER = "context manager"
VARIANTS = ("CO-SLEEC", "CS-libs", "CS-libs-CM")
LISTING_2 = "CO-SLEEC in Listing 2"
"""This system, with code in the programming model of the paper."""
RULES = Path(__file__).parent.parent.parent.parent / "rulesets" / "care-robot.sleec"

Start = Callable[[Transport], object]


def nodes(variant: str, rules: Path = RULES) -> Mapping[str, Start]:
    """How to start each node of a variant. The ablated variants do not read the rules."""
    if variant == "CO-SLEEC":
        return {
            CONTEXT_MANAGER: partial(co_sleec.context_manager, rules=rules),
            **{
                trigger: partial(co_sleec.task, rules=rules, trigger=trigger)
                for trigger in sorted(co_sleec.tasks(rules))
            },
        }
    if variant == LISTING_2:
        return {
            CONTEXT_MANAGER: partial(listing_2.context_manager, rules=rules),
            **{trigger: partial(task, rules=rules) for trigger, task in listing_2.TASKS.items()},
        }
    if variant == "CS-libs":
        return {CONTEXT_MANAGER: ContextManagerNode, **_tasks(cs_libs.TASKS)}
    return _tasks(cs_libs_cm.TASKS)


def _tasks(tasks: Mapping[str, Callable[[Transport, Robot], object]]) -> dict[str, Start]:
    return {trigger: partial(_start_task, task) for trigger, task in tasks.items()}


def _start_task(task: Callable[[Transport, Robot], object], transport: Transport) -> object:
    return task(transport, Robot(transport))
