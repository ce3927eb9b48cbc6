"""The unmodified runtime passes on random rulesets with time, in random scenarios: with chains and without, and with
obligations that complete at their return, later, or never."""

from __future__ import annotations

import warnings
from random import Random

import pytest

from sleec_runtime import Sleec, obligation
from sleec_runtime.errors import NotEnforced
from sleec_runtime.model import Ruleset, Value
from sleec_verify.conformance import Bench
from sleec_verify.conformance.scenarios.judgement import Judge
from sleec_verify.conformance.scenarios.player import play
from sleec_verify.conformance.scenarios.scenario import Completion, Scenario, Step
from tests.support.timed_strategies import BOOLEANS, SCALE, timed_ruleset

SCENARIOS = 3


def scenario(random: Random, ruleset: Ruleset) -> Scenario:
    steps = []
    at = 0
    for _ in range(random.randint(1, 6)):
        values: dict[str, Value | None] = {}
        for name in BOOLEANS:
            if name in ruleset.conditions and random.random() < 0.5:
                values[name] = random.random() < 0.5
        if "risk" in ruleset.measures:
            values["risk"] = random.choice(SCALE)
        triggers = sorted(ruleset.triggers)
        steps.append(Step(at, tuple(random.sample(triggers, min(len(triggers), random.choice((1, 1, 1, 2))))), values))
        at += random.randint(1, 3)
    completions = tuple(
        Completion(name, since, random.choice([None, *range(since, since + 5)]))
        for name in sorted(ruleset.obligations)
        for since in range(at)
        if random.random() < 0.4
    )
    return Scenario("a random one", tuple(steps), at + 15, completions)


def faults(seed: int) -> int:
    """The number of triggers that were rejected in the scenarios of a seed; fails where the runtime breaks a rule."""
    random = Random(seed)
    ruleset = timed_ruleset(seed, relations=0)
    chains = random.random() < 0.6
    slow = {name for name in sorted(ruleset.obligations) if random.random() < 0.5}

    def make(clock) -> Sleec:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", NotEnforced)
            sleec = Sleec(ruleset, clock=clock, chains=chains, on_error=lambda failure: None)
        for name in sorted(ruleset.obligations):
            sleec.implement({name: obligation(name, completes=name not in slow)(lambda: None)})
        return sleec

    judge, bench = Judge(ruleset, chains), Bench(make)
    rejected = 0
    for _ in range(SCENARIOS):
        tried = scenario(random, ruleset)
        course = play(bench, tried)
        found = judge.fault(course)
        assert found is None, f"seed {seed}: {found}\n{ruleset.source.text}\n{tried}\n{course.happenings}"
        rejected += sum(one.kind == "rejected" for one in course.happenings)
    return rejected


@pytest.mark.slow
@pytest.mark.parametrize("block", range(4))
def test_the_runtime_passes(block: int) -> None:
    rejected = [faults(seed) for seed in range(block * 150, block * 150 + 150)]
    assert 0 < sum(map(bool, rejected)) < 100


@pytest.mark.long
def test_the_runtime_passes_on_many_rulesets() -> None:
    for seed in range(1_000_000, 1_010_000):
        faults(seed)
