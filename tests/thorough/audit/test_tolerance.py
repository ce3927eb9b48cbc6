"""A log that is late by at most the tolerance shows no obligation as missed that was executed in time."""

from __future__ import annotations

from dataclasses import replace
from random import Random

import pytest

from sleec_runtime.audit.auditor import Auditor
from sleec_runtime.audit.observation import Executed, Observation
from sleec_runtime.model import Clause, Obligation, literals
from tests.support.missions import audit, complete, declared, observations
from tests.support.random_traces import random_cases

TOLERANCE = 3


def missed(auditor: Auditor, mission: list[Observation]) -> set[tuple[str, int, int]]:
    """The rule, the time of the trigger, and the clause of each missed obligation without prohibitions in it."""
    found = set()
    for deviation in audit(auditor, mission):
        if deviation.kind in ("missed", "open") and deviation.triggered is not None:
            decision = deviation.triggered.decision
            assert decision is not None
            if not any(one.negated for own in decision.obligations for one in _inner(own)):
                found.add((deviation.triggered.rule, int(deviation.triggered.time), decision.clause))
    return found


def _inner(obligation: Obligation) -> list[Obligation]:
    """The obligation, and those of its alternatives."""
    return list(literals(Clause(None, (obligation,))))


@pytest.mark.parametrize("seed", range(3))
def test_delays_within_the_tolerance_cause_no_missed_obligation(seed: int) -> None:
    delayed = exact = 0
    for number, case in enumerate(random_cases(seed + 20, 200)):
        ruleset = declared(case.ruleset)
        chance = Random(number)
        for trace in case.traces:
            mission = list(observations(complete(trace, chance), Random(number)))
            late = [
                replace(one, time=one.time + chance.randint(0, TOLERANCE)) if isinstance(one, Executed) else one
                for one in mission
            ]
            late.sort(key=lambda one: one.time)
            in_time = missed(Auditor(ruleset, tolerance=0, untimed=case.untimed, chains=False), mission)
            with_delay = missed(Auditor(ruleset, tolerance=TOLERANCE, untimed=case.untimed, chains=False), late)
            assert with_delay <= in_time, (ruleset, mission)
            delayed += late != mission
            exact += bool(in_time)
    assert min(delayed, exact) > 50
