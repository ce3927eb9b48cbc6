"""What a monitor and global activation use of an instance: its current context and code, and its changes."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, TypeVar

from sleec_runtime.concurrency.critical_section import CriticalSection, exclusive
from sleec_runtime.dispatch.instance import Instance
from sleec_runtime.dispatch.layers import Layers
from sleec_runtime.dispatch.rule_index import RuleIndex
from sleec_runtime.dispatch.snapshot import Snapshot
from sleec_runtime.errors import SleecError
from sleec_runtime.model import Rule

if TYPE_CHECKING:
    from sleec_runtime.monitor.monitor import Monitor

T = TypeVar("T")

Listener = Callable[[Snapshot, Snapshot, "tuple[Rule, ...]"], None]
"""Gets each change: the context before, the context after, and the rules whose outcomes were computed again."""


class Host:
    """An instance with its current context and code, its listeners, and its monitor. `Sleec` extends it."""

    def __init__(self, snapshot: Snapshot, instance: Instance) -> None:
        self._section = CriticalSection()
        self._snapshot = snapshot
        self._instance = instance
        self._listeners: list[Listener] = []
        self._objections: list[Listener] = []
        self._monitor: Monitor | None = None

    @property
    def layers(self) -> Layers:
        """L: the layers by name, for ``@cop.around(sleec.layers["dress_assist.hc1"])``. Raises UnknownLayer."""
        return self._instance.layers

    @property
    def code(self) -> Instance:
        """The code that is bound to the rules."""
        return self._instance

    def listen(self, listener: Listener, objection: Listener | None = None) -> Callable[[], None]:
        """Calls `listener` after each change of context, before the next one. Returns a function that ends this.

        `objection` is called before each change. If it raises, nothing changes.
        """
        self._listeners.append(listener)
        if objection is not None:
            self._objections.append(objection)

        def end() -> None:
            self._listeners.remove(listener)
            if objection is not None:
                self._objections.remove(objection)

        return end

    @exclusive
    def hold(self, act: Callable[[Snapshot], T]) -> T:
        """Calls `act` with the current context, and returns its result. The context does not change meanwhile: changes
        wait, dispatches do not."""
        return act(self._snapshot)

    def attach(self, monitor: Monitor) -> None:
        """Lets `monitor` observe each dispatch; call it within `hold`. Raises SleecError if another monitor does."""
        if self._monitor is not None:
            raise SleecError("a monitor is already on", "stop() it first")
        self._monitor = monitor

    def detach(self, monitor: Monitor) -> None:
        """Undoes `attach`."""
        if self._monitor is monitor:
            self._monitor = None

    @property
    def activated_globally(self) -> bool:
        """Whether global activation is on. Nothing else objects to changes."""
        return bool(self._objections)

    def allow_calls(self) -> None:
        """Makes plain calls of bound methods do what a dispatch does. Raises Unbindable for a method that cannot."""
        self._instance.allow_calls(self._snapshot.index.ruleset.rules)

    def bound_objects(self) -> list[object]:
        """The objects whose methods are bound to rules."""
        return self._instance.objects()

    def implementing(self) -> list[object]:
        """What was given to `implement`: objects and modules, and the callables of obligations."""
        return self._instance.implementing()

    @property
    def takes_time(self) -> frozenset[str]:
        """The obligations whose callables do not complete them: `completed` does."""
        return self._instance.takes_time

    def _state(self) -> tuple[Snapshot, Instance]:
        return self._snapshot, self._instance

    def _watch_bound(self, instance: Instance, index: RuleIndex) -> None:
        if self._monitor is not None:
            self._monitor.watch(instance.objects(), index.whole.obligations)

    def _object(self, before: Snapshot, after: Snapshot, rules: tuple[Rule, ...]) -> None:
        for objection in self._objections:
            objection(before, after, rules)

    def _tell(self, before: Snapshot, after: Snapshot, rules: tuple[Rule, ...]) -> None:
        for listener in tuple(self._listeners):
            listener(before, after, rules)
