"""Contexts: the situations in which rules are decided."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from sleec_runtime.model.value import Value


@dataclass(frozen=True)
class Context:
    """A situation χ ⊆ T ∪ C (paper, Section 3.2).

    By Definition 1, a name that is not in `triggers` or `conditions` is false. A comparison with a measure without a
    value is false too.
    """

    triggers: frozenset[str] = frozenset()
    conditions: Mapping[str, Value] = field(default_factory=dict)
