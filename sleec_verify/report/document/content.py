"""The content of a report: the results of the checks, decision tables, and a comparison with another version."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple, Union

from sleec_runtime.model import Assume, Constraint, Exclusive, Never
from sleec_verify.decision_tables.readings import reading_table
from sleec_verify.decision_tables.table import DecisionTable, decision_table
from sleec_verify.encoding.budget import Undecided
from sleec_verify.query.prime_implicates import inconsistent_sets_of
from sleec_verify.query.ruleset_index import RulesetIndex

if TYPE_CHECKING:
    from sleec_runtime.model import Rule, Ruleset
    from sleec_verify.encoding.scope import Scope
    from sleec_verify.query.inconsistent_sets import InconsistentSets
    from sleec_verify.report.difference_report import RulesetDifference
    from sleec_verify.report.outcome import CheckedRuleset


class TriggerTable(NamedTuple):
    """The table of all rules of a trigger; of those that apply in `domains`, if the rules of the trigger differ by
    domain."""

    domains: tuple[str, ...]
    table: DecisionTable


class Base(NamedTuple):
    """Another version of the rules, by its name, and the comparison with it."""

    name: str
    compared: RulesetDifference


class Content(NamedTuple):
    """What a report says about one ruleset. `ruleset` has the rules of the domain that was asked for.

    `certificate` are the lines about a certificate that was verified.

    `rule_tables` and `reading_tables` are by label. A rule that means the same in both readings has no reading table.
    """

    outcome: CheckedRuleset
    ruleset: Ruleset
    scope: Scope
    rule_tables: dict[str, DecisionTable]
    trigger_tables: tuple[TriggerTable, ...]
    reading_tables: dict[str, DecisionTable]
    base: Base | None = None
    certificate: tuple[str, ...] = ()


def content(
    outcome: CheckedRuleset,
    scope: Scope,
    base: Base | None = None,
    certificate: tuple[str, ...] = (),
) -> Content:
    """The content of the report on a ruleset. The size of every table is limited."""
    only: Domains = None if scope.domain is None else (scope.domain,)
    ruleset = outcome.ruleset if scope.domain is None else outcome.ruleset.in_domain(scope.domain)
    parts = _Parts(ruleset, outcome.untimed == "eventually")
    parted = {rule.label: reading_table(parts.common(only or rule.domains), rule) for rule in ruleset.rules}
    return Content(
        outcome,
        ruleset,
        scope,
        {rule.label: parts.table(only or rule.domains, [rule]) for rule in ruleset.rules},
        tuple(_trigger_tables(ruleset, parts, only)),
        {label: table for label, table in parted.items() if table is not None and (table.total or table.why)},
        base,
        certificate,
    )


Domains = Union[tuple[str, ...], None]
"""Domains in which something applies; None: everywhere."""


class _Parts:
    """The rules of a ruleset with the constraints that apply in all of some domains, each made once."""

    def __init__(self, ruleset: Ruleset, is_due_later: bool) -> None:
        """`is_due_later`: what has no window is due at some time, so no two responses contradict each other at once."""
        self._ruleset = ruleset
        self._is_due_later = is_due_later
        self._common: dict[Domains, Ruleset] = {}
        self._inconsistent: dict[Domains, InconsistentSets | None] = {}

    def common(self, domains: Domains) -> Ruleset:
        """The ruleset without the constraints that do not apply in all `domains`."""
        if domains not in self._common:
            self._common[domains] = replace(
                self._ruleset,
                statements=tuple(
                    one
                    for one in self._ruleset.statements
                    if not isinstance(one, (Assume, Exclusive, Never)) or _applies(one, domains)
                ),
            )
        return self._common[domains]

    def table(self, domains: Domains, rules: Sequence[Rule]) -> DecisionTable:
        """The table of rules in domains, with their contradictions."""
        if domains not in self._inconsistent:
            self._inconsistent[domains] = self._inconsistent_in(domains)
        return decision_table(self.common(domains), rules, self._inconsistent[domains])

    def _inconsistent_in(self, domains: Domains) -> InconsistentSets | None:
        if self._is_due_later:
            return None
        # If the constraints are too entangled, the verdict on contradictions is unknown, too.
        with suppress(Undecided):
            return inconsistent_sets_of(RulesetIndex(self.common(domains)))
        return None


def _applies(constraint: Constraint, domains: Domains) -> bool:
    return constraint.domains is None or (domains is not None and set(domains) <= set(constraint.domains))


def _trigger_tables(ruleset: Ruleset, parts: _Parts, only: Domains) -> Iterator[TriggerTable]:
    """The tables of the triggers with several rules; in the domain `only`, if it is asked for."""
    by_trigger: dict[str, list[Rule]] = {}
    for rule in ruleset.rules:
        by_trigger.setdefault(rule.trigger, []).append(rule)
    for rules in by_trigger.values():
        if len(rules) > 1:
            for domains, there in [(only, rules)] if only else _in_each_domain(ruleset, rules):
                if len(there) > 1:
                    yield TriggerTable(domains or (), parts.table(domains, there))


def _in_each_domain(ruleset: Ruleset, rules: Sequence[Rule]) -> Iterator[tuple[Domains, Sequence[Rule]]]:
    """Those of the rules that apply together, with the domains; domains with the same rules and constraints once."""
    if len({one.domains for one in (*rules, *ruleset.constraints)}) == 1:
        yield rules[0].domains, rules
        return
    together: dict[tuple[tuple[Rule, ...], tuple[Constraint, ...]], list[str]] = {}
    for domain in ruleset.domains:
        there = tuple(rule for rule in rules if rule.applies_in(domain))
        constraints = tuple(one for one in ruleset.constraints if one.domains is None or domain in one.domains)
        together.setdefault((there, constraints), []).append(domain)
    for (there, _), domains in together.items():
        yield tuple(domains), there
