"""The Layer Listener (paper, Section 4): it follows the updates of the Context Manager, and asks again after a gap."""

from __future__ import annotations

import threading
from collections.abc import Callable

from sleec_runtime.errors import SleecError
from sleec_runtime.facade.sleec import Sleec
from sleec_runtime.ros.identity import Identifier, Identity, snapshot_of
from sleec_runtime.ros.messages import Heartbeat, LayersRequest, LayersUpdate
from sleec_runtime.ros.node import Node
from sleec_runtime.ros.problems import NoManager, OutOfStep, RulesDiffer, SecondManager
from sleec_runtime.ros.task_manager.cop_layer_manager import CopLayerManager
from sleec_runtime.ros.task_manager.manager_watch import ManagerWatch
from sleec_runtime.timed.clock import Time

CHECKS = 3
"""The number of checks in each timeout."""


class LayerListener:
    """Keeps the layers of a task in step with the Context Manager.

    `in_step` tells whether the node has the last update of the only Context Manager, which is alive and has the same
    rules; `reason` says why not. While it is false, the node asks for the whole context. It becomes true only when a
    message arrives, and then `on_in_step` is called in the thread of the transport. It becomes false also as time
    passes.
    """

    def __init__(self, node: Node, sleec: Sleec, timeout: float, on_in_step: Callable[[], object]) -> None:
        self.in_step = False
        self.reason = str(NoManager())
        self._reported = ""
        self.watch = ManagerWatch(timeout)
        self._patience = node.clock.now() + timeout
        """The time from which it is a problem that no Context Manager is known."""
        self._node = node
        self._sleec = sleec
        self._on_in_step = on_in_step
        self._lock = threading.RLock()
        self._identifier = Identifier()
        self._have: int | None = None
        self._seen = 0
        """The highest number of an update that has arrived."""
        self._fault: SleecError | None = None
        self.layers = CopLayerManager(sleec, self._changed_by_others)
        self._send = node.sender(LayersRequest)
        node.listen(LayersUpdate, self._updated)
        node.listen(Heartbeat, self._beaten)
        self._ask()
        node.repeat(self._next_check, self._check)

    def _updated(self, update: LayersUpdate) -> None:
        with self._lock:
            self._leave_silent(update.manager)
            if self.watch.followed is None and update.full:
                self.watch.followed, self._seen = update.manager, 0
            if self._is_of_followed(update):
                self._seen = max(self._seen, update.number)
                self._follow(update)
            self._judge(may_enter=True)
        if self.in_step:
            self._on_in_step()

    def _beaten(self, beat: Heartbeat) -> None:
        with self._lock:
            # Only a heartbeat is a sign of life: a transport may deliver updates that were sent long ago.
            self.watch.hear(beat.manager, beat.beat, beat.number, self._node.clock.now())
            self._leave_silent(beat.manager)
            self._is_of_followed(beat)
            self._judge(may_enter=True)
        if self.in_step:
            self._on_in_step()

    def _next_check(self) -> Time:
        now = self._node.clock.now()
        with self._lock:
            end = self.watch.end(now)
        regular = now + self.watch.timeout / CHECKS
        return end if now < end < regular else regular

    def _check(self) -> None:
        with self._lock:
            self._judge(may_enter=False)
            if not self.in_step:
                self._ask()

    def _leave_silent(self, manager: str) -> None:
        """Stops following a silent Context Manager if another `manager` sends messages."""
        now = self._node.clock.now()
        if manager != self.watch.followed and self.watch.silent(now):
            if self.watch.followed is not None:
                self._patience = now + self.watch.timeout
            self.watch.followed, self._have, self._fault = None, None, None

    def _is_of_followed(self, message: LayersUpdate | Heartbeat) -> bool:
        """Whether a message is of the Context Manager that the node follows, and of the same rules."""
        if self.watch.followed not in (None, message.manager):
            return False
        ours = self._identifier.identity(snapshot_of(self._sleec))
        theirs = Identity(message.ruleset, message.reading)
        if theirs != ours:
            self._fault = RulesDiffer(
                f"Context Manager {message.manager} has the rules {theirs}, and node `{self._node.name}` has {ours}",
                "give both the same file of rules, and the same reading",
            )
            return False
        return self.watch.followed is not None

    def _follow(self, update: LayersUpdate) -> None:
        """Applies an update if it is the next one, or a full one that the node needs."""
        have, number = self._have, update.number
        if update.full:
            needed = have is None or number > have or (number == have and self._fault is not None)
        else:
            needed = have is not None and number == have + 1 and self._fault is None
        if not needed:
            return
        try:
            agrees = self.layers.apply(update)
        except SleecError as error:
            self._fault = OutOfStep(f"update {number} cannot be applied: {error}")
        else:
            self._fault = None if agrees else _other_layers(number)
        self._have = number

    def _changed_by_others(self) -> None:
        # Without the lock: the thread is within a change of the instance, for which a thread with the lock may wait.
        self._fault = OutOfStep(
            f"other code changed the context of node `{self._node.name}`",
            "publish conditions on /conditions, and load the rules again for each node",
        )
        self.reason = str(self._fault)
        self.in_step = False

    def _judge(self, may_enter: bool) -> None:
        """Decides whether the node is in step. Reports each new reason, and asks for the context."""
        now = self._node.clock.now()
        problem = self._problem(now)
        if problem is None:
            self.in_step = self.in_step or may_enter
            self._reported = ""
        else:
            self.in_step = False
            self.reason = str(problem)
            if self.reason != self._reported and (now >= self._patience or not isinstance(problem, NoManager)):
                self._reported = self.reason
                self._node.report(problem)
                self._ask()

    def _problem(self, now: Time) -> SleecError | None:
        followed, announced = self.watch.followed, self.watch.announced()
        if self._fault is not None:
            return self._fault
        if followed is None or self._have is None or announced is None:
            return NoManager()
        others = self.watch.others(now)
        if others:
            names = " and ".join([followed, *others])
            return SecondManager(f"several Context Managers are active: {names}", "stop all but one")
        if self.watch.silent(now):
            return OutOfStep(
                f"Context Manager {followed} is silent for more than {self.watch.timeout:g} seconds, "
                "or code of this node took as long"
            )
        if self._have < max(self._seen, announced):
            return OutOfStep(f"update {self._have + 1} of Context Manager {followed} has not arrived")
        return None

    def _ask(self) -> None:
        ours = self._identifier.identity(snapshot_of(self._sleec))
        self._send(LayersRequest(node=self._node.name, have=self._have, **ours._asdict()))


def _other_layers(number: int) -> OutOfStep:
    return OutOfStep(
        f"update {number} names other layers than this node derives",
        "load the rules of all nodes with the same `strict`, and run one version of sleec-runtime",
    )
