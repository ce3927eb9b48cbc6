"""The process that keeps the context: python -m examples.robot.context_manager"""

from __future__ import annotations

from examples.robot.process import run
from examples.robot.rules import sleec
from sleec_runtime.ros import ContextManagerNode

if __name__ == "__main__":
    run(lambda transport: ContextManagerNode(sleec, transport))
