"""The ready test finds planted bugs: every mutant is caught, and the correct robots pass."""

from __future__ import annotations

import pytest

from sleec_runtime.language import parse
from sleec_verify.conformance import Nonconformance, check_conformance
from tests.support.mutants import code, dispatching, meanwhile, rules
from tests.support.mutants.robot import DOMAIN, MUTANTS, RULES, coded, instance

RULESET = parse(RULES)
MODULES = (code, dispatching, meanwhile, rules)


@pytest.mark.parametrize("make", [instance, coded], ids=["instance", "coded"])
def test_the_correct_robot_passes(make) -> None:
    check_conformance(make, RULESET, domain=DOMAIN)


# They differ from the rules in few situations only, so the search for one is long.
LATE = {"inner_trigger_unheard", "never_forgets"}


@pytest.mark.parametrize(
    "name", [pytest.param(name, marks=pytest.mark.slow) if name in LATE else name for name in sorted(MUTANTS)]
)
def test_a_mutant_is_caught(name: str) -> None:
    with pytest.raises(Nonconformance) as caught:
        check_conformance(MUTANTS[name], RULESET, domain=DOMAIN)
    report = str(caught.value)
    assert "situation:" in report
    assert "executed:" in report
    assert "required:" in report or "requires:" in report


def test_there_are_enough_of_them() -> None:
    assert len(MUTANTS) >= 25
    assert all(make.__doc__ for make in MUTANTS.values())
