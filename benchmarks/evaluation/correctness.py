"""E1: what each system executes over DDS, compared with what the rules entail by Definition 1."""

from __future__ import annotations

import time
from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

from benchmarks.evaluation.deployment import Deployment
from benchmarks.evaluation.situations import GroundTruth, Situation, every_situation, packed, random_situations
from sleec_runtime.model import Ruleset

SETTLING = 0.1
"""Seconds that a change of context may take until it has reached every task."""
SILENCE = 0.1
"""Seconds to wait for actions that should not happen."""


class Verdict(NamedTuple):
    """How often a system executed exactly what the solver derives. `cases` names the kind of cases."""

    system: str
    cases: str
    situations: int
    triggers: int
    matches: int
    first_difference: str


def check(systems: Mapping[str, Deployment], ruleset: Ruleset, count: int) -> list[Verdict]:
    """Each trigger in `count` random situations, and in every context of every rule."""
    truth = GroundTruth(ruleset)
    triggers = [rule.trigger for rule in ruleset.rules]
    return [
        verdict
        for kind, situations in (
            ("random", random_situations(ruleset, count)),
            ("every context", packed(every_situation(ruleset))),
        )
        for verdict in _check(systems, kind, situations, triggers, truth)
    ]


def _check(
    systems: Mapping[str, Deployment], kind: str, situations: list[Situation], triggers: list[str], truth: GroundTruth
) -> Iterator[Verdict]:
    differences: dict[str, list[str]] = {name: [] for name in systems}
    for situation in situations:
        for deployment in systems.values():
            deployment.report(situation)
        time.sleep(SETTLING)
        expected = {trigger: truth.obligations(situation, trigger) for trigger in triggers}
        for name, deployment in systems.items():
            differences[name] += _differences(deployment, situation, expected)
        # What is executed in a domain without its rule would come late.
        time.sleep(SILENCE)
        for name, deployment in systems.items():
            late = deployment.await_actions(1, timeout=0)
            differences[name] += [f"{action.name} in {situation}, for no trigger" for action in late]
    count = len(situations) * len(triggers)
    for name, found in differences.items():
        yield Verdict(name, kind, len(situations), count, count - len(found), next(iter(found), ""))


def _differences(deployment: Deployment, situation: Situation, expected: Mapping[str, Sequence[str]]) -> Iterator[str]:
    """Triggers everything, and describes each difference."""
    for trigger, names in expected.items():
        deployment.trigger(trigger)
        actions = sorted(action.name for action in deployment.await_actions(len(names)))
        if actions != list(names):
            yield f"{trigger} in {situation}: {actions} instead of {names}"
