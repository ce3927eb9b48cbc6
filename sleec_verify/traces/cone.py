"""The cone of influence of a question about traces: the rules and relations that can affect it.

An event that the question does not lead to need not occur, so its rules demand nothing. Relations matter in three
cases: they share an event, condition or measure with the question, directly or through other relations; they can
require an event without a cause; or they are false if everything that a trace does not mention is false.
"""

from __future__ import annotations

from collections.abc import Iterable

from sleec_runtime.model import Rule
from sleec_verify.encoding.relations import Relation
from sleec_verify.traces.index import TraceIndex
from sleec_verify.traces.relations import Name, holds_in_empty_context, may_require, names_of_relation


def cone(index: TraceIndex, events: Iterable[str], names: Iterable[Name]) -> TraceIndex:
    """The part of a ruleset that can affect a question about these events and names. Linear in the size of that
    part, and of the relations."""
    ahead: list[Name] = [("event", event) for event in events]
    ahead += names
    rules: dict[str, Rule] = {}
    relations: dict[str, Relation] = {}

    def include(key: str, relation: Relation) -> None:
        if key not in relations:
            relations[key] = relation
            ahead.extend(names_of_relation(relation))

    for key, relation in index.relation_by_key.items():
        if may_require(relation) or not holds_in_empty_context(relation):
            include(key, relation)
    seen: set[Name] = set()
    while ahead:
        name = ahead.pop()
        if name in seen:
            continue
        seen.add(name)
        for key, relation in index.relations_of_name.get(name, ()):
            include(key, relation)
        for rule in index.by_trigger.get(name[1], ()) if name[0] == "event" else ():
            if rule.label not in rules:
                rules[rule.label] = rule
                ahead += index.names_ahead(rule)
    return index.part(rules.values(), relations.values())


def surroundings(index: TraceIndex) -> TraceIndex:
    """The part of the whole ruleset to which the events of this part can lead. A history must satisfy it, too."""
    return index.once(_surroundings)


def _surroundings(index: TraceIndex) -> TraceIndex:
    return index if index.whole is None else cone(surroundings(index.whole), index.by_trigger, ())
