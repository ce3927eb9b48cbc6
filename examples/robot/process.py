"""What all processes of the robot share: a transport, a start, and an end."""

from __future__ import annotations

import os
import sys
import threading
from collections.abc import Callable
from contextlib import suppress
from typing import Any

from sleec_runtime.errors import SleecError
from sleec_runtime.ros import TaskManagerNode
from sleec_runtime.ros.dds.transport import DdsTransport
from sleec_runtime.ros.transport import Transport


def run(start: Callable[[Transport], Any], settle: float = 0) -> None:
    """Runs the node that `start` returns until the input of the process ends.

    `settle` is that of `DdsTransport`. In a ROS 2 workspace, `RclpyTransport(name)` of
    `sleec_runtime.ros.rclpy_transport` takes its place.
    """
    ended = threading.Event()
    threading.Thread(target=_await_end, args=(ended,), daemon=True).start()
    try:
        transport = DdsTransport(settle=settle)
        try:
            node = start(transport)
            while not _is_ready(node) and not ended.wait(0.01):
                pass
            # The launcher may have ended meanwhile.
            with suppress(BrokenPipeError):
                os.write(sys.stdout.fileno(), b"ready\n")
            ended.wait()
            node.close()
        finally:
            transport.close()
    except KeyboardInterrupt:
        pass
    except SleecError as error:
        sys.exit(f"error: {error}")


def _await_end(ended: threading.Event) -> None:
    while os.read(sys.stdin.fileno(), 4096):
        pass
    ended.set()


def _is_ready(node: Any) -> bool:
    """Whether a task knows the context."""
    return not isinstance(node, TaskManagerNode) or node.layer_listener.in_step
