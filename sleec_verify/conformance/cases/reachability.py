"""Reachability: the clauses that some situation makes active, and the conditions that decide in some situation."""

from __future__ import annotations

from collections.abc import Iterator

from sleec_runtime.model import Atom, Comparison, Ruleset
from sleec_verify.conformance.cases.goals import conditions_of
from sleec_verify.conformance.cases.mcdc import deciding_vectors
from sleec_verify.query.question import Question
from sleec_verify.query.ruleset_index import RulesetIndex
from sleec_verify.results.finding import ClauseRef


def reachable_clauses(ruleset: Ruleset) -> frozenset[ClauseRef]:
    """The clauses that are active in some situation of some domain in which their rule applies. One question for each
    clause.

    Raises `Undecided` if the solver gave up.
    """
    found: set[ClauseRef] = set()
    for index in _index(ruleset):
        for position, rule in enumerate(index.rules):
            refs = [ClauseRef(rule.label, number) for number in range(len(index.clauses[position]))]
            if found.issuperset(refs):
                continue
            with Question(index) as question:
                found.update(ref for ref, guard in zip(refs, question.guards(position)) if question.ask(guard))
    return frozenset(found)


def deciding_conditions(ruleset: Ruleset) -> frozenset[tuple[str, Atom | Comparison]]:
    """The conditions, each with the label of its rule, that alone decide in some situation which clause of the rule is
    active (MC/DC).

    Raises `Undecided` if the solver gave up.
    """
    found: set[tuple[str, Atom | Comparison]] = set()
    for index in _index(ruleset):
        for position, rule in enumerate(index.rules):
            conditions = conditions_of(rule)
            never = deciding_vectors(index, position, conditions).undecided
            found.update((rule.label, one) for place, one in enumerate(conditions) if place not in never)
    return frozenset(found)


def _index(ruleset: Ruleset) -> Iterator[RulesetIndex]:
    """For each domain, the rules that are in force there together."""
    for domain in ruleset.domains or (None,):
        yield RulesetIndex(ruleset if domain is None else ruleset.in_domain(domain))
