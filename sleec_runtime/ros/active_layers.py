"""The knowledge base of active layers (paper, Section 4)."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

from sleec_runtime.dispatch.snapshot import Snapshot
from sleec_runtime.evaluation.hedge_chain import Decision
from sleec_runtime.model import Rule


class LayerChange(NamedTuple):
    """The layers that a change of context activates and deactivates, in rule order."""

    activate: tuple[str, ...]
    deactivate: tuple[str, ...]


class ActiveLayers:
    """The active layer of each rule in force: the layer that Algorithm 1 yields if the trigger of the rule occurs."""

    def __init__(self, snapshot: Snapshot) -> None:
        self._layers = _layers(snapshot, snapshot.index.ruleset.rules)

    def names(self) -> tuple[str, ...]:
        """The active layers, in rule order."""
        return tuple(layer for layer in self._layers.values() if layer is not None)

    def changed(self, before: Snapshot, after: Snapshot, rules: Iterable[Rule]) -> LayerChange:
        """Follows a change of context; the parameters are those of a listener of `Sleec`. O(rules)."""
        old = self._layers
        if before.index is after.index:
            new = _layers(after, rules)
            old = {label: old[label] for label in new}
            self._layers.update(new)
        else:
            new = self._layers = _layers(after, after.index.ruleset.rules)
        gone, come = set(old.values()) - set(new.values()), set(new.values()) - set(old.values())
        return LayerChange(
            tuple(layer for layer in new.values() if layer in come and layer is not None),
            tuple(layer for layer in old.values() if layer in gone and layer is not None),
        )


def _layers(snapshot: Snapshot, rules: Iterable[Rule]) -> dict[str, str | None]:
    outcomes = {rule.label: snapshot.outcome(rule) for rule in rules}
    return {label: found.layer if isinstance(found, Decision) else None for label, found in outcomes.items()}
