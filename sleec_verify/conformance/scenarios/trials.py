"""The parts of the conformance test that run scenarios: those of each rule, selected ones, and random ones."""

from __future__ import annotations

import logging
from collections.abc import Iterator
from contextlib import contextmanager

from sleec_runtime.errors import SleecError
from sleec_verify.conformance.scenarios.border_scenarios import scenarios_of_each_rule
from sleec_verify.conformance.scenarios.judgement import Judge
from sleec_verify.conformance.scenarios.nonconformance import ScenarioNonconformance
from sleec_verify.conformance.scenarios.player import play
from sleec_verify.conformance.scenarios.scenario import Scenario
from sleec_verify.conformance.subject import Bench, takes_clock


class NeedsClock(SleecError):
    """A factory without a parameter for the clock of the test, although the rules have time."""


class Trials:
    """Runs scenarios on subjects of `bench`, and judges them."""

    def __init__(self, bench: Bench) -> None:
        self._bench = bench
        if not takes_clock(bench.make):
            raise NeedsClock(
                "the rules have time, and the factory takes no clock",
                "let it take the clock of the test, and use it: "
                "`def make_sleec(clock): sleec = sleec_runtime.load(…, clock=clock)`",
            )
        whole, domain = bench.rules()
        self.ruleset = whole if domain is None else whole.in_domain(domain)
        self.domain = domain
        self.whole = whole
        self._judge = Judge(self.ruleset, bench.chains())
        self._obligations = whole.obligations

    def check(self, scenario: Scenario) -> None:
        """Raises `Nonconformance` if the subject does not follow the rules in a scenario."""
        failure = self._failure(scenario)
        if failure is not None:
            raise failure

    def failure(self, scenario: Scenario) -> ScenarioNonconformance | None:
        """The same as a value, without broken relations: a robot that completes obligations at other times than a
        scenario states may break relations with what the scenario does."""
        return self._failure(scenario, relations=False)

    def _failure(self, scenario: Scenario, relations: bool = True) -> ScenarioNonconformance | None:
        with _without_log():
            course = play(self._bench, scenario, self._obligations)
        faults = (one for one in self._judge.faults(course) if relations or one.kind != "relation")
        fault = min(faults, key=lambda one: one.at, default=None)
        if fault is None:
            return None
        return ScenarioNonconformance(scenario, course, fault, self._judge.requirements(course))


@contextmanager
def _without_log() -> Iterator[None]:
    """Keeps the missed deadlines of scenarios out of the log of the runtime."""
    log = logging.getLogger("sleec_runtime")
    nothing = logging.Filter("nothing of it")
    log.addFilter(nothing)
    try:
        yield
    finally:
        log.removeFilter(nothing)


def each_rule_in_time(bench: Bench) -> int:
    """Triggers each rule in each context that it distinguishes, with further events at the borders of its windows.
    Returns the number of scenarios."""
    trials = Trials(bench)
    count = 0
    for scenario in scenarios_of_each_rule(trials.ruleset):
        trials.check(scenario)
        count += 1
    return count


def selected(bench: Bench) -> int:
    """Runs the scenarios that `cases` selects. Returns their number."""
    from sleec_verify.conformance.scenarios.selection import choose_scenarios

    trials = Trials(bench)
    found = choose_scenarios(trials.whole, "mcdc", trials.domain).scenarios
    for scenario in found:
        failure = trials.failure(scenario)
        if failure is not None:
            raise failure
    return len(found)
