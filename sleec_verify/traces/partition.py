"""The two parts of a ruleset: rules for questions about situations, and rules for questions about traces.

Rules that share an event belong together, and so do rules whose events a relation mentions. A group needs traces if a
response of it has a window, triggers a rule or is named by a condition, or if a relation between instants mentions it.
The parts share no event, so requirements of one part change no answer about the other.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Mapping
from dataclasses import replace
from types import MappingProxyType
from typing import NamedTuple

from sleec_runtime.model import RELATIONS, Assume, Exclusive, MeasureRelation, Never, Rule, Statement
from sleec_verify.encoding.relations import Relation, events_of, formula_at_one_instant
from sleec_verify.encoding.trace_scope import Untimed, has_chains, named_atoms, responses_of, speaks_of_traces
from sleec_verify.encoding.union_find import UnionFind
from sleec_verify.query.ruleset_index import InstantIndex, RulesetIndex, instant_index
from sleec_verify.traces.index import TraceIndex, trace_index_of


class Partition(NamedTuple):
    """`situations` are the rules without time, relations and chains. `traces` are the others."""

    situations: InstantIndex
    traces: TraceIndex | None

    def needs_traces(self, label: str) -> bool:
        """Whether the rule of a label is among those that need traces."""
        return self.traces is not None and label in self.traces.ruleset.by_label


def partition_of(index: RulesetIndex) -> Partition:
    """The parts of a ruleset. Linear in its size."""
    return index.once(_partition)


def _partition(index: RulesetIndex) -> Partition:
    ruleset = index.ruleset
    if not speaks_of_traces(ruleset) and not (index.chains and has_chains(ruleset)):
        return Partition(instant_index(index), None)
    whole = trace_index_of(index)
    union = event_groups(whole)
    timed: set[Hashable] = set()
    for rule in ruleset.rules:
        leads_on = index.chains and any(
            response.name in events for response in responses_of(rule) for events in (whole.by_trigger, whole.naming)
        )
        if leads_on or _is_timed(rule, index.untimed):
            timed.add(union.root(rule.trigger))
    for relation in whole.relations:
        if isinstance(relation, RELATIONS):
            timed.update(union.root(event) for event in events_of(relation))
    with_time = [rule for rule in ruleset.rules if union.root(rule.trigger) in timed]
    bound = [one for one in whole.relations if _is_among(one, union, timed)]
    about_measures = [relation for relation in whole.relations if not any(events_of(relation))]
    return Partition(
        instant_index(without(index, with_time, bound)),
        whole.part(with_time, [*bound, *about_measures]) if with_time else None,
    )


def event_groups(whole: TraceIndex) -> UnionFind:
    """The groups of events: the events of a rule belong together, and so do those of a relation."""
    union = UnionFind()
    for rule in whole.rules:
        for event in (*named_atoms(rule), *(response.name for response in responses_of(rule))):
            union.join(rule.trigger, event)
    for relation in whole.relations:
        events = list(events_of(relation))
        for event in events:
            union.join(events[0], event)
    return union


def without(
    index: RulesetIndex,
    rules: Iterable[Rule],
    relations: Iterable[Relation],
    replaced: Mapping[str, Rule] = MappingProxyType({}),
) -> RulesetIndex:
    """The ruleset without some rules and relations, for questions about situations. `replaced` has other rules for
    some labels."""
    labels = {rule.label for rule in rules}
    left_out = {id(relation) for relation in relations}
    kept: list[Statement] = []
    for statement in index.ruleset.statements:
        if isinstance(statement, MeasureRelation):
            kept.append(Assume(formula_at_one_instant(statement), span=statement.span))
        elif isinstance(statement, Rule):
            kept += () if statement.label in labels else (replaced.get(statement.label, statement),)
        elif isinstance(statement, (Exclusive, Never, Assume)) and id(statement) not in left_out:
            kept.append(statement)
    measures = tuple(index.ruleset.measures.values())
    ruleset = replace(index.ruleset, statements=tuple(kept), inferred=measures)
    return RulesetIndex(ruleset, index.recorder, index.untimed, chains=False)


def _is_timed(rule: Rule, untimed: Untimed) -> bool:
    return untimed == "eventually" or any(response.timing is not None for response in responses_of(rule))


def _is_among(relation: Relation, union: UnionFind, timed: set[Hashable]) -> bool:
    return any(union.root(event) in timed for event in events_of(relation))
