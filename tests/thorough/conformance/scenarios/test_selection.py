"""Scenarios of random rulesets: the evaluator confirms what they state and reach, and the runtime executes them."""

from __future__ import annotations

import random
import warnings
from functools import partial

import pytest

from sleec_runtime import Sleec, VirtualClock, obligation
from sleec_runtime.errors import NotEnforced
from sleec_runtime.evaluation.trace import Instant, Trace
from sleec_runtime.evaluation.trace_violations import violations
from sleec_runtime.language import parse
from sleec_runtime.model import Ruleset
from sleec_verify.conformance.cases.coverage import reached_clauses
from sleec_verify.conformance.cases.goals import CRITERIA, clause_name
from sleec_verify.conformance.scenarios.expectations import trace_of, unexpected
from sleec_verify.conformance.scenarios.player import play
from sleec_verify.conformance.scenarios.scenario import Scenario, Step
from sleec_verify.conformance.scenarios.selection import choose_scenarios
from sleec_verify.conformance.scenarios.trials import Trials
from sleec_verify.conformance.scenarios.window_coverage import reached_windows
from sleec_verify.conformance.subject import Bench
from tests.support.realistic_rules import LONG, SHORT, peoples_rules
from tests.support.timed_robot_sources import random_rules
from tests.support.timed_strategies import timed_ruleset

SEEDS = range(24)


def ruleset_of(seed: int) -> Ruleset:
    return parse(peoples_rules(seed, windows=LONG if seed % 2 else SHORT))


@pytest.mark.parametrize("seed", range(36))
def test_scenarios_are_lawful_and_reach_their_goals(seed: int) -> None:
    ruleset = ruleset_of(seed) if seed in SEEDS else parse(random_rules(random.Random(seed)))
    found = choose_scenarios(ruleset, sorted(CRITERIA)[seed % len(CRITERIA)])
    for one in found.scenarios:
        assert not list(unexpected(ruleset, one))
        clauses = {clause_name(ruleset.by_label[label], number) for label, number in reached_clauses(ruleset, [one])}
        windows = {str(window) for window in reached_windows(ruleset, [one])}
        for goal in one.reaches:
            clause, _, response = goal.partition(": ")
            if goal in every_clause(ruleset):
                assert goal in clauses
            elif response.endswith((" second", " missed")) and ", " not in response and "NOT" not in response:
                assert clause in clauses
                met, _, _ = response.partition(" met at")
                assert f"{clause}: {response}" in windows or f"{clause}: {met} met" in windows or "within" not in met


@pytest.mark.slow
@pytest.mark.parametrize("block", range(4))
def test_no_scenario_causes_what_only_the_robot_does(block: int) -> None:
    """These rules have no relations, so nothing but a rule requires an obligation."""
    for seed in range(block * 25, block * 25 + 25):
        for ruleset in (parse(random_rules(random.Random(seed))), timed_ruleset(seed, relations=0)):
            for one in choose_scenarios(ruleset, sorted(CRITERIA)[seed % len(CRITERIA)]).scenarios:
                for step in one.steps:
                    assert ruleset.triggers.issuperset(step.when), f"seed {seed}: {one}\n{ruleset.source.text}"


def every_clause(ruleset: Ruleset) -> set[str]:
    return {clause_name(rule, number) for rule in ruleset.rules for number, _ in enumerate(rule.clauses())}


@pytest.mark.parametrize("seed", SEEDS)
def test_no_lawful_trace_reaches_what_is_unreached(seed: int) -> None:
    """The clauses, by random traces."""
    ruleset = ruleset_of(seed)
    found = choose_scenarios(ruleset, "clause")
    unreached = {one.name for one in found.unreached if not one.why.startswith("unknown")} & every_clause(ruleset)
    if not unreached:
        return
    draw = random.Random(seed)
    events = sorted(ruleset.triggers | ruleset.obligations)
    for _ in range(2_000):
        steps = [
            Step(
                time,
                tuple(sorted(draw.sample(events, draw.randint(0, 4)))),
                {"m0": draw.random() < 0.5, "m1": draw.random() < 0.5, "s": draw.choice(("lo", "mid", "hi"))},
            )
            for time in sorted(draw.sample(range(8), draw.randint(1, 3)))
        ]
        one = Scenario("random", tuple(steps), 8)
        instants = tuple(Instant(at.time, at.events, at.conditions) for at in trace_of(one))
        if not violations(ruleset, Trace(instants)):
            reached = {clause_name(ruleset.by_label[label], n) for label, n in reached_clauses(ruleset, [one])}
            assert not reached & unreached


def test_the_runtime_executes_them() -> None:
    """All of it, unless a trigger is rejected, because its obligation is forbidden at that moment: in few scenarios.
    An obligation of several rules may be executed more than once."""
    played = rejecting = 0
    for ruleset in map(ruleset_of, SEEDS):
        for one in choose_scenarios(ruleset, "clause").scenarios:
            bench = Bench(partial(stand_in, ruleset, one), ruleset)
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", NotEnforced)
                assert Trials(bench).failure(one) is None
                course = play(bench, one)
            played += 1
            if any(happening.kind == "rejected" for happening in course.happenings):
                rejecting += 1
                continue
            executed = {(time, name) for time, name in course.occurrences()}
            assert executed >= {(instant.time, name) for instant in trace_of(one) for name in instant.events}
    assert played > 6 * rejecting


def stand_in(ruleset: Ruleset, scenario: Scenario, clock: VirtualClock) -> Sleec:
    sleec = Sleec(ruleset, clock=clock, chains=True)
    late = {one.name for one in scenario.completions if one.at is not None}
    sleec.implement({name: code(name, completes=name not in late) for name in ruleset.obligations})
    return sleec


def code(name: str, completes: bool) -> object:
    def nothing(*arguments: object) -> None:
        pass

    return nothing if completes else obligation(name, completes=False)(nothing)
