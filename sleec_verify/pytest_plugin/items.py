"""The pytest items of ruleset files and files of cases."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from pathlib import Path
from typing import Any

import pytest

from sleec_runtime import Sleec
from sleec_runtime.errors import SleecError
from sleec_runtime.language import load
from sleec_runtime.model import Rule, Ruleset, constructs
from sleec_verify.checks import checks_for, run_checks
from sleec_verify.conformance.cases.case import Case
from sleec_verify.conformance.cases.reader import read_cases
from sleec_verify.conformance.exhaustive import each_rule, tried
from sleec_verify.conformance.failure import situation_text
from sleec_verify.conformance.subject import Bench, Factory, whole_ruleset
from sleec_verify.pytest_plugin import settings
from sleec_verify.pytest_plugin.coverage import not_counted
from sleec_verify.pytest_plugin.item import CaseFailure, Item, check_names
from sleec_verify.pytest_plugin.timed_items import timed_case, timed_rules
from sleec_verify.report.escape import as_line
from sleec_verify.report.full import finding_lines
from sleec_verify.report.palette import PLAIN
from sleec_verify.results.finding import SEVERITIES, Finding, Unknown


class RulesetFile(pytest.File):
    """A ``*.sleec`` file: an item for each check and for each rule."""

    def collect(self) -> Iterator[pytest.Item]:
        try:
            ruleset = settings.reread(load(self.path), self.config)
            target = target_for(ruleset, self.path, self.config)
        except SleecError as error:
            raise self.CollectError(str(error)) from None
        for name in checks_for(ruleset):
            yield CheckItem.from_parent(self, name=f"check[{name}]", ruleset=ruleset, check=name)
        if any(constructs(ruleset)):
            yield from timed_rules(self, ruleset, target)
            return
        for rule in ruleset.rules:
            yield RuleItem.from_parent(self, name=f"rule[{rule.label}]", ruleset=ruleset, rule=rule, target=target)


class CheckItem(Item):
    """One check. Fails if it has findings of at least the severity ``sleec_fail_level``, or if it is inconclusive."""

    def __init__(self, *, ruleset: Ruleset, check: str, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.ruleset = ruleset
        self.check = check

    def runtest(self) -> None:
        (result,) = run_checks(self.ruleset, [self.check], settings.domain(self.config, self.ruleset))
        if isinstance(result.verdict, Unknown):
            raise CaseFailure(f"unknown: {result.verdict.why}")
        level = SEVERITIES.index(settings.fail_level(self.config))
        grave = [finding for finding in result.findings if SEVERITIES.index(finding.severity) <= level]
        if grave:
            raise CaseFailure(self._in_words(grave))
        if result.findings:
            self.add_report_section("call", "sleec", self._in_words(result.findings))

    def _in_words(self, findings: Any) -> str:
        found: list[Finding] = list(findings)
        lines = (line for finding in found for line in (*finding_lines(finding, self.ruleset.source, PLAIN), ""))
        return "\n".join(map(as_line, lines))


class RuleItem(Item):
    """One rule: in every context that it distinguishes, the target executes what the solver says is due. Without a
    target, an instance whose obligations only record their execution is used: the evaluator against the solver."""

    def __init__(self, *, ruleset: Ruleset, rule: Rule, target: Factory | None, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.ruleset = ruleset
        self.rule = rule
        self.target = target

    def line(self) -> int | None:
        return self.ruleset.source.place(self.rule.span).line - 1

    def runtest(self) -> None:
        with not_counted():
            for bench in self._benches():
                each_rule(bench, frozenset({self.rule.label}))

    def _benches(self) -> Iterator[Bench]:
        if self.target is not None:
            yield Bench(self.target, self.ruleset, settings.domain(self.config, self.ruleset))
            return
        asked = settings.domain(self.config, self.ruleset)
        domains = (asked,) if asked else self.rule.domains or self.ruleset.domains or (None,)
        for domain in domains:
            yield Bench(partial(stand_in, self.ruleset, domain), self.ruleset, domain)


class CasesFile(pytest.File):
    """A ``*.cases.toml`` file: an item for each case."""

    def collect(self) -> Iterator[pytest.Item]:
        try:
            ruleset, cases = read_cases(self.path)
            target = target_for(ruleset, Path(ruleset.source.path), self.config)
        except SleecError as error:
            raise self.CollectError(str(error)) from None
        for case in cases:
            if any(constructs(ruleset)):
                yield timed_case(self, ruleset, case, target)
                continue
            assert isinstance(case, Case), "scenarios are of rules with time"
            yield CaseItem.from_parent(self, name=case.name, ruleset=ruleset, case=case, target=target)


class CaseItem(Item):
    """One case: the solver's answer matches the case, and the target, if any, executes it."""

    def __init__(self, *, ruleset: Ruleset, case: Case, target: Factory | None, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.ruleset = ruleset
        self.case = case
        self.target = target

    def runtest(self) -> None:
        case = self.case
        domain = case.domain or settings.domain(self.config, self.ruleset)
        context = case.context()
        bench = Bench(self.target or partial(stand_in, self.ruleset, domain), self.ruleset, domain)
        expected = bench.oracle().expected(context)
        where = situation_text(context)
        if not expected.possible:
            raise CaseFailure(f"{where}: this situation is excluded by an ASSUME, so the rules say nothing about it")
        if expected.conflict != case.conflict:
            found = "the rules contradict each other" if expected.conflict else "the rules do not contradict each other"
            raise CaseFailure(f"{where}: {found}, but the case expects the opposite")
        check_names(where, "obligations", case.obligations, expected.due)
        if case.prohibitions is not None:
            check_names(where, "prohibitions", case.prohibitions, expected.prohibited)
        self._executed(bench)

    def _executed(self, bench: Bench) -> None:
        with bench.running() as running:
            change_domain = getattr(running.subject, "enter_domain", None)
            if self.target is not None and self.case.domain is not None and change_domain is not None:
                change_domain(self.case.domain)
            failure = tried(running, self.case.context())
            if failure is not None:
                raise failure


def stand_in(ruleset: Ruleset, domain: str | None = None) -> Sleec:
    """An instance for rules without a robot: each obligation only records its execution."""
    sleec = Sleec(ruleset, domain)
    sleec.implement(dict.fromkeys(ruleset.obligations, _nothing))
    return sleec


def _nothing(*arguments: object, **named: object) -> None:
    """Accepts all arguments of a trigger."""


def target_for(ruleset: Ruleset, path: Path, config: pytest.Config) -> Factory | None:
    """The target, if it belongs to this ruleset: that of ``--sleec-ruleset``, or otherwise the file from which it
    was loaded. Raises `TargetError`."""
    target = settings.target(config)
    if target is None:
        return None
    named = settings.ruleset_path(config)
    if named is None:
        named = Path(whole_ruleset(Bench(target).subject()).source.path)
    return target if named.resolve() == path.resolve() else None
