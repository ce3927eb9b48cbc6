"""The two parts of a ruleset: rules that questions about situations decide, and rules that need questions about traces.

Rules that share an event belong together, and so do rules whose events a relation mentions. A group needs traces if a
response of it has a window or triggers a rule, or if a relation between instants mentions it. The parts share no event,
so that what one requires changes no answer about the other.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterable
from dataclasses import replace
from typing import NamedTuple

from sleec_runtime.model import RELATIONS, Assume, Exclusive, MeasureRelation, Never, Rule, Statement
from sleec_verify.encoding.one_instant import at_every_instant
from sleec_verify.encoding.trace_scope import Untimed, has_chains, responses_of, speaks_of_traces
from sleec_verify.encoding.union_find import UnionFind
from sleec_verify.query.cone import Cones
from sleec_verify.traces.event_conditions import named_atoms
from sleec_verify.traces.index import Index
from sleec_verify.traces.relations import Relation, events_of


class Parts(NamedTuple):
    """`situations` are the rules without time, relations and chains. `traces` are the others."""

    situations: Cones
    traces: Index | None

    def of_traces(self, label: str) -> bool:
        """Whether the rule of a label is among those that need traces."""
        return self.traces is not None and label in self.traces.ruleset.by_label


def parts(cones: Cones) -> Parts:
    """The parts of a ruleset. Linear in its size."""
    ruleset = cones.ruleset
    if not speaks_of_traces(ruleset) and not (cones.chains and has_chains(ruleset)):
        return Parts(cones, None)
    index = cones.index
    union = UnionFind()
    for rule in ruleset.rules:
        for event in (*named_atoms(rule), *(response.name for response in responses_of(rule))):
            union.join(rule.trigger, event)
    for relation in index.relations:
        events = list(events_of(relation))
        for event in events:
            union.join(events[0], event)
    timed: set[Hashable] = set()
    for rule in ruleset.rules:
        leads_on = cones.chains and any(r.name in index.by_trigger for r in responses_of(rule))
        if leads_on or _is_timed(rule, cones.untimed):
            timed.add(union.root(rule.trigger))
    for relation in index.relations:
        if isinstance(relation, RELATIONS):
            timed.update(union.root(event) for event in events_of(relation))
    with_time = [rule for rule in ruleset.rules if union.root(rule.trigger) in timed]
    bound = [one for one in index.relations if _is_among(one, union, timed)]
    if not with_time:
        return Parts(without(cones, (), bound), None)
    return Parts(without(cones, with_time, bound), index.part(with_time, [*bound, *_about_measures(index.relations)]))


def without(cones: Cones, rules: Iterable[Rule], relations: Iterable[Relation]) -> Cones:
    """The ruleset without some rules and relations, for questions about situations."""
    labels = {rule.label for rule in rules}
    left_out = {id(relation) for relation in relations}
    kept: list[Statement] = []
    for statement in cones.ruleset.statements:
        if isinstance(statement, MeasureRelation):
            kept.append(Assume(at_every_instant(statement), span=statement.span))
        elif isinstance(statement, Rule):
            kept += () if statement.label in labels else (statement,)
        elif isinstance(statement, (Exclusive, Never, Assume)) and id(statement) not in left_out:
            kept.append(statement)
    measures = tuple(cones.ruleset.measures.values())
    ruleset = replace(cones.ruleset, statements=tuple(kept), inferred=measures)
    return Cones(ruleset, cones.recorder, cones.untimed, chains=False)


def _is_timed(rule: Rule, untimed: Untimed) -> bool:
    return untimed == "eventually" or any(response.timing is not None for response in responses_of(rule))


def _is_among(relation: Relation, union: UnionFind, timed: set[Hashable]) -> bool:
    return any(union.root(event) in timed for event in events_of(relation))


def _about_measures(relations: Iterable[Relation]) -> list[Relation]:
    return [relation for relation in relations if not any(events_of(relation))]
