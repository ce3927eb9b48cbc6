"""Other windows in random rulesets with a planted conflict over time."""

from __future__ import annotations

from random import Random

import pytest

from sleec_runtime.language import parse
from tests.support.realistic_rules import peoples_rules
from tests.support.repairs import found_repairs


def with_conflict(seed: int) -> str:
    random = Random(seed)
    second = random.choice(("E0", "E1"))
    soon, late = random.randint(0, 4), random.randint(1, 6)
    planted = f"P1 when E0 then X0 within {soon} seconds\nP2 when {second} then not X0 within {late} seconds\n"
    return peoples_rules(seed, 2, windows=("eventually", "3", "[1, 2]")).replace("rule_end", f"{planted}rule_end")


@pytest.mark.parametrize("start", range(0, 30, 10))
def test_other_windows_are_repairs(start: int) -> None:
    kinds = {
        repair.candidate.operator
        for seed in range(start, start + 10)
        for _, repair in found_repairs(parse(with_conflict(seed)), "SLEEC101")
    }
    assert "deadline-refinement" in kinds
