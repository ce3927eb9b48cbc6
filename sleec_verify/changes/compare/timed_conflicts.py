"""Conflicts of rules with time that only one side has (docs/times.md).

`check` finds the conflicts of each component of the rules. Only components that differ between the sides are asked.
Two conflicts are the same if they have the same rules and the same clauses of these.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterator
from dataclasses import replace
from typing import Union

from sleec_runtime.model import Rule
from sleec_verify.changes.compare.comparison import SIDES, Comparison, SideName, other
from sleec_verify.changes.compare.result import TimedConflictChange, Undecidable
from sleec_verify.checks.conflict import components_over_time, conflicts_over_time
from sleec_verify.checks.untimed_conflicts import Enough
from sleec_verify.encoding.budget import Undecided
from sleec_verify.encoding.trace_scope import responses_of, speaks_of_traces
from sleec_verify.query.ruleset_index import RulesetIndex
from sleec_verify.replay.situations import replay_finding
from sleec_verify.results.finding import Finding
from sleec_verify.results.phrases import listed, quoted
from sleec_verify.traces.event_conditions import named_events
from sleec_verify.traces.index import TraceIndex

_Pairs = frozenset[tuple[str, Hashable]]
"""The rules of a conflict by their new labels, each with a clause."""


def timed_conflict_changes(comparison: Comparison) -> Iterator[Union[TimedConflictChange, Undecidable, str]]:
    """The conflicts over time that one side has and the other side does not have. Also yields the limits of the list
    of conflicts, in words.

    Complete: rules in conflict are in one component, and equal components have the same conflicts.
    """
    stated = {which: comparison.sides[which].stated for which in SIDES}
    if not any(speaks_of_traces(ruleset) for ruleset in stated.values()):
        return
    found: dict[SideName, dict[_Pairs, Finding]] = {}
    open_rules: dict[SideName, set[str]] = {}
    indices = {which: RulesetIndex(ruleset, untimed=comparison.untimed) for which, ruleset in stated.items()}
    parts = {which: {_content(one): one for one in components_over_time(index)} for which, index in indices.items()}
    names = _new_names(comparison)
    for which, index in indices.items():
        found[which], open_rules[which] = {}, set()
        for content, component in parts[which].items():
            if content in parts[other(which)]:
                continue
            labels = [rule.label for rule in component.rules]
            try:
                for finding in conflicts_over_time(index, component):
                    if not replay_finding(index, finding):
                        raise Undecided("the replay rejected a conflict; this is a bug in sleec-verify")
                    found[which][_pairs(comparison, which, finding, names)] = finding
            except Enough as error:
                yield str(error)
            except Undecided as error:
                open_rules[which].update(names.get(label, label) if which == "old" else label for label in labels)
                yield Undecidable(f"conflicts of {listed(map(quoted, labels))}", str(error))
    for which in SIDES:
        for pairs, finding in found[which].items():
            known = pairs in found[other(which)]
            if not known and open_rules[other(which)].isdisjoint(label for label, _ in pairs):
                yield TimedConflictChange("added" if which == "new" else "removed", finding)


def _content(component: TraceIndex) -> Hashable:
    """What the conflicts of a component depend on, without the labels of its rules."""
    rules = frozenset(replace(rule, label="", labelled=True, domains=None) for rule in component.rules)
    events = {
        event
        for rule in component.rules
        for event in (rule.trigger, *named_events(rule), *(response.name for response in responses_of(rule)))
    }
    agents = component.root.agents
    roles = frozenset((event, agents.get(event)) for event in events)
    ruleset = component.ruleset
    measures = frozenset(ruleset.measures.items())
    return rules, len(component.rules), frozenset(component.relations), roles, measures, ruleset.reading


def _new_names(comparison: Comparison) -> dict[str, str]:
    """The new labels of the old rules that both sides have."""
    changed = (pair for pair, _ in comparison.changed)
    pairs = (*comparison.aligned.same, *changed)
    return {old.label: new.label for old, new in pairs if old is not None and new is not None}


def _pairs(comparison: Comparison, which: SideName, finding: Finding, names: dict[str, str]) -> _Pairs:
    """The rules of a conflict with their clauses, by the labels and numbers of the new side."""
    clauses = {(rule, number) for rule, number in finding.clauses}
    deciding = {rule for rule, _ in clauses}
    clauses |= {(rule, -1) for rule in finding.rules if rule not in deciding}
    if which == "new":
        return frozenset(clauses)
    old, new = (comparison.sides[side].stated.by_label for side in SIDES)
    return frozenset(
        (names[label], _new_number(old[label], new[names[label]], number)) if label in names else (f"old {label}", 0)
        for label, number in clauses
    )


def _new_number(old: Rule, new: Rule, number: int) -> Hashable:
    """The number of a clause in the new version of its rule: the same if no clause is added or removed."""
    before, after = list(old.clauses()), list(new.clauses())
    if number < 0 or len(before) == len(after):
        return number
    clause = (before[number].condition, before[number].obligations)
    alike = [place for place, one in enumerate(after) if (one.condition, one.obligations) == clause]
    return alike[0] if alike else clause
