"""An audit of the beginning of a mission finds no breach that the whole mission does not have."""

from __future__ import annotations

from collections import Counter
from random import Random

import pytest

from sleec_runtime.audit.auditor import Auditor
from sleec_runtime.audit.deviation import BREACHES, Deviation
from tests.support.missions import audit, complete, declared, observations
from tests.support.random_traces import random_cases


def breaches(found: list[Deviation]) -> set[tuple[object, ...]]:
    """The breaches, with what identifies them."""
    return {
        (one.kind, one.time, one.rule, one.obligation, one.statement, one.triggered and one.triggered.time)
        for one in found
        if one.kind in BREACHES
    }


@pytest.mark.parametrize("seed", range(6))
def test_each_breach_is_one_of_the_whole_mission(seed: int) -> None:
    counts: Counter[bool] = Counter()
    for number, case in enumerate(random_cases(seed, 100)):
        ruleset = declared(case.ruleset)
        for trace in case.traces:
            chance = Random(f"{seed} {number}")
            mission = list(observations(complete(trace, chance) if number % 2 else trace, chance))
            tolerance = chance.choice((0, 1, 2))
            whole = breaches(audit(Auditor(ruleset, tolerance=tolerance, untimed=case.untimed), mission))
            ends = [n for n in range(1, len(mission)) if mission[n - 1].time < mission[n].time]
            for end in ends:
                auditor = Auditor(ruleset, tolerance=tolerance, untimed=case.untimed)
                found = breaches(audit(auditor, mission[:end], end=None))
                assert found <= whole, (ruleset, mission[:end], mission[end:], tolerance)
                counts[bool(found)] += 1
    assert min(counts.values()) > 50, counts
