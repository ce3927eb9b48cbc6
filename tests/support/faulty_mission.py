"""A random mission with faults: whatever a task executes must be what the rules require in a context that was true."""

from __future__ import annotations

from collections import Counter
from random import Random
from typing import Any

from sleec_runtime.evaluation.due import due
from sleec_runtime.model import Context, Ruleset
from sleec_runtime.ros.faults import Faults, FaultyTransport
from sleec_runtime.ros.messages import Executed, LayersUpdate
from sleec_runtime.ros.task_manager.task_manager_node import TIMEOUT
from sleec_runtime.ros.transport import Fields
from tests.support.random_contexts import random_changes
from tests.support.robot_nodes import Robot


class FaultyMission:
    """Two tasks, and Context Managers that come and go, on a network with faults.

    `outcomes` counts what became of the triggers, and `faults` the faults.
    """

    def __init__(self, ruleset: Ruleset, faults: Faults, seed: int) -> None:
        self.ruleset = ruleset
        self.random = Random(seed)
        self.robot = Robot(ruleset)
        self.outcomes: Counter[str] = Counter()
        self._faults = faults
        self._transports: list[FaultyTransport] = []
        self._contexts: dict[tuple[str, int], tuple[Context, Ruleset]] = {}
        self._ended: dict[tuple[str, int], float] = {}
        self._known: dict[str, dict[str, Any]] = {}
        self._tasks: dict[str, tuple[Any, FaultyTransport]] = {}
        self._done: list[str] = []
        self.robot.outside.subscribe(LayersUpdate.topic, self._follow)
        self.robot.outside.subscribe(Executed.topic, self._judge)
        labels = sorted(ruleset.by_label)
        self._labels = {"one": labels[::2], "other": labels[1::2]}
        for name in self._labels:
            self._start_task(name)

    @property
    def faults(self) -> Counter[str]:
        return sum((one.counts for one in self._transports), Counter())

    def run(self, steps: int) -> None:
        vocabulary = self.robot.sleec().vocabulary
        triggers = sorted(self.ruleset.triggers)
        for _ in range(steps):
            action = self.random.random()
            if action < 0.35:
                self.robot.report(random_changes(vocabulary, self.random))
            elif action < 0.75:
                self.robot.trigger(self.random.choice(triggers))
            elif action < 0.8:
                self.robot.enter(self.random.choice((None, *self.ruleset.domains)))
            elif action < 0.96:
                self.robot.advance(self.random.choice((0.5, 1.5)))
            elif action < 0.97:
                self.robot.advance(2 * TIMEOUT)
            elif action < 0.98:
                self._start_task(self.random.choice(list(self._labels)))
            elif action < 0.99:
                self._replace_manager()
            else:
                self._second_manager()
        self.robot.advance(2 * TIMEOUT)
        assert self.robot.log == self._done, "what was executed is what was reported"

    def _faulty(self) -> FaultyTransport:
        transport = self.robot.network.transport()
        faulty = FaultyTransport(transport, self._faults, self.random.randrange(10**9), self.robot.clock)
        self._transports.append(faulty)
        return faulty

    def _start_task(self, name: str) -> None:
        """Starts a task, or starts it again."""
        if name in self._tasks:
            node, transport = self._tasks[name]
            node.close()
            transport.close()
        transport = self._faulty()
        policy = self.random.choice(("hold", "refuse"))
        self._tasks[name] = (
            self.robot.task(name, rules=self._labels[name], transport=transport, policy=policy),
            transport,
        )

    def _replace_manager(self) -> None:
        self.robot.crash_manager()
        last = max(number for manager, number in self._contexts if manager == self.robot.manager.manager)
        self._ended[self.robot.manager.manager, last] = float(self.robot.clock.now())
        for _ in range(self.random.randrange(20)):
            self.robot.advance(0.5)
            self.robot.trigger(self.random.choice(sorted(self.ruleset.triggers)))
        self.robot.manager_transport = self.robot.network.transport()
        self.robot.manager = self.robot.context_manager(transport=self.robot.manager_transport)
        self.robot.deliver()

    def _second_manager(self) -> None:
        transport = self.robot.network.transport()
        second = self.robot.context_manager(transport=transport)
        self.robot.advance(1.5)
        self.robot.trigger(self.random.choice(sorted(self.ruleset.triggers)))
        second.close()
        transport.close()

    def _follow(self, fields: Fields) -> None:
        """Keeps the context of each update, and when the next one ends it."""
        update = LayersUpdate.from_fields(fields)
        known = self._known.setdefault(update.manager, {})
        if update.full:
            known.clear()
        known.update(update.conditions)
        held = {name: value for name, value in known.items() if value is not None}
        rules = self.ruleset if update.domain is None else self.ruleset.in_domain(update.domain)
        self._contexts[update.manager, update.number] = Context(frozenset(), held), rules
        self._ended.setdefault((update.manager, update.number - 1), float(self.robot.clock.now()))

    def _judge(self, fields: Fields) -> None:
        report = Executed.from_fields(fields)
        assert report.failed is None
        self.outcomes["refused" if report.refused else "executed"] += 1
        self._done += report.executed or ()
        if report.refused:
            assert not report.executed
            return
        assert report.manager is not None
        assert report.number is not None
        context, rules = self._contexts[report.manager, report.number]
        found = due(rules, Context(frozenset([report.trigger or ""]), context.conditions))
        own = [one for one in found.decisions if one.rule.label in self._labels[report.node]]
        assert report.clauses == tuple((one.rule.label, one.clause) for one in own)
        assert list(report.due) == [str(o) for one in own for o in one.obligations if not o.negated]
        assert report.executed == report.due
        if not self._faults.reorder:
            ended = self._ended.get((report.manager, report.number), float("inf"))
            # A report arrives up to half a second later.
            oldest = self.robot.clock.now() - 0.5 - TIMEOUT - self._faults.longest_delay
            assert ended >= oldest, "the context is too old"
