"""Findings about the instances of an ALWAYS statement, as findings about the statement.

The instances differ only in their triggers, so most findings are about all of them.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable

from sleec_runtime.model import Ruleset
from sleec_verify.results.finding import Finding

_OF_ALL = frozenset({"dead-rule", "dead-hedge", "redundant-rule", "redundant-hedge"})
"""What is superfluous for one trigger may be necessary for another. So these findings are about the statement only if
they are about every instance."""


def of_statements(findings: Iterable[Finding], ruleset: Ruleset) -> tuple[Finding, ...]:
    """The findings, with one instead of those that differ only in the instances of an ALWAYS statement: the one with
    the fewest triggers."""
    statement = {rule.label: rule.always for rule in ruleset.rules if rule.always is not None}
    if not statement:
        return tuple(findings)
    sizes = Counter(statement.values())  # and 0 for the rules of no statement
    groups: dict[tuple[object, ...], list[Finding]] = {}
    for finding in findings:
        rules = finding.rules[:1] if finding.check in _OF_ALL else finding.rules
        about = frozenset(statement.get(label, label) for label in rules)
        clauses = frozenset((statement.get(label, label), clause) for label, clause in finding.clauses)
        key = (finding.code, finding.span, about, clauses, finding.obligations, finding.domains)
        groups.setdefault(key, []).append(finding)
    return tuple(
        min(group, key=_triggers)
        for group in groups.values()
        if group[0].check not in _OF_ALL or len(group) >= sizes[statement.get(group[0].rules[0], "")]
    )


def _triggers(finding: Finding) -> int:
    return len(finding.witness.triggers) if finding.witness is not None else 0
