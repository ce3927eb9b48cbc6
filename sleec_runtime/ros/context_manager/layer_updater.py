"""The Layer Updater (paper, Section 4): it publishes which layers to activate and deactivate, and heartbeats."""

from __future__ import annotations

from collections.abc import Callable

from sleec_runtime.dispatch.snapshot import Snapshot
from sleec_runtime.facade.sleec import Sleec
from sleec_runtime.ros.active_layers import LayerChange
from sleec_runtime.ros.context_manager.hedge_clauses_manager import ContextChange
from sleec_runtime.ros.identity import Identifier, Identity, snapshot_of
from sleec_runtime.ros.message import Conditions
from sleec_runtime.ros.messages import Heartbeat, LayersRequest, LayersUpdate
from sleec_runtime.ros.node import Node
from sleec_runtime.ros.problems import RulesDiffer
from sleec_runtime.ros.recent_ids import RecentIds

OFTEN = LayersUpdate.topic.depth // 2
"""The number of updates of which one is full. So a late subscriber, which gets the last updates, gets a full one."""

NAMES = 8
"""The number of names and rules for each update between full ones, if that is more: a full update costs time for each
of them. A late subscriber may then have to ask."""


class LayerUpdater:
    """Numbers the updates of a Context Manager, which is identified by `manager`, a new name for each of its runs.

    Its methods are called within changes of `sleec`, or hold them up, so that numbers are in the order of changes.
    """

    def __init__(self, node: Node, sleec: Sleec, manager: str, active_layers: Callable[[], tuple[str, ...]]) -> None:
        self._node = node
        self._sleec = sleec
        self.manager = manager
        self._active_layers = active_layers
        self._identifier = Identifier()
        self._identity = self._identifier.identity(snapshot_of(sleec))
        self._differing = RecentIds()
        self.number = 0
        self.beat = 0
        self._send_update = node.sender(LayersUpdate)
        self._send_beat = node.sender(Heartbeat)
        node.listen(LayersRequest, self._requested)

    def publish(self, change: ContextChange) -> None:
        """Publishes a change of context, until the node is closed."""
        if self._node.closed:
            return
        self.number += 1
        index = change.context.index
        often = max(OFTEN, (len(index.vocabulary) + len(index.place_of)) // NAMES)
        if self.number % often == 0 or self._identifier.identity(change.context) is not self._identity:
            self._publish_all(change.context)
        else:
            self._send_update(self._update(change.context, False, change.conditions, change.layers))

    def publish_all(self) -> None:
        """Publishes the whole context."""
        self._sleec.hold(self._publish_all)

    def heartbeat(self) -> None:
        """Publishes the next heartbeat."""
        self._sleec.hold(self._beat)

    def _beat(self, _: Snapshot) -> None:
        self.beat += 1
        self._send_beat(Heartbeat(manager=self.manager, number=self.number, beat=self.beat, **self._identity._asdict()))

    def _requested(self, request: LayersRequest) -> None:
        self.publish_all()
        self.heartbeat()
        theirs = Identity(request.ruleset, request.reading)
        if theirs != self._identity and self._differing.add(f"{request.node} {theirs}"):
            raise RulesDiffer(
                f"node `{request.node}` has the rules {theirs}, and this node has {self._identity}",
                "give both nodes the same file of rules, and the same reading",
            )

    def _publish_all(self, context: Snapshot) -> None:
        self._send_update(self.full_update(context))

    def full_update(self, context: Snapshot) -> LayersUpdate:
        """The whole context as an update. To be called within a change of `sleec`, or `Sleec.hold`."""
        self._identity = self._identifier.identity(context)
        return self._update(context, True, dict(context.conditions), LayerChange(self._active_layers(), ()))

    def _update(self, context: Snapshot, full: bool, conditions: Conditions, layers: LayerChange) -> LayersUpdate:
        return LayersUpdate(
            **self._identity._asdict(),
            **layers._asdict(),
            manager=self.manager,
            number=self.number,
            domain=context.index.domain,
            full=full,
            conditions=conditions,
        )
