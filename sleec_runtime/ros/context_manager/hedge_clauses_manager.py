"""The Hedge Clauses Manager (paper, Section 4): it determines the active layers of each context."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterable
from typing import NamedTuple

from sleec_runtime.dispatch.snapshot import Snapshot
from sleec_runtime.facade.sleec import Sleec
from sleec_runtime.model import Rule
from sleec_runtime.ros.active_layers import ActiveLayers, LayerChange
from sleec_runtime.ros.context_manager.measure_ranges import measure_ranges, refuse_out_of_range
from sleec_runtime.ros.identity import snapshot_of
from sleec_runtime.ros.message import Conditions


class ContextChange(NamedTuple):
    """A change of context: the new context, and the conditions and layers that changed."""

    context: Snapshot
    conditions: Conditions
    layers: LayerChange


class HedgeClausesManager:
    """Keeps the context of the robot, and forwards each change of it, with the layers that it changes.

    It also forwards changes that other code makes to its `Sleec`, such as `Sensors` in the same process.
    """

    def __init__(self, sleec: Sleec, forward: Callable[[ContextChange], object]) -> None:
        self._sleec = sleec
        self._forward = forward
        self._ranges = measure_ranges(sleec.ruleset)
        self._update = threading.local()
        self._layers = ActiveLayers(snapshot_of(sleec))
        sleec.listen(self._changed)

    def update(self, conditions: Conditions) -> None:
        """Raises UnknownCondition, WrongType and OutOfRange. Nothing changes then."""
        refuse_out_of_range(self._ranges, conditions, self._sleec.ruleset)
        self._update.names = conditions.keys()
        try:
            self._sleec.update(conditions)
        finally:
            del self._update.names

    def enter_domain(self, domain: str | None) -> None:
        """Puts the rules of a domain in force. Raises UnknownDomain."""
        if domain != self._sleec.domain:
            self._sleec.enter_domain(domain)

    def active_layers(self) -> tuple[str, ...]:
        """The active layers. To be called within `Sleec.hold`."""
        return self._layers.names()

    def _changed(self, before: Snapshot, after: Snapshot, rules: tuple[Rule, ...]) -> None:
        if before.index is not after.index:
            self._ranges = measure_ranges(after.index.ruleset)
        names: Iterable[str] = getattr(self._update, "names", after.index.vocabulary)
        old, new = before.conditions, after.conditions
        changed = {name: new.get(name) for name in names if old.get(name) != new.get(name)}
        self._forward(ContextChange(after, changed, self._layers.changed(before, after, rules)))
