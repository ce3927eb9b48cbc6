"""Nodes of a robot on a network within the process, with the clock of a test."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from sleec_runtime import Sleec, VirtualClock
from sleec_runtime.errors import SleecError
from sleec_runtime.model import Ruleset
from sleec_runtime.ros import ContextManagerNode, Network, TaskManagerNode
from sleec_runtime.ros.message import Conditions
from sleec_runtime.ros.messages import ConditionsUpdate, DomainChange, Executed, MissionEvent
from sleec_runtime.ros.transport import Transport


class Robot:
    """A Context Manager and tasks that log what they execute. `deliver` delivers all messages.

    `executed` are the reports on /executed, `log` is what the code of the tasks executed, and `problems` are what all
    nodes reported, in order. `manager_sleec` has the context of the last Context Manager.
    """

    def __init__(self, ruleset: Ruleset, domain: str | None = None, **more: Any) -> None:
        """`domain` and `more` are for the Context Manager."""
        self.ruleset = ruleset
        self.clock = VirtualClock()
        self.network = Network()
        self.log: list[str] = []
        self.executed: list[Executed] = []
        self.problems: list[SleecError] = []
        self.outside = self.network.transport()
        self.outside.subscribe(Executed.topic, lambda fields: self.executed.append(Executed.from_fields(fields)))
        self.manager_transport = self.network.transport()
        self.manager = self.context_manager(domain, self.manager_transport, **more)

    def sleec(self, domain: str | None = None) -> Sleec:
        return Sleec(self.ruleset, domain, clock=self.clock)

    def context_manager(
        self, domain: str | None = None, transport: Transport | None = None, **more: Any
    ) -> ContextManagerNode:
        transport = transport or self.network.transport()
        self.manager_sleec = self.sleec(domain)
        return ContextManagerNode(self.manager_sleec, transport, on_problem=self.problems.append, **more)

    def crash_manager(self) -> None:
        """The process of the Context Manager ends."""
        self.manager.close()
        self.manager_transport.close()

    def task(
        self,
        name: str = "task",
        obligations: Iterable[str] | None = None,
        transport: Transport | None = None,
        **more: Any,
    ) -> TaskManagerNode:
        """A task that implements `obligations`, by default all."""
        sleec = self.sleec()
        names = self.ruleset.obligations if obligations is None else obligations
        sleec.implement({one: self._logged(one) for one in names})
        transport = transport or self.network.transport()
        return TaskManagerNode(name, sleec, transport, on_problem=self.problems.append, **more)

    def _logged(self, obligation: str) -> Any:
        return lambda fields: self.log.append(obligation)

    def deliver(self) -> None:
        self.network.deliver()

    def advance(self, seconds: float) -> None:
        """Lets time pass, with heartbeats, and delivers all messages."""
        while seconds > 0:
            self.clock.advance(min(seconds, 0.5))
            seconds -= 0.5
            self.deliver()

    def report(self, conditions: Conditions) -> None:
        self._publish(ConditionsUpdate(conditions=conditions))

    def enter(self, domain: str | None) -> None:
        self._publish(DomainChange(domain=domain))

    def trigger(self, name: str, identity: str | None = None) -> list[str]:
        """Triggers on /mission, and returns what is executed."""
        before = len(self.log)
        self._publish(MissionEvent(trigger=name, id=identity))
        return self.log[before:]

    def _publish(self, message: Any) -> None:
        self.outside.publisher(message.topic).publish(message.to_fields())
        self.deliver()
