"""The programs of the package: the nodes of `python -m sleec_runtime.ros`, through rclpy."""

import sys

from sleec_runtime.ros.command_line import main


def context_manager():
    """Keeps the context of the robot."""
    _run("context-manager")


def task_manager():
    """Executes the rules of a task."""
    _run("task")


def mission_manager():
    """Guides the robot through a mission."""
    _run("mission")


def recorder():
    """Records messages."""
    _run("record")


def monitor():
    """Publishes deviations from the rules."""
    _run("monitor")


def _run(node):
    sys.exit(main([node, "--transport", "rclpy", *sys.argv[1:]]))
