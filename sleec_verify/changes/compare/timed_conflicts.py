"""Conflicts of rules with time that only one side has (docs/times.md).

`check` finds the conflicts of each component of the rules. Only components that differ between the sides are asked.
Two conflicts are the same if they have the same rules and the same clauses of these.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterator
from dataclasses import replace

from sleec_runtime.model import Rule
from sleec_verify.changes.compare.comparison import SIDES, Comparison, SideName, other
from sleec_verify.changes.compare.result import ConflictChange, TimedConflictChange, Undecidable
from sleec_verify.checks.conflict import components_over_time, conflicts_over_time
from sleec_verify.checks.untimed_conflicts import Enough
from sleec_verify.encoding.budget import Undecided
from sleec_verify.encoding.trace_scope import responses_of, speaks_of_traces
from sleec_verify.query.ruleset_index import RulesetIndex
from sleec_verify.replay.situations import replay_finding
from sleec_verify.results.finding import Finding
from sleec_verify.traces.event_conditions import named_events
from sleec_verify.traces.index import TraceIndex
from sleec_verify.wording.phrases import listed, quoted
from sleec_verify.wording.sentence import sentence

_Pairs = frozenset[tuple[str, Hashable]]
"""The rules of a conflict by their new labels, each with a clause."""


class TimedConflicts:
    """The conflicts over time of both sides, among the rules that the change can affect.

    Complete: rules in conflict are in one component, and equal components have the same conflicts. `limits` are
    limits of the list of conflicts, in words.
    """

    def __init__(self, comparison: Comparison) -> None:
        self.limits: list[str] = []
        self.undecided: list[Undecidable] = []
        self._comparison = comparison
        self._names = _new_names(comparison)
        self._found: dict[SideName, dict[_Pairs, Finding]] = {which: {} for which in SIDES}
        self._open: dict[SideName, set[str]] = {which: set() for which in SIDES}
        """The rules whose conflicts are undecided on a side, by their new labels."""
        self._decided: dict[SideName, set[str]] = {which: set() for which in SIDES}
        """The rules whose conflicts are known on a side."""
        stated = {which: comparison.sides[which].stated for which in SIDES}
        if any(speaks_of_traces(ruleset) for ruleset in stated.values()):
            indices = {which: RulesetIndex(stated[which], untimed=comparison.untimed) for which in SIDES}
            parts = {which: {_content(one): one for one in components_over_time(indices[which])} for which in SIDES}
            for which in SIDES:
                for content, component in parts[which].items():
                    if content not in parts[other(which)]:
                        self._ask(which, indices[which], component)

    def _ask(self, which: SideName, index: RulesetIndex, component: TraceIndex) -> None:
        labels = [rule.label for rule in component.rules]
        try:
            for finding in conflicts_over_time(index, component):
                if not replay_finding(index, finding):
                    raise Undecided(sentence("the replay rejected a conflict; this is a bug in sleec-verify"))
                self._found[which][_pairs(self._comparison, which, finding, self._names)] = finding
        except Enough as error:
            self.limits.append(str(error))
        except Undecided as error:
            self._open[which].update(self._names.get(label, label) if which == "old" else label for label in labels)
            self.undecided.append(
                Undecidable(sentence("conflicts of {rules}", rules=listed(map(quoted, labels))), error.message)
            )
        else:
            self._decided[which].update(labels)

    def changes(self) -> Iterator[TimedConflictChange]:
        """The conflicts that one side has and the other side does not have."""
        for which in SIDES:
            for pairs, finding in self._found[which].items():
                known = pairs in self._found[other(which)]
                if not known and self._open[other(which)].isdisjoint(label for label, _ in pairs):
                    yield TimedConflictChange("added" if which == "new" else "removed", finding)

    def denies(self, conflict: ConflictChange) -> bool:
        """Whether rules that contradict each other at one instant are not in conflict: a rule may forbid an input that
        another rule requires, too."""
        which: SideName = "new" if conflict.way == "added" else "old"
        rules = set(conflict.rules)
        if not rules or not rules <= self._decided[which]:
            return False
        return not any(rules.issuperset(finding.rules) for finding in self._found[which].values())


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
