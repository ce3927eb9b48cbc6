"""What a variant does in situations: `python -m benchmarks.evaluation.variants.behaviour VARIANT <situations.json`.

The nodes run in this process. A situation is an object with `domain`, `conditions` and `trigger`. Prints, for each
situation, the list of the actions. If the system refuses to start, prints the reason.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Mapping, Sequence
from typing import Any

from benchmarks.evaluation.variants.robot import ROBOT_LOG
from benchmarks.evaluation.variants.systems import nodes
from benchmarks.evaluation.variants.topics import CONDITIONS, DOMAIN, trigger_topic
from sleec_runtime.errors import SleecError
from sleec_runtime.ros import ContextManagerNode, TaskManagerNode
from sleec_runtime.ros.in_process import Network
from sleec_runtime.ros.transport import Fields


def behaviour(variant: str, situations: Sequence[Mapping[str, Any]]) -> list[list[str]]:
    """The actions of a variant in each situation. Raises SleecError if the system refuses to start."""
    network = Network()
    transport = network.transport()
    actions: list[str] = []

    def log(message: Fields) -> None:
        actions.append(json.loads(str(message["data"]))["action"])

    transport.subscribe(ROBOT_LOG, log)
    started = [start(network.transport()) for start in nodes(variant).values()]
    domain, conditions = transport.publisher(DOMAIN), transport.publisher(CONDITIONS)
    found = []
    for situation in situations:
        domain.publish({"data": json.dumps({"domain": situation["domain"]})})
        conditions.publish({"data": json.dumps(situation["conditions"])})
        network.deliver()
        transport.publisher(trigger_topic(situation["trigger"])).publish({})
        network.deliver()
        found.append(list(actions))
        actions.clear()
    for node in started:
        if isinstance(node, (ContextManagerNode, TaskManagerNode)):
            node.close()
    return found


def main() -> None:
    try:
        print(json.dumps({"actions": behaviour(sys.argv[1], json.load(sys.stdin))}))
    except SleecError as error:
        print(json.dumps({"refused": str(error)}))


if __name__ == "__main__":
    main()
