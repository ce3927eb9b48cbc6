"""An audit that begins late finds no breach that the whole mission does not have."""

from __future__ import annotations

from collections import Counter
from random import Random

import pytest

from sleec_runtime.audit.auditor import Auditor
from sleec_runtime.audit.deviation import BREACHES, Deviation
from sleec_runtime.evaluation.trace_violations import violations
from tests.support.missions import audit, complete, declared, observations
from tests.support.random_traces import random_cases


def breaches(found: list[Deviation]) -> set[tuple[object, ...]]:
    """The breaches and what was not required, with what identifies them."""
    return {
        (one.kind, one.time, one.rule, one.obligation, one.statement, one.name)
        for one in found
        if one.kind in BREACHES or one.kind == "unrequired"
    }


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(4))
def test_each_breach_is_one_of_the_whole_mission(seed: int) -> None:
    counts: Counter[bool] = Counter()
    for number, case in enumerate(random_cases(seed, 150)):
        ruleset = declared(case.ruleset)
        for trace in case.traces:
            chance = Random(f"{seed} {number}")
            whole_trace = complete(trace, chance)
            mission = list(observations(whole_trace if number % 2 else trace, chance))
            if not mission:
                continue
            begin = chance.choice(mission).time
            tolerance = chance.choice((0, 1))
            whole = audit(Auditor(ruleset, tolerance=tolerance, untimed=case.untimed), mission)
            auditor = Auditor(ruleset, tolerance=tolerance, untimed=case.untimed)
            auditor.begin_late(begin)
            late = audit(auditor, [one for one in mission if one.time > begin])
            # An invariant of conditions is reported when they change, which a late audit sees at another time.
            broken = {(statement, time) for statement, time in violations(ruleset, whole_trace, case.untimed)}
            new = {one for one in breaches(late) - breaches(whole) if (one[4], one[1]) not in broken}
            assert not new, (case, trace, begin)
            counts[bool(breaches(late))] += 1
    assert min(counts.values()) > 50, counts
