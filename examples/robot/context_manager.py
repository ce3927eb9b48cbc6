"""The process that keeps the context: python -m examples.robot.context_manager"""

from __future__ import annotations

from sleec_runtime.ros import ContextManagerNode

from .process import run
from .rules import sleec

if __name__ == "__main__":
    run(lambda transport: ContextManagerNode(sleec, transport))
