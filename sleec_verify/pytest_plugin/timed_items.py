"""The pytest items of rules with time: a rule, a scenario, and a case without steps."""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from dataclasses import replace
from functools import cached_property, partial
from typing import Any

import pytest

from sleec_runtime import Sleec, VirtualClock, obligation
from sleec_runtime.errors import NotEnforced
from sleec_runtime.model import Rule, Ruleset
from sleec_verify.conformance.cases.case import Case
from sleec_verify.conformance.cases.coverage import reached_clauses
from sleec_verify.conformance.failure import situation_text
from sleec_verify.conformance.scenarios.expectations import required_in, trace_of, unexpected
from sleec_verify.conformance.scenarios.nonconformance import ScenarioNonconformance
from sleec_verify.conformance.scenarios.scenario import Scenario, Step
from sleec_verify.conformance.scenarios.selection import Scenarios, choose_scenarios
from sleec_verify.conformance.scenarios.trials import Trials
from sleec_verify.conformance.subject import Bench, Factory, takes_clock
from sleec_verify.entailment.entailment import entail
from sleec_verify.pytest_plugin import settings
from sleec_verify.pytest_plugin.coverage import not_counted
from sleec_verify.pytest_plugin.item import CaseFailure, Item, check_names
from sleec_verify.report.entailment import undecided_text
from sleec_verify.wording.phrases import listed


def timed_rules(parent: pytest.File, ruleset: Ruleset, target: Factory | None) -> Iterator[pytest.Item]:
    """An item for each rule, which is tested by the scenarios that concern it."""
    trials = RulesetTrials(ruleset, target, settings.domain(parent.config, ruleset))
    for rule in ruleset.rules:
        yield TimedRuleItem.from_parent(parent, name=f"rule[{rule.label}]", rule=rule, trials=trials)


def timed_case(parent: pytest.File, ruleset: Ruleset, case: Case | Scenario, target: Factory | None) -> pytest.Item:
    """An item for a scenario, or for a case that names what is due in one situation."""
    trials = RulesetTrials(ruleset, target, settings.domain(parent.config, ruleset))
    kind = TimedCaseItem if isinstance(case, Case) else ScenarioItem
    return kind.from_parent(parent, name=case.name, case=case, trials=trials)


class RulesetTrials:
    """Scenarios of one ruleset on the target. Without a target, on an instance whose obligations only record their
    execution: the runtime against the solver."""

    def __init__(self, ruleset: Ruleset, target: Factory | None, domain: str | None) -> None:
        self.ruleset = ruleset
        self.domain = domain
        self._target = target
        self._failures: dict[int, ScenarioNonconformance | None] = {}

    @cached_property
    def selected(self) -> Scenarios:
        """The scenarios that `cases` selects."""
        return choose_scenarios(self.ruleset, "clause", self.domain)

    def part(self, domain: str | None) -> Ruleset:
        """The rules of a domain, by default of the domain under test."""
        where = domain or self.domain
        return self.ruleset if where is None else self.ruleset.in_domain(where)

    def failure(self, scenario: Scenario) -> ScenarioNonconformance | None:
        """What does not follow the rules in a scenario, which is run once."""
        if id(scenario) not in self._failures:
            domain = scenario.domain or self.domain
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", NotEnforced)
                bench = Bench(self._factory(scenario, domain), self.ruleset, domain)
                # The prohibitions of the last second end after it.
                longer = replace(scenario, end=scenario.end + 1)
                self._failures[id(scenario)] = Trials(bench).failure(longer)
        return self._failures[id(scenario)]

    def _factory(self, scenario: Scenario, domain: str | None) -> Factory:
        if self._target is None:
            return partial(_stand_in, self.ruleset, domain, scenario)
        if scenario.domain is None or not takes_clock(self._target):
            return self._target
        return partial(_in_domain, self._target, scenario.domain)


def _in_domain(make: Factory, domain: str, clock: VirtualClock) -> Any:
    subject = make(clock)
    change_domain = getattr(subject, "enter_domain", None)
    if change_domain is not None:
        change_domain(domain)
    return subject


def _stand_in(ruleset: Ruleset, domain: str | None, scenario: Scenario, clock: VirtualClock) -> Sleec:
    """An instance that completes obligations when the scenario says so."""
    sleec = Sleec(ruleset, domain, clock=clock, chains=True)
    late = {one.name for one in scenario.completions if one.at is not None}
    sleec.implement({name: _recording(name) if name in late else _nothing for name in ruleset.obligations})
    return sleec


def _recording(name: str) -> Any:
    return obligation(name, completes=False)(partial(_nothing))


def _nothing(*arguments: object, **named: object) -> None:
    """Accepts all arguments of a trigger."""


class TimedRuleItem(Item):
    """One rule: in every selected scenario that concerns it, the target follows it."""

    def __init__(self, *, rule: Rule, trials: RulesetTrials, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.rule = rule
        self.trials = trials

    def line(self) -> int | None:
        return self.trials.ruleset.source.place(self.rule.span).line - 1

    def runtest(self) -> None:
        label, chosen, ruleset = self.rule.label, self.trials.selected, self.trials.ruleset
        scenarios = [
            one for one in chosen.scenarios if any(rule == label for rule, _ in reached_clauses(ruleset, [one]))
        ]
        if not scenarios:
            whys = dict.fromkeys(one.why for one in chosen.unreached if one.name.startswith((f"{label} ", f"{label}:")))
            pytest.skip(f"no scenario triggers the rule: {listed(whys) if whys else 'it applies in no domain'}")
        with not_counted():
            for scenario in scenarios:
                failure = self.trials.failure(scenario)
                if failure is not None and failure.concerns(label):
                    raise failure


class ScenarioItem(Item):
    """One scenario: what it states is what the rules require, and the target executes it."""

    def __init__(self, *, case: Scenario, trials: RulesetTrials, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.case = case
        self.trials = trials

    def runtest(self) -> None:
        found = list(unexpected(self.trials.part(self.case.domain), self.case))
        if found:
            raise CaseFailure("\n".join(found))
        _executed(self.trials, self.case)


class TimedCaseItem(Item):
    """One case without steps: what it names is due in its situation, by the solver, and the target executes it."""

    def __init__(self, *, case: Case, trials: RulesetTrials, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.case = case
        self.trials = trials

    def runtest(self) -> None:
        case, context = self.case, self.case.context()
        part = self.trials.part(case.domain)
        where = situation_text(context)
        expected = entail(part, context)
        if expected.broken_assumptions:
            raise CaseFailure(f"{where}: the relations exclude this situation, so the rules say nothing about it")
        if expected.undecided is not None:
            raise CaseFailure(f"{where}: {undecided_text(expected.undecided)}")
        if expected.consistent == case.conflict:
            found = "do not contradict" if expected.consistent else "contradict"
            raise CaseFailure(f"{where}: the rules {found} each other, but the case expects the opposite")
        check_names(where, "obligations", case.obligations, expected.with_choices(case.obligations, negated=False))
        if case.prohibitions is not None:
            found_prohibitions = expected.with_choices(case.prohibitions, negated=True)
            check_names(where, "prohibitions", case.prohibitions, found_prohibitions)
        if expected.consistent:
            alone = Scenario(case.name, (Step(0, case.triggers, case.conditions),), 0, domain=case.domain)
            due = required_in(part, trace_of(alone))
            end = max((one.end for one in due if one.end is not None), default=0)
            _executed(self.trials, Scenario(case.name, alone.steps, end, domain=case.domain))


def _executed(trials: RulesetTrials, scenario: Scenario) -> None:
    failure = trials.failure(scenario)
    if failure is not None:
        raise failure
