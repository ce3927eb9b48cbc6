"""The rules and relations on which an answer about traces depends, in words."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from sleec_runtime.model import Assume, Exclusive, Never, Ruleset
from sleec_verify.wording.phrases import quoted
from sleec_verify.wording.sentence import sentence

if TYPE_CHECKING:
    from sleec_verify.encoding.relations import Relation
    from sleec_verify.traces.index import TraceIndex


def in_words(index: TraceIndex, matter: Iterable[str]) -> list[str]:
    """Labels of rules and keys of relations, in words: rules first, each kind in the order of the text."""
    relations = [index.relation_by_key[key] for key in matter if key in index.relation_by_key]
    relations.sort(key=lambda relation: relation.span)
    rules = map(quoted, rules_in(index, matter))
    # A relation whose duration a measure gives has a key for each value.
    return list(dict.fromkeys([*rules, *(relation_in_words(index.ruleset, relation) for relation in relations)]))


def rules_in(index: TraceIndex, matter: Iterable[str]) -> tuple[str, ...]:
    """The labels of the rules in `matter`, in the order of the text."""
    wanted = set(matter)
    return tuple(rule.label for rule in index.rules if rule.label in wanted)


def relation_in_words(ruleset: Ruleset, relation: Relation) -> str:
    """``the EXCLUSIVE in line 1``."""
    line = ruleset.source.place(relation.span).line
    return sentence("the {relation} in line {line}", relation=kind_of(relation), line=line)


def kind_of(relation: Relation) -> str:
    """The keyword of a constraint; "relation" for any other statement."""
    kinds = {Exclusive: "EXCLUSIVE", Never: "NEVER", Assume: "ASSUME"}
    return kinds.get(type(relation)) or sentence("relation")
