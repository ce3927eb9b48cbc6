"""The Task Manager Node (paper, Section 4 and Listing 2)."""

from __future__ import annotations

import logging
import time
from collections.abc import Callable, Collection, Iterable
from contextlib import ExitStack, suppress

from sleec_runtime.dispatch.implementations import implementations, watched
from sleec_runtime.dispatch.recording import recording
from sleec_runtime.dispatch.snapshot import Snapshot
from sleec_runtime.errors import SleecError, UnknownTrigger
from sleec_runtime.facade.done import Done
from sleec_runtime.facade.sleec import Sleec
from sleec_runtime.model import Rule
from sleec_runtime.ros.identity import snapshot_of
from sleec_runtime.ros.messages import Executed, MissionEvent
from sleec_runtime.ros.node import Node, OnProblem, seconds_of
from sleec_runtime.ros.problems import OutOfStep
from sleec_runtime.ros.recent_ids import RecentIds
from sleec_runtime.ros.task_manager.default_clauses import run_defaults
from sleec_runtime.ros.task_manager.layer_listener import LayerListener
from sleec_runtime.ros.task_manager.obligations_listener import ObligationsListener
from sleec_runtime.ros.task_manager.policies import MOST_HELD, HeldTriggers, Policy, checked_policy
from sleec_runtime.ros.task_manager.rules_of_node import claim_rules
from sleec_runtime.ros.transport import EMPTY, Fields, Topic, Transport
from sleec_runtime.support.messages import represent
from sleec_runtime.timed.failures import raise_interrupt

_LOG = logging.getLogger("sleec_runtime.ros")

TIMEOUT = 3.0
"""Seconds without a heartbeat after which a Context Manager counts as dead."""

Occurrence = Callable[..., None]
"""Takes the fields of a message, and the time at which it arrived if that is not now."""

LONGEST_HOLD = 10.0
"""Seconds for which a trigger is held."""


class TaskManagerNode:
    """Executes the rules of a task, in the layers that the Context Manager announces.

    A subclass has the methods of the rules, as in Listing 2 of the paper. Without a subclass, give `sleec` the code
    first, by `bind` and `implement`. `sleec` belongs to this node, whose rules are those with code, or `rules`. The
    node follows triggers on /mission, and those to which it subscribes.

    While it is out of step with the Context Manager, the `policy` decides: ``hold`` keeps a trigger, for at most
    `longest_hold` seconds, ``default`` runs the defaults of its rules, and ``refuse`` executes nothing. A Context
    Manager that is silent for `timeout` seconds counts as dead.

    Raises WrongType, NotBound and UnknownLabel, SnapshotRefused for rules that were not read from a text, SleecError if
    another node has `sleec`, and as `Sleec.bind`.
    """

    def __init__(
        self,
        name: str,
        sleec: Sleec,
        transport: Transport,
        *,
        policy: Policy = "refuse",
        rules: Iterable[str] | None = None,
        timeout: float = TIMEOUT,
        longest_hold: float = LONGEST_HOLD,
        on_problem: OnProblem | None = None,
    ) -> None:
        self._policy = checked_policy(policy)
        timeout = seconds_of(timeout, "timeout")
        longest_hold = seconds_of(longest_hold, "longest_hold")
        self._sleec = sleec
        self._node = Node(name, transport, sleec.clock, on_problem)
        self._held = HeldTriggers(self._node.clock, longest_hold)
        self._mission_ids = RecentIds()
        self._watched = ExitStack()
        with self._node.starting():
            self._node.own(sleec)
            if type(self) is not TaskManagerNode:
                sleec.bind(self)
            self._rules = claim_rules(sleec, rules)
            obligations = snapshot_of(sleec).index.whole.obligations
            self._recordable = {name for name in obligations if sleec.code.implementation(name) is not None}
            for robot in sleec.bound_objects():
                self._recordable.update(implementations(robot, obligations))
                self._watched.enter_context(watched(robot, obligations))
            by_label = snapshot_of(sleec).index.whole.by_label
            self._triggers = frozenset(by_label[label].trigger for label in self._rules)
            sleec.listen(self._anticipate)
            self._send = self._node.sender(Executed)
            self.layer_listener = LayerListener(self._node, sleec, timeout, self._release)
            self._occurrences = {trigger: self._occurrence(trigger) for trigger in self._triggers}
            self._obligations = ObligationsListener(self._node, sleec, self.layer_listener, self._report_error)
            self._node.listen(MissionEvent, self._receive)
            self._node.every(timeout, self._expire)

    def subscribe(self, topic: str | Topic, trigger: str) -> None:
        """Takes each message on `topic` as an occurrence of `trigger`. The code of its rules gets the fields.

        A topic that is given by its name has the type ``std_msgs/msg/Empty``. Raises UnknownTrigger for a trigger
        without a rule in this node.
        """
        if trigger not in self._triggers:
            hint = "give the trigger of a rule of this node; a Context Manager subscribes to those of rules with time"
            raise UnknownTrigger(trigger, self._triggers, hint)
        topic = topic if isinstance(topic, Topic) else Topic(topic, EMPTY)
        self._node.transport.subscribe(topic, self._occurrences[trigger])

    def completed(self, obligation: str) -> None:
        """An obligation of a rule with time is done, whose callable is marked ``completes=False``. Raises SleecError
        if it is not under way."""
        self._obligations.complete(obligation)

    def close(self) -> None:
        """Ends the node. The transport and `sleec` stay open."""
        self._node.close()
        self.layer_listener.in_step = False
        self._watched.close()

    def _anticipate(self, before: Snapshot, after: Snapshot, rules: tuple[Rule, ...]) -> None:
        """Prepares the triggers whose rules are decided again, so that they take less time when they occur."""
        for trigger in {rule.trigger for rule in rules if rule.label in self._rules}:
            # A trigger that has no answer in this context says so when it occurs.
            with suppress(SleecError):
                self._sleec.anticipate(trigger, {})

    def _receive(self, message: MissionEvent) -> None:
        if message.trigger in self._triggers and self._mission_ids.add(message.id):
            self._occurrences[message.trigger](message.arguments)

    def _occurrence(self, trigger: str) -> Occurrence:
        """What happens when `trigger` occurs. Little code precedes that of the rules, because its delay matters."""
        layers, execute, now = self.layer_listener, self._sleec.trigger, time.time

        def occur(fields: Fields, arrived: float | None = None) -> None:
            if arrived is None:
                arrived = now()
            if not layers.in_step:
                self._deviate(trigger, fields, arrived)
                return
            with recording(apart=True) as seen:
                try:
                    done = execute(trigger, fields)
                except BaseException as error:  # noqa: BLE001 - reported
                    self._fail(trigger, arrived, error, executed=tuple(seen.executed))
                    raise_interrupt(error)
                else:
                    self._report(done, trigger, arrived, tuple(seen.executed))

        return occur

    def _report(self, done: Done, trigger: str, arrived: float, executed: tuple[str, ...]) -> None:
        own = [decision for decision in done.decisions if decision.rule.label in self._rules]
        self._send(
            Executed(
                node=self._node.name,
                triggered=arrived,
                time=time.time(),
                trigger=trigger,
                due=(due := tuple(dict.fromkeys(o.name for d in own for o in d.obligations if not o.negated))),
                executed=executed,
                unrecorded=self._unrecorded(due, executed),
                clauses=tuple((decision.rule.label, decision.clause) for decision in own),
                manager=self.layer_listener.watch.followed,
                number=self.layer_listener.layers.number_of(done.change),
            )
        )

    def _unrecorded(self, due: Iterable[str], executed: Collection[str]) -> tuple[str, ...]:
        """The obligations whose executions no recording sees: the code has no callable for them."""
        return tuple(name for name in due if name not in self._recordable and name not in executed)

    # Out of step ------------------------------------------------------------------------------

    def _deviate(self, trigger: str, fields: Fields, arrived: float) -> None:
        """Treats a trigger by the policy."""
        reason = self.layer_listener.reason
        if self._node.closed:
            return
        if self._policy == "default":
            with recording(apart=True) as seen:
                try:
                    due = run_defaults(self._sleec, trigger, self._rules, fields)
                except BaseException as error:  # noqa: BLE001 - reported
                    self._fail(trigger, arrived, error, policy="default", executed=tuple(seen.executed))
                    raise_interrupt(error)
                    return
            clauses = tuple((decision.rule.label, decision.clause) for decision in due.decisions)
            executed = tuple(seen.executed)
            self._send_without_context(
                trigger,
                arrived,
                policy="default",
                due=due.obligations,
                executed=executed,
                unrecorded=self._unrecorded(due.obligations, executed),
                clauses=clauses,
            )
        elif self._policy == "refuse":
            self._refuse(trigger, arrived, reason)
        elif not self._held.hold(trigger, fields, arrived):
            self._refuse(trigger, arrived, f"{MOST_HELD} triggers are held already; {reason}")

    def _release(self) -> None:
        """Decides what is held, until the code of a rule takes the node out of step again."""
        # In this order: the first messages may arrive before there is a Layer Listener, when nothing is held.
        while self._held and self.layer_listener.in_step and (held := self._held.take()) is not None:
            if held.until < self._node.clock.now():
                self._refuse(held.trigger, held.arrived, "it was held for too long")
            else:
                self._occurrences[held.trigger](held.fields, held.arrived)

    def _expire(self) -> None:
        for held in self._held.take_expired():
            self._refuse(held.trigger, held.arrived, f"it was held for too long; {self.layer_listener.reason}")

    def _refuse(self, trigger: str, arrived: float, reason: str) -> None:
        self._node.report(OutOfStep(f"{trigger} is refused: {reason}"))
        self._send_without_context(trigger, arrived, policy=self._policy, refused=reason, executed=())

    def _fail(self, trigger: str, arrived: float, error: BaseException, **fields: object) -> None:
        self._send_without_context(trigger, arrived, failed=self._report_error(trigger, error), **fields)

    def _report_error(self, what: str, error: BaseException) -> str:
        """Reports an error of the code of a task, and returns it as text."""
        if isinstance(error, SleecError):
            text = f"{type(error).__name__}: {error}"
        else:
            text = represent(error)
            _LOG.error("%s: %s failed", self._node.name, what, exc_info=error)
        problem = SleecError(f"{what} failed: {text}")
        problem.__cause__ = error
        self._node.report(problem)
        return text

    def _send_without_context(self, trigger: str, arrived: float, **fields: object) -> None:
        self._send(
            Executed(node=self._node.name, triggered=arrived, time=time.time(), trigger=trigger, **fields)  # type: ignore[arg-type]
        )
