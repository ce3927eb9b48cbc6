"""The COP Layer Manager (paper, Section 4): it activates the layers in the process of a task."""

from __future__ import annotations

from collections.abc import Callable

from sleec_runtime.dispatch.snapshot import Snapshot
from sleec_runtime.facade.sleec import Sleec
from sleec_runtime.model import Rule
from sleec_runtime.ros.active_layers import ActiveLayers
from sleec_runtime.ros.identity import snapshot_of
from sleec_runtime.ros.messages import LayersUpdate

_KEPT = 1_000
"""The number of the last contexts whose numbers are known."""


class CopLayerManager:
    """Applies updates to the context of its `Sleec`, which selects the layers, and keeps which layers are active.

    It reports a change of context by other code to `on_foreign_change`. Layers are not enough to decide by: guards and
    constraints also read conditions. So an update carries both, and is applied to the context.
    """

    def __init__(self, sleec: Sleec, on_foreign_change: Callable[[], object]) -> None:
        self._sleec = sleec
        self._on_foreign_change = on_foreign_change
        start = snapshot_of(sleec)
        self._active = ActiveLayers(start)
        self._change = start.number
        self._activated: set[str] = set()
        self._deactivated: set[str] = set()
        self._numbers: dict[int, int] = {}
        self._applies = False
        sleec.listen(self._changed)

    def active_layers(self) -> tuple[str, ...]:
        """The knowledge base: the active layer of each rule in force, as if its trigger occurred, in rule order."""
        return self._active.names()

    def apply(self, update: LayersUpdate) -> bool:
        """Changes the context as the update says. Returns whether this changes the layers that the update names.

        Raises as `Sleec.update` and `Sleec.enter_domain`. Then a part of the update may be applied.
        """
        changes = dict(update.conditions)
        if update.full:
            changes.update({name: None for name in self._sleec.conditions if name not in changes})
        self._activated, self._deactivated = set(), set()
        # Before the change, because a trigger may see it before this call returns.
        self._numbers[self._change + 1] = update.number
        self._applies = True
        try:
            if update.domain != self._sleec.domain:
                self._sleec.enter_domain(update.domain)
                self._numbers[self._change + 1] = update.number
            self._sleec.update(changes)
        finally:
            self._applies = False
        self._numbers[self._change] = update.number
        if update.full:
            return set(self._active.names()) == set(update.activate)
        return self._activated == set(update.activate) and self._deactivated == set(update.deactivate)

    def number_of(self, change: int) -> int | None:
        """The number of the update that made this change of the `Sleec` (see `Done.change`)."""
        return self._numbers.get(change)

    def _changed(self, before: Snapshot, after: Snapshot, rules: tuple[Rule, ...]) -> None:
        layers = self._active.changed(before, after, rules)
        self._change = after.number
        self._numbers.pop(after.number - _KEPT, None)
        self._activated.update(layers.activate)
        self._deactivated.update(layers.deactivate)
        if not self._applies:
            self._on_foreign_change()
