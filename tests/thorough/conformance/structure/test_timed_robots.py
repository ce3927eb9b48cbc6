"""Robots for random rules with time: what `conform` accepts violates no rule when it runs on a virtual clock."""

from __future__ import annotations

from random import Random

import pytest

from sleec_runtime.language import parse
from tests.support.structure import kinds
from tests.support.timed_robot_sources import fails, mistake_in, random_rules, robot_source

SEEDS = range(60)


@pytest.mark.parametrize("seed", SEEDS)
def test_a_correct_robot_is_accepted_and_violates_nothing(seed: int) -> None:
    random = Random(seed)
    ruleset = parse(random_rules(random))
    source = robot_source(ruleset, random)
    assert kinds(ruleset, robot=source) == [], source
    assert not fails(ruleset, source, random), source


@pytest.mark.parametrize("seed", SEEDS)
def test_a_robot_that_is_accepted_violates_nothing(seed: int) -> None:
    random = Random(seed)
    ruleset = parse(random_rules(random))
    source = mistake_in(robot_source(ruleset, random), random)
    if not kinds(ruleset, robot=source):
        assert not fails(ruleset, source, random), source


def test_runs_find_mistakes() -> None:
    """The two tests above are not empty: many mistakes violate a rule or raise."""
    found = 0
    for seed in SEEDS:
        random = Random(seed)
        ruleset = parse(random_rules(random))
        found += fails(ruleset, mistake_in(robot_source(ruleset, random), random), random)
    assert found >= 15
