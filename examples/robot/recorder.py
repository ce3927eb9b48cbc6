"""The process that records the mission: python -m examples.robot.recorder LOG"""

from __future__ import annotations

import sys

from sleec_runtime.ros import RecorderNode
from sleec_runtime.ros.messages import ConditionsUpdate, DomainChange, LayersUpdate, MissionEvent

from .process import run
from .tasks import ACTIONS

TOPICS = (
    *(message.topic for message in (DomainChange, ConditionsUpdate, LayersUpdate, MissionEvent)),
    ACTIONS,
)

if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit("usage: python -m examples.robot.recorder LOG")
    # It waits a little, so that the record has each trigger before what the robot does.
    run(lambda transport: RecorderNode(transport, sys.argv[1], TOPICS), settle=0.2)
