"""The checks of one text after the other.

A change of some rules asks the questions about their groups again, and looks for conflicts with the changed rules. The
other findings are those of the text before, at their new places. The results are those of `run_checks`, because each
finding depends only on the rules of its group and, for a conflict, on the rules that it names. Everything is checked
again if other statements change, or if a verdict is unknown or a list incomplete.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from dataclasses import replace
from time import perf_counter
from typing import NamedTuple

from sleec_runtime.model import Rule, Ruleset, Span, Statement
from sleec_verify.checks import COSTLY, Checking, checks_for
from sleec_verify.checks.always import of_statements
from sleec_verify.checks.assumptions import ASSUMPTIONS
from sleec_verify.checks.claims import CONCERN, PURPOSE
from sleec_verify.checks.conflict import CONFLICT
from sleec_verify.checks.incremental.groups import Group, groups_of, partners
from sleec_verify.checks.incremental.relocation import Relocation
from sleec_verify.checks.untimed_conflicts import MOST, MOST_PER_RULE
from sleec_verify.checks.vacuous import VACUOUS_CONFLICT
from sleec_verify.encoding.budget import for_file
from sleec_verify.query.ruleset_index import RulesetIndex
from sleec_verify.results.finding import CheckResult, Finding, Proved, Refuted, Unknown

_ABOUT_RULES = frozenset(COSTLY) - {ASSUMPTIONS.name, CONCERN.name, PURPOSE.name}
"""The checks that ask a solver about rules: about a group of rules, and for conflicts about all that contradict."""


class _Whole(Exception):
    """Everything must be checked again."""


class _Known(NamedTuple):
    """A checked text: its rules as separate statements, their groups, and the findings of each check about them."""

    ruleset: Ruleset
    groups: frozenset[Group]
    findings: dict[str, tuple[Finding, ...]]


class IncrementalChecks:
    """The checks of texts that follow each other. Not for several threads at the same time."""

    def __init__(self) -> None:
        self._known: _Known | None = None

    @property
    def is_prepared(self) -> bool:
        """Whether a text is known, so that a small change of it is checked fast."""
        return self._known is not None

    def results(self, ruleset: Ruleset, interrupt: Callable[[], None] | None = None) -> tuple[CheckResult, ...]:
        """The same results as those of `run_checks`, apart from the seconds. `interrupt` is called again and again; its
        exception ends the checks, and the text before stays known."""
        names = checks_for(ruleset)
        checking = Checking(ruleset)
        separate = _separate(ruleset)
        index = checking.whole if separate is ruleset else RulesetIndex(separate)
        groups = frozenset(groups_of(index))
        about_rules = [name for name in names if name in _ABOUT_RULES]
        with for_file(len(ruleset.source.text), interrupt):
            of_text = [name for name in names if name not in _ABOUT_RULES]
            results = {one.name: one for one in checking.results(of_text)}
            try:
                found: Sequence[CheckResult] = _Update(self._known, index, groups, about_rules).results()
            except _Whole:
                found = Checking(index.ruleset).results(about_rules)
        is_complete = not any(isinstance(one.verdict, Unknown) or one.reason is not None for one in found)
        findings = {one.name: one.findings for one in found}
        self._known = _Known(index.ruleset, groups, findings) if is_complete else None
        results.update((one.name, _of_statements(one, ruleset)) for one in found)
        return tuple(results[name] for name in names)


def _separate(ruleset: Ruleset) -> Ruleset:
    """The ruleset with each instance of an ALWAYS statement as a rule of its own."""
    if all(rule.always is None for rule in ruleset.rules):
        return ruleset
    statements = (replace(one, always=None) if isinstance(one, Rule) else one for one in ruleset.statements)
    return replace(ruleset, statements=tuple(statements))


def _of_statements(result: CheckResult, ruleset: Ruleset) -> CheckResult:
    findings = of_statements(result.findings, ruleset)
    if isinstance(result.verdict, Unknown):
        return replace(result, verdict=replace(result.verdict, findings=findings))
    return replace(result, verdict=Refuted(findings) if findings else Proved())


class _Update:
    """The results of a text that differs from a known one in some rules. Raises `_Whole` if that is not so."""

    def __init__(
        self,
        known: _Known | None,
        index: RulesetIndex,
        groups: frozenset[Group],
        names: Sequence[str],
    ) -> None:
        if known is None:
            raise _Whole
        self._index = index
        self._old, self._new = known.ruleset, index.ruleset
        self._names = names
        self._findings = known.findings
        if list(known.findings) != names or not _differ_in_rules_only(self._old, self._new):
            raise _Whole
        self._changed = _changed(self._old, self._new)
        self._over_time = {label for group in groups if group.over_time for label in group.labels}
        self._touched = {
            label
            for group in groups
            if group not in known.groups or not self._changed.isdisjoint(group.labels)
            for label in group.labels
        }
        was_over_time = {label for group in known.groups if group.over_time for label in group.labels}
        self._conflicting = self._changed | (self._touched & (self._over_time | was_over_time))
        self._relocation = Relocation(_moves(self._old, self._new, self._changed))

    def results(self) -> list[CheckResult]:
        started = perf_counter()
        by_group = [name for name in self._names if name != CONFLICT.name]
        rivals = self._conflicting | partners(self._index, self._conflicting)
        fresh = self._asked(by_group, self._touched) | self._asked([CONFLICT.name], rivals)
        results = []
        for name in self._names:
            again = self._conflicting if name == CONFLICT.name else self._touched
            merged = self._merged(name, fresh[name], again)
            if name == CONFLICT.name and len(merged) >= MOST + MOST_PER_RULE * len(self._new.rules):
                raise _Whole
            results.append(CheckResult(name, Refuted(merged) if merged else Proved(), perf_counter() - started))
        return results

    def _asked(self, names: Sequence[str], labels: Collection[str]) -> dict[str, tuple[Finding, ...]]:
        """The findings of checks on the rules with these labels, and all other statements."""
        if not labels:
            return dict.fromkeys(names, ())
        statements = (one for one in self._new.statements if not isinstance(one, Rule) or one.label in labels)
        part = replace(self._new, statements=tuple(statements))
        results = Checking(part, domains=self._new.domains).results(names)
        if any(isinstance(result.verdict, Unknown) or result.reason is not None for result in results):
            raise _Whole
        return {result.name: result.findings for result in results}

    def _merged(self, name: str, fresh: Sequence[Finding], again: Collection[str]) -> tuple[Finding, ...]:
        """The findings of the text before that still hold, and the new ones about the rules `again`."""
        every = name == CONFLICT.name
        known = self._new.by_label

        def is_about(finding: Finding) -> bool:
            return not set(finding.rules if every else finding.rules[:1]).isdisjoint(again)

        kept = [
            self._relocation.finding(finding)
            for finding in self._findings[name]
            if not is_about(finding) and known.keys() >= set(finding.rules)
        ]
        kept += (finding for finding in fresh if is_about(finding))
        return tuple(sorted(kept, key=self._order(name)))

    def _order(self, name: str) -> Callable[[Finding], tuple[object, ...]]:
        """The order in which a check lists its findings: by place, then domain by domain as it makes them."""
        places = {rule.label: place for place, rule in enumerate(self._new.rules)}
        domains = {domain: place for place, domain in enumerate((None, *self._new.domains))}

        def key(finding: Finding) -> tuple[object, ...]:
            label = next(iter(finding.rules), None)
            if label is None:
                return (finding.span, 0, len(places), ())
            domain = next(iter(finding.domains), None)
            group = 0
            order: tuple[tuple[int, int], ...] = ((places[label], 0),)
            if name == VACUOUS_CONFLICT.name:
                group = self._first_place(self._new.by_label[label].trigger, domain)
            elif name == CONFLICT.name:
                # Those of rules over time are all from the same checks, and in their order.
                is_instant = label not in self._over_time
                cause = tuple((places[rule], number) for rule, number in finding.clauses)
                order = cause if is_instant else ()
            return (finding.span, domains[domain], group, order)

        return key

    def _first_place(self, trigger: str, domain: str | None) -> int:
        positions = self._index.by_trigger[trigger]
        return next(one for one in positions if self._new.rules[one].applies_in(domain))


def _differ_in_rules_only(old: Ruleset, new: Ruleset) -> bool:
    """Whether two texts differ only in rules, and the other statements have the same lines and words."""
    if (old.reading, old.syntax, old.dialect, old.domains) != (new.reading, new.syntax, new.dialect, new.domains):
        return False
    one, other = _other_statements(old), _other_statements(new)
    if one != other or any(old.measures[name] != new.measures[name] for name in old.measures.keys() & new.measures):
        return False
    return all(
        _words(old, before.span) == _words(new, after.span)
        and old.source.place(before.span) == new.source.place(after.span)
        for before, after in zip(one, other)
    )


def _other_statements(ruleset: Ruleset) -> list[Statement]:
    return [one for one in ruleset.statements if not isinstance(one, Rule)]


def _words(ruleset: Ruleset, span: Span) -> str:
    return ruleset.source.text[span.start : span.end]


def _changed(old: Ruleset, new: Ruleset) -> set[str]:
    """The labels of the rules that are new or changed. Raises `_Whole` if others have another order."""
    same = [
        rule.label
        for rule in new.rules
        if (before := old.by_label.get(rule.label)) is not None
        and before == rule
        and _words(old, before.span) == _words(new, rule.span)
    ]
    known = set(same)
    if same != [rule.label for rule in old.rules if rule.label in known]:
        raise _Whole
    return {rule.label for rule in new.rules} - known


def _moves(old: Ruleset, new: Ruleset, changed: Collection[str]) -> list[tuple[Span, Span]]:
    """The old and the new places of the statements that did not change."""
    pairs = [(old.by_label[rule.label].span, rule.span) for rule in new.rules if rule.label not in changed]
    pairs += ((one.span, other.span) for one, other in zip(_other_statements(old), _other_statements(new)))
    return pairs
