"""Rules with time across nodes: their deadlines are in the process of the Context Manager, and only there."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from functools import partial
from itertools import count
from typing import Any

from sleec_runtime.dispatch.implementations import obligation
from sleec_runtime.errors import SleecError, UnknownTrigger
from sleec_runtime.facade.sleec import Sleec
from sleec_runtime.model import literals
from sleec_runtime.ros.context_manager.layer_updater import LayerUpdater
from sleec_runtime.ros.identity import snapshot_of
from sleec_runtime.ros.json_object import read_object, write_object
from sleec_runtime.ros.managed_triggers import managed_triggers
from sleec_runtime.ros.messages import Completed, Executed, MissionEvent, Start
from sleec_runtime.ros.node import Node
from sleec_runtime.ros.recent_ids import RecentIds
from sleec_runtime.ros.transport_errors import MalformedMessage
from sleec_runtime.support.messages import represent
from sleec_runtime.timed.plain_data import DEEPEST, is_plain

MOST_ARGUMENTS = Start.max_size - 10_000
"""The most characters of the arguments of a trigger. The other fields of a `Start` need less than the rest."""


class DeadlineManager:
    """Decides the triggers of rules with time, measures the windows, and starts obligations by messages.

    A message is repeated with each heartbeat until a task completes the obligation or its window has closed. A task
    executes it once. `save` is called after each change, before the message is sent.
    """

    def __init__(self, node: Node, sleec: Sleec, updater: LayerUpdater, save: Callable[[], object]) -> None:
        whole = snapshot_of(sleec).index.whole
        self.triggers = managed_triggers(whole)
        self._known = whole.triggers
        self._node = node
        self._sleec = sleec
        self._updater = updater
        self._save = save
        self._numbers = count(1)
        self._lock = threading.Lock()
        self._mission_ids = RecentIds()
        self._open: dict[str, Start] = {}
        self._send = node.sender(Start)
        self._report = node.sender(Executed)
        rules = [rule for rule in whole.rules if rule.trigger in self.triggers]
        names = {literal.name for rule in rules for clause in rule.clauses() for literal in literals(clause)}
        if names:
            sleec.implement({name: obligation(name, completes=False)(partial(self._start, name)) for name in names})

    def listen(self) -> None:
        """Follows triggers and completions from now on."""
        self._node.listen(MissionEvent, self._receive)
        self._node.listen(Completed, self._complete)

    def occur(self, trigger: str, arguments: Mapping[str, Any]) -> None:
        """A trigger of a rule with time occurs. Raises as `Sleec.trigger`, and MalformedMessage for arguments that no
        message can carry to the tasks, or no checkpoint can hold. Reports this on /executed."""
        arrived = time.time()
        try:
            self._sleec.trigger(trigger, _received(arguments))
        except SleecError as error:
            failed = f"{type(error).__name__}: {error}"
            name = self._node.name
            self._report(Executed(node=name, triggered=arrived, time=time.time(), trigger=trigger, failed=failed))
            raise
        finally:
            self._save()

    def repeat(self) -> None:
        """Sends the starts of pending obligations again."""
        under_way = {one.obligation for one in self._sleec.pending() if one.state == "under way"}
        for name, start in tuple(self._open.items()):
            if name in under_way:
                self._send(replace(start, manager=self._updater.manager, beat=self._updater.beat))
            elif self._close(start):
                self._save()

    def open_starts(self) -> tuple[str, ...]:
        """The starts of pending obligations, as JSON."""
        return tuple(start.to_json() for start in tuple(self._open.values()))

    def restore(self, starts: Iterable[str], pending: Mapping[str, Any]) -> None:
        """Continues with the `open_starts` and the pending obligations of an earlier process. Raises SnapshotRefused
        and MalformedMessage."""
        self._open = {start.obligation: start for start in map(Start.from_json, starts)}
        self._sleec.restore(pending)

    def _receive(self, message: MissionEvent) -> None:
        if message.trigger not in self._known:
            raise UnknownTrigger(message.trigger, self._known)
        if message.trigger in self.triggers and self._mission_ids.add(message.id):
            self.occur(message.trigger, message.arguments)

    def _start(self, name: str, arguments: Mapping[str, Any]) -> None:
        """The code of an obligation."""
        if self._node.closed:
            return
        updater = self._updater
        start = Start(
            manager=updater.manager,
            number=updater.number,
            beat=updater.beat,
            id=f"{updater.manager}/{next(self._numbers)}",
            obligation=name,
            arguments=arguments,
        )
        with self._lock:
            self._open[name] = start
        self._save()
        self._send(start)

    def _complete(self, message: Completed) -> None:
        start = self._open.get(message.obligation)
        # A late or repeated report belongs to an earlier start.
        if start is not None and start.id == message.id and self._close(start):
            try:
                self._sleec.completed(message.obligation)
            finally:
                self._save()

    def _close(self, start: Start) -> bool:
        """Removes a start. Returns False if it is closed, or if a later start has replaced it."""
        with self._lock:
            if self._open.get(start.obligation) is not start:
                return False
            del self._open[start.obligation]
            return True


def _received(arguments: Mapping[str, Any]) -> dict[str, Any]:
    """Arguments as the tasks receive them, which is also what a checkpoint holds. Raises MalformedMessage."""
    if not isinstance(arguments, Mapping):
        raise MalformedMessage(f"the message is {represent(arguments)}, not a mapping of fields")
    text = write_object({"arguments": dict(arguments)}, MOST_ARGUMENTS)
    found: dict[str, Any] = read_object(text, MOST_ARGUMENTS)["arguments"]
    if not is_plain(found):
        raise MalformedMessage(
            f"the arguments have more than {DEEPEST} levels", "give a number or a name of the object"
        )
    return found
