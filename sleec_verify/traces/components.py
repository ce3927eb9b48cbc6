"""Components: the parts of a ruleset that no conflict connects.

Two rules are joined if one requires an event that the other forbids or is triggered by, if a condition of one names an
event of the other, or if a relation mentions events of both. A minimal set of rules in conflict is in one component,
because the requirements of other components can be met at the same time.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from sleec_runtime.model import RELATIONS, Clause, MeasureRelation, Obligation, Rule, literals, names_of
from sleec_verify.encoding.relations import Relation, events_of, formulas_of_relation
from sleec_verify.encoding.solver import Undecided
from sleec_verify.encoding.union_find import UnionFind
from sleec_verify.query.ruleset_index import InstantIndex, RulesetIndex, instant_index
from sleec_verify.traces.event_conditions import is_of_state
from sleec_verify.traces.index import TraceIndex
from sleec_verify.traces.partition import Partition, without
from sleec_verify.traces.relations import names_of_rule
from sleec_verify.traces.trivial_responses import cannot_be_met, contested_obligations


def components(index: TraceIndex) -> list[TraceIndex]:
    """The components with more than one side to an event or with relations, in the order of the text."""
    index = index.stated
    union = UnionFind()
    contested = {rule.label: list(_contested(index, rule)) for rule in index.ruleset.rules}
    obliging: dict[str, list[str]] = {}
    about: dict[str, list[str]] = {}
    for rule in index.ruleset.rules:
        for event in dict.fromkeys([rule.trigger, *(o.name for o in contested[rule.label])]):
            about.setdefault(event, []).append(rule.label)
        for response in contested[rule.label]:
            if not response.negated:
                obliging.setdefault(response.name, []).append(rule.label)
    for rule in index.ruleset.rules:
        for response in contested[rule.label]:
            others = [other.label for other in index.by_trigger.get(response.name, ())]
            for label in (*others, *(obliging.get(response.name, ()) if response.negated else ())):
                union.join(rule.label, label)
    for event, naming in index.naming.items():
        for rule in naming:
            about.setdefault(event, []).append(rule.label)
            for having in (index.by_trigger, index.obliging, index.forbidding):
                for other in having.get(event, ()):
                    union.join(rule.label, other.label)
    for key, relation in index.relation_by_key.items():
        for event in events_of(relation):
            for label in about.get(event, ()):
                union.join(label, key)
        for formula in formulas_of_relation(relation):
            for name in names_of(formula):
                union.join(("measure", name), key)
    rules: dict[object, list[Rule]] = {}
    for rule in index.ruleset.rules:
        rules.setdefault(union.root(rule.label), []).append(rule)
    relations: dict[object, list[Relation]] = {}
    for key, relation in index.relation_by_key.items():
        relations.setdefault(union.root(key), []).append(relation)
    return [
        index.part(group, [r for root in _roots(union, root, group) for r in relations.get(root, ())])
        for root, group in rules.items()
        if root in relations
        or _has_sides([(rule, contested[rule.label]) for rule in group])
        or any(cannot_be_met(index, rule) for rule in group)
    ]


def _roots(union: UnionFind, root: object, rules: list[Rule]) -> list[object]:
    """The groups of relations that bind rules: through events, or through the measures that the rules read."""
    measures = (name for rule in rules for name in names_of_rule(rule) if name[0] == "measure")
    return list(dict.fromkeys([root, *map(union.root, measures)]))


def _contested(index: TraceIndex, rule: Rule) -> Iterator[Obligation]:
    """The responses at any depth that can be part of a conflict."""
    for clause in rule.clauses():
        try:
            obligations = contested_obligations(index, clause)
        except Undecided:
            obligations = clause.obligations
        yield from literals(replace(clause, obligations=obligations))


def _has_sides(rules: list[tuple[Rule, list[Obligation]]]) -> bool:
    """Whether something can prevent a response: a prohibition, or its own consequences."""
    required = {response.name for _, responses in rules for response in responses if not response.negated}
    triggers = {rule.trigger for rule, _ in rules}
    forbidden = {response.name for _, responses in rules for response in responses if response.negated}
    return bool(required & forbidden or required & triggers or forbidden & triggers)


def at_one_instant(index: RulesetIndex, parts: Partition) -> InstantIndex:
    """The rules whose conflicts need one instant only: those without time, and those of components that do not need
    traces. The latter have only the responses that can be part of a conflict."""
    assert parts.traces is not None, "otherwise no rule needs traces"
    instant = {}
    for component in components(parts.traces):
        if not needs_traces(component):
            for rule in component.rules:
                instant[rule.label] = _contested_part(component, parts.traces.ruleset.by_label[rule.label])
    others = [rule for rule in parts.traces.rules if rule.label not in instant]
    return instant_index(without(index, others, (), instant))


def _contested_part(index: TraceIndex, rule: Rule) -> Rule:
    """The rule without the responses that can always be met."""

    def of(clause: Clause) -> Clause:
        return replace(clause, obligations=contested_obligations(index, clause), hedges=tuple(map(of, clause.hedges)))

    return replace(rule, default=of(rule.default), hedges=tuple(map(of, rule.hedges)))


def needs_traces(component: TraceIndex) -> bool:
    """Whether a conflict of a component can need more than one instant, a chain, or a relation between events."""
    for relation in component.relations:
        if isinstance(relation, RELATIONS) and not isinstance(relation, MeasureRelation) and not is_of_state(relation):
            return True
    for rule in component.rules:
        for response in _contested(component, rule):
            if response.timing is not None or component.untimed == "eventually":
                return True
            if response.name in component.by_trigger or response.name in component.naming:
                return True
    return False
