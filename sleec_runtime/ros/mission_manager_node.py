"""The Mission Manager Node (paper, Section 4): it guides the mission by triggering tasks."""

from __future__ import annotations

import uuid
from collections.abc import Callable, Mapping
from typing import Any

from sleec_runtime.ros.messages import DomainChange, Executed, MissionEvent
from sleec_runtime.ros.node import Node, OnProblem
from sleec_runtime.ros.transport import Transport
from sleec_runtime.ros.transport_errors import MalformedMessage
from sleec_runtime.support.messages import represent


class MissionManagerNode:
    """Triggers tasks on /mission, and publishes the domain of the robot. `on_executed` gets reports of tasks."""

    def __init__(
        self,
        transport: Transport,
        *,
        name: str = "mission_manager",
        on_executed: Callable[[Executed], object] | None = None,
        on_problem: OnProblem | None = None,
    ) -> None:
        self._node = Node(name, transport, on_problem=on_problem)
        self._send = self._node.sender(MissionEvent)
        self._send_domain = self._node.sender(DomainChange)
        if on_executed is not None:
            self._node.listen(Executed, on_executed)

    def start(self, trigger: str, arguments: Mapping[str, Any] | None = None) -> None:
        """The trigger occurs now: each task with a rule for it gets `arguments`, which are plain data.

        Raises MalformedMessage for other data.
        """
        if arguments is not None and not isinstance(arguments, Mapping):
            raise MalformedMessage(f"the arguments are {represent(arguments)}, not a mapping")
        self._send(MissionEvent(trigger=trigger, arguments=dict(arguments or {}), id=uuid.uuid4().hex))

    def enter_domain(self, domain: str | None) -> None:
        """The robot is in another domain; None puts the rules of all domains in force."""
        self._send_domain(DomainChange(domain=domain))

    def close(self) -> None:
        """Ends the node. The transport stays open."""
        self._node.close()
