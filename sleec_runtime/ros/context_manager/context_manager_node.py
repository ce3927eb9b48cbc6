"""The Context Manager Node (paper, Section 4 and Figure 1)."""

from __future__ import annotations

import uuid
from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path

from sleec_runtime.errors import SleecError, SnapshotRefused, UnknownTrigger
from sleec_runtime.facade.sleec import Sleec
from sleec_runtime.ros.context_manager.checkpoint_file import Checkpoint, CheckpointFile
from sleec_runtime.ros.context_manager.conditions_updates_listener import ConditionsUpdatesListener
from sleec_runtime.ros.context_manager.deadline_manager import DeadlineManager
from sleec_runtime.ros.context_manager.domain_listener import DomainListener
from sleec_runtime.ros.context_manager.hedge_clauses_manager import HedgeClausesManager
from sleec_runtime.ros.context_manager.layer_updater import LayerUpdater
from sleec_runtime.ros.identity import Identifier, Identity, snapshot_of
from sleec_runtime.ros.messages import Heartbeat, LayersUpdate
from sleec_runtime.ros.node import Node, OnProblem, seconds_of
from sleec_runtime.ros.problems import SecondManager
from sleec_runtime.ros.recent_ids import RecentIds
from sleec_runtime.ros.transport import EMPTY, Topic, Transport

HEARTBEAT = 1.0
"""Seconds between two heartbeats."""


class ContextManagerNode:
    """Keeps the context of the robot, and tells the tasks which layers are active. A robot has one.

    The rules and their options are those of `sleec`, which belongs to this node. It runs the rules with time: see
    `DeadlineManager`. Each `heartbeat` seconds, the node shows that it is alive. This is at most half of the `timeout`
    of the tasks. After a restart, the node continues with what is in the file `checkpoint`: the domain, the reported
    conditions, and the pending obligations.

    Raises SnapshotRefused for rules that were not read from a text, and for a checkpoint that is malformed or of other
    rules; WrongType for a wrong `heartbeat`; SleecError if another node has `sleec`.
    """

    def __init__(
        self,
        sleec: Sleec,
        transport: Transport,
        *,
        name: str = "context_manager",
        heartbeat: float = HEARTBEAT,
        checkpoint: str | Path | None = None,
        on_problem: OnProblem | None = None,
    ) -> None:
        if sleec.chains:
            raise SleecError(
                "nodes do not trigger rules by responses",
                "load the rules with chains=False, and publish the triggers of such rules",
            )
        heartbeat = seconds_of(heartbeat, "heartbeat")
        self.manager = uuid.uuid4().hex
        self._sleec = sleec
        self._node = node = Node(name, transport, sleec.clock, on_problem)
        self._file = None if checkpoint is None else CheckpointFile(checkpoint)
        self._others = RecentIds()
        with node.starting():
            node.own(sleec)
            sleec.code.is_partial = True
            saved = None if self._file is None else self._file.read()
            if saved is not None:
                with _fitting_checkpoint():
                    self._restore_context(saved)
            self.hedge_clauses = HedgeClausesManager(sleec, lambda change: self.layer_updater.publish(change))
            self.layer_updater = LayerUpdater(node, sleec, self.manager, self.hedge_clauses.active_layers)
            self.deadlines = DeadlineManager(node, sleec, self.layer_updater, self._save)
            if saved is not None:
                with _fitting_checkpoint():
                    self.deadlines.restore(saved.starts, saved.pending)
            self.deadlines.listen()
            DomainListener(node, self.hedge_clauses, self._save)
            ConditionsUpdatesListener(node, self.hedge_clauses, self._save)
            node.listen(Heartbeat, self._refuse_second)
            self.layer_updater.publish_all()
            self.layer_updater.heartbeat()
            node.every(heartbeat, self._beat)
        # A file that cannot be written is a problem from the start.
        self._save()

    def subscribe(self, topic: str | Topic, trigger: str) -> None:
        """Takes each message on `topic` as an occurrence of `trigger`, of a rule with time. Tasks subscribe to other
        triggers. A topic that is given by its name has the type ``std_msgs/msg/Empty``. Raises UnknownTrigger."""
        if trigger not in self.deadlines.triggers:
            raise UnknownTrigger(trigger, self.deadlines.triggers, "give a trigger of rules with time")
        topic = topic if isinstance(topic, Topic) else Topic(topic, EMPTY)
        self._node.subscribe(topic, partial(self.deadlines.occur, trigger))

    def close(self) -> None:
        """Ends the node. The transport and `sleec` stay open."""
        self._node.close()

    def _beat(self) -> None:
        self.layer_updater.heartbeat()
        self.deadlines.repeat()

    def _restore_context(self, saved: Checkpoint) -> None:
        update = LayersUpdate.from_json(saved.update)
        ours, theirs = Identifier().identity(snapshot_of(self._sleec)), Identity(update.ruleset, update.reading)
        if theirs != ours:
            raise SleecError(f"it is of the rules {theirs}, and this node has {ours}")
        if update.domain != self._sleec.domain:
            self._sleec.enter_domain(update.domain)
        self._sleec.update(update.conditions)

    def _save(self) -> None:
        if self._file is not None and not self._node.closed:
            try:
                self._file.write(self._checkpoint)
            except SleecError as problem:
                self._node.report(problem)

    def _checkpoint(self) -> Checkpoint:
        return Checkpoint(
            update=self._sleec.hold(self.layer_updater.full_update).to_json(),
            starts=self.deadlines.open_starts(),
            pending=self._sleec.pending_snapshot(),
        )

    def _refuse_second(self, message: Heartbeat) -> None:
        if message.manager != self.manager and self._others.add(message.manager):
            raise SecondManager(
                f"another Context Manager, {message.manager}, is active in addition to this one, {self.manager}",
                "stop one of them: tasks follow neither while both are active",
            )


@contextmanager
def _fitting_checkpoint() -> Iterator[None]:
    """Raises SnapshotRefused, with what a user of the node can do, if the block raises a SleecError."""
    try:
        yield
    except SleecError as error:
        raise SnapshotRefused(
            f"the checkpoint does not fit: {error.message}", "move the file away to start without it"
        ) from None
