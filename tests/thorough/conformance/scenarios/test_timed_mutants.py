"""The test of rules with time finds planted bugs, for the right reason: and correct robots pass."""

from __future__ import annotations

import pytest

from sleec_verify.conformance import Nonconformance, check_conformance
from sleec_verify.conformance.scenarios.nonconformance import ScenarioNonconformance
from tests.support.timed_mutants import conditions, deadlines
from tests.support.timed_mutants.conditions import on_runtime
from tests.support.timed_mutants.registry import MUTANTS
from tests.support.timed_mutants.robot import DOMAIN, RULES, Robot

MODULES = (conditions, deadlines)


@pytest.mark.parametrize("make", [Robot, on_runtime], ids=["by hand", "the runtime"])
def test_a_correct_robot_passes(make) -> None:
    check_conformance(make, RULES, domain=DOMAIN, examples=150)


@pytest.mark.parametrize("name", sorted(MUTANTS))
def test_a_mutant_is_caught(name: str) -> None:
    mutant = MUTANTS[name]
    with pytest.raises(Nonconformance) as caught:
        check_conformance(mutant.make, RULES, domain=DOMAIN, examples=400)
    failure = caught.value
    assert isinstance(failure, ScenarioNonconformance)
    assert failure.fault.kind in mutant.kinds, failure
    assert set(failure.fault.names) <= mutant.names, failure
    assert {active.rule for active in failure.expected.active} <= mutant.rules, failure


def test_there_are_enough_of_them() -> None:
    assert len(MUTANTS) >= 30
    assert all(mutant.make.__doc__ for mutant in MUTANTS.values())
