"""Which rules a question about one rule depends on.

Rules for traces belong together if they share events (`traces.partition`). Other rules belong together if they have the
same trigger, or if a condition of one names the trigger of the other: only such rules are active together in every
situation of a trigger (`query.cone`). A conflict also depends on rules of other groups, which oblige something that
contradicts.
"""

from __future__ import annotations

from collections.abc import Collection, Hashable
from typing import NamedTuple

from sleec_runtime.model import Assume, literals
from sleec_verify.encoding.trace_scope import named_atoms
from sleec_verify.encoding.union_find import UnionFind
from sleec_verify.query.inconsistent_sets import opposite
from sleec_verify.query.names import names_in, names_of_constraint, obligations_in
from sleec_verify.query.ruleset_index import RulesetIndex
from sleec_verify.traces.index import trace_index_of
from sleec_verify.traces.partition import event_groups, partition_of


class Group(NamedTuple):
    """The labels of rules that belong together, in the order of the text, and whether they need traces."""

    labels: tuple[str, ...]
    over_time: bool


def groups_of(index: RulesetIndex) -> list[Group]:
    """Every rule of a ruleset in its group. Linear in the ruleset."""
    parts = partition_of(index)
    events = UnionFind() if parts.traces is None else event_groups(trace_index_of(index))
    triggers = UnionFind()
    if _ties_triggers(index):
        for rule in index.rules:
            triggers.join(index.rules[0].trigger, rule.trigger)
    for rule in index.rules:
        for name in named_atoms(rule):
            triggers.join(rule.trigger, name)
    found: dict[tuple[bool, Hashable], list[str]] = {}
    for rule in index.rules:
        over_time = parts.needs_traces(rule.label)
        root = (events if over_time else triggers).root(rule.trigger)
        found.setdefault((over_time, root), []).append(rule.label)
    return [Group(tuple(labels), over_time) for (over_time, _), labels in found.items()]


def _ties_triggers(index: RulesetIndex) -> bool:
    """Whether an assumption or constraint names a trigger. It can require a trigger in every situation."""
    return any(
        kind == "trigger"
        for one in index.ruleset.constraints
        for kind, _ in (names_in(one.formula) if isinstance(one, Assume) else names_of_constraint(one))
    )


def partners(index: RulesetIndex, labels: Collection[str]) -> set[str]:
    """The rules, other than these, that can contradict one of them in a situation: by an opposite literal, or by
    obligations that constraints connect."""
    changed = [rule for rule in index.rules if rule.label in labels]
    due = {literal for rule in changed for clause in rule.clauses() for literal in literals(clause)}
    against = {opposite(literal) for literal in due}
    bound = index.constraints_about({literal.name for literal in due})
    connected = {name for one in bound for name in obligations_in(one)}
    return {
        index.rules[place.rule].label
        for literal, places in index.by_obligation.items()
        if literal in against or literal.name in connected
        for place in places
    }.difference(labels)
