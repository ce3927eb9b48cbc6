"""Random traces of a given ruleset, with a value for every condition and measure."""

from __future__ import annotations

from random import Random

from sleec_runtime.evaluation.trace import Instant, Trace
from sleec_runtime.model import Ruleset, Value


def trace_of(random: Random, ruleset: Ruleset) -> Trace:
    events = sorted({*ruleset.triggers, *(o.name for r in ruleset.rules for c in r.clauses() for o in c.obligations)})
    instants: list[Instant] = []
    time = 0
    for _ in range(random.randint(1, 4)):
        values: dict[str, Value] = {}
        for measure in ruleset.measures.values():
            values[measure.name] = random.choice(measure.values) if measure.kind == "scale" else random.randint(0, 4)
        for name in ruleset.conditions:
            values[name] = random.random() < 0.5
        chosen = frozenset(e for e in events if random.random() < 0.45)
        instants.append(Instant(time, chosen, values))
        time += random.randint(1, 3)
    return Trace(tuple(instants))
