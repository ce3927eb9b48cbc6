"""The layers of rules: one for each hedge clause (paper, Section 3.2).

`layers`, `layered_methods` and `variants` are the boundary to ContextPy3. No other module uses its internal interfaces.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import contextpy3

from sleec_runtime.errors import UnknownLayer
from sleec_runtime.model import Ruleset


class RuleLayer(contextpy3.Layer):  # type: ignore[misc]
    """ℓ(R)i, the layer of a hedge clause (paper, Section 3.2). An instance keeps one object for each name."""

    def __init__(self, name: str) -> None:
        super().__init__(name)
        self.name = name


class Layers(Mapping[str, RuleLayer]):
    """The layers by name: ``layers["dress_assist.hc1"]``. An unknown name raises UnknownLayer."""

    def __init__(self) -> None:
        self._layers: dict[str, RuleLayer] = {}

    def admit(self, ruleset: Ruleset) -> None:
        """Adds the layers of `ruleset`. A layer whose name exists stays the same object."""
        names = (rule.layer(number) for rule in ruleset.rules for number, _ in enumerate(rule.clauses()))
        added = {name: RuleLayer(name) for name in names if name is not None and name not in self._layers}
        # A new dictionary, so that other threads can iterate over the old one.
        self._layers = {**self._layers, **added}

    def of(self, name: str | None) -> RuleLayer | None:
        """The layer of that name; None, which is ε, for None."""
        return None if name is None else self[name]

    def __getitem__(self, name: str) -> RuleLayer:
        try:
            return self._layers[name]
        except (KeyError, TypeError):
            raise UnknownLayer(name, self._layers) from None

    def __contains__(self, name: object) -> bool:
        return name in self._layers

    def __iter__(self) -> Iterator[str]:
        return iter(self._layers)

    def __len__(self) -> int:
        return len(self._layers)
