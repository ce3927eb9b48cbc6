"""Random values for the conditions and measures of a ruleset, near the constants that its rules compare."""

from __future__ import annotations

from collections.abc import Mapping
from random import Random

from sleec_runtime.model import Measure, Value


def random_changes(vocabulary: Mapping[str, Measure | None], random: Random, most: int = 3) -> dict[str, Value | None]:
    """A change of up to `most` conditions and measures; None for a value that is no longer known."""
    names = random.sample(sorted(vocabulary), random.randint(0, min(most, len(vocabulary))))
    return {name: _value(vocabulary[name], random) for name in names}


def _value(measure: Measure | None, random: Random) -> Value | None:
    if random.random() < 0.1:
        return None
    if measure is None:
        return random.random() < 0.5
    if measure.kind == "scale":
        return random.choice(measure.values)
    return random.choice([0, 2, 3, 4, 17, 18, 19, 20, 21])
