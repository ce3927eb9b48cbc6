"""The nodes of CO-SLEEC: the Context Manager Node, and a Task Manager Node for each trigger of the rules."""

from __future__ import annotations

import os
from pathlib import Path

from benchmarks.evaluation.variants.robot import Robot
from benchmarks.evaluation.variants.topics import trigger_topic
from sleec_runtime import load
from sleec_runtime.ros import ContextManagerNode, TaskManagerNode
from sleec_runtime.ros.transport import Transport


def context_manager(transport: Transport, rules: Path) -> ContextManagerNode:
    # Only the scenarios in which it is killed set this variable: writing the file takes time.
    return ContextManagerNode(load(rules), transport, checkpoint=os.environ.get("CHECKPOINT"))


def task(transport: Transport, rules: Path, trigger: str) -> TaskManagerNode:
    sleec = load(rules)
    sleec.implement(Robot(transport))
    labels = [rule.label for rule in sleec.ruleset.rules if rule.trigger == trigger]
    node = TaskManagerNode(trigger, sleec, transport, policy="hold", rules=labels)
    node.subscribe(trigger_topic(trigger), trigger)
    return node


def tasks(rules: Path) -> frozenset[str]:
    return load(rules).ruleset.triggers
