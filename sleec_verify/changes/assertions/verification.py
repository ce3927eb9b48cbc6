"""Checks assertions about rules."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from sleec_runtime.model import (
    Assume,
    Atom,
    Formula,
    Measure,
    Not,
    Number,
    Obligation,
    Ruleset,
    leaves,
    measures_of,
)
from sleec_verify.changes.assertions.assertion import Assertion, AssertionResult, Violation
from sleec_verify.changes.assertions.replay import is_of, replay
from sleec_verify.changes.assertions.vocabulary import Vocabulary
from sleec_verify.changes.relations import relations_at_one_instant
from sleec_verify.encoding.equation import conjunction, disjunction, implications
from sleec_verify.encoding.solver import Undecided
from sleec_verify.query.question import is_possible
from sleec_verify.query.ruleset_index import RulesetIndex
from sleec_verify.query.witness import smallest_situation


def verify(
    ruleset: Ruleset, assertion: Assertion, domain: str | None = None, known: Vocabulary | None = None
) -> AssertionResult:
    """Whether the assertion holds for the rules in every situation, in every domain, or in `domain`.

    The formula says that the situation of the assertion occurs, and that the rules violate it: they oblige every
    literal of a `never`, or do not oblige some literal of an `always`. It is unsatisfiable if and only if the assertion
    holds. A model is a counterexample. The evaluator replays the smallest one.
    """
    apart = next(_read_otherwise(ruleset, assertion, known), None) if known is not None else None
    if apart is not None:
        return AssertionResult(assertion, ruleset, apart)
    domains: Sequence[str | None] = ruleset.domains or (None,) if domain is None else (domain,)
    measures = {**(known.measures if known is not None else {}), **ruleset.measures}
    try:
        for one in domains:
            broken = _broken(ruleset if one is None else ruleset.in_domain(one), assertion, measures)
            if broken is not None:
                return AssertionResult(assertion, ruleset, broken._replace(domain=one))
    except Undecided as error:
        return AssertionResult(assertion, ruleset, str(error))
    return AssertionResult(assertion, ruleset, None)


def _read_otherwise(ruleset: Ruleset, assertion: Assertion, known: Vocabulary) -> Iterator[str]:
    """Messages about names that differ between these rules and `known`, the vocabulary of the parsed assertion."""
    kinds = (
        ("a trigger", ruleset.triggers, known.triggers),
        ("a condition", ruleset.conditions, known.conditions),
        ("a measure", ruleset.measures.keys(), known.measures.keys()),
    )
    for leaf in leaves(assertion.when):
        for name in (leaf.name,) if isinstance(leaf, Atom) else measures_of(leaf):
            mine, theirs = ([kind for kind, *names in kinds if name in names[side]] for side in (0, 1))
            if mine and mine != theirs:
                yield f"`{name}` is {mine[0]} in these rules, but {theirs[0]} in the rules of the assertion"
            elif name in ruleset.measures and ruleset.measures[name].values != known.measures[name].values:
                yield f"`{name}` has a different scale in the rules of the assertion"
        for side in () if isinstance(leaf, Atom) else (leaf.left, leaf.right):
            if not isinstance(side, Number) or side.constant is None or side.constant not in ruleset.constants:
                continue
            if ruleset.constants[side.constant].value != side.value:
                yield f"`{side.constant}` has a different value in the rules of the assertion"


def _broken(ruleset: Ruleset, assertion: Assertion, measures: Mapping[str, Measure]) -> Violation | None:
    given = [c.formula for c in ruleset.constraints if isinstance(c, Assume)]
    given += [formula for _, formula in relations_at_one_instant(ruleset)] if ruleset.is_timed else []
    index = RulesetIndex(Ruleset((*measures.values(), *map(Assume, given), *ruleset.rules)))
    if not is_possible(index):
        return None
    called = [_called_for(ruleset, literal) for literal in assertion.literals]
    if assertion.kind == "never":
        questions = [conjunction([assertion.when, *called])]
    else:
        questions = [conjunction([assertion.when, Not(formula)]) for formula in called]
    found = [w for w in (smallest_situation(index, question) for question in questions) if w is not None]
    if not found:
        return None
    witness = min(found, key=lambda w: len(w.triggers) + len(w.conditions))
    return Violation(witness, replay(ruleset, assertion, witness, given, measures))


def _called_for(ruleset: Ruleset, literal: Obligation) -> Formula:
    """The situations in which some clause that decides obliges the literal, at any time."""
    return disjunction(
        [
            guard
            for rule in ruleset.rules
            if any(is_of(o, literal) for clause in rule.clauses() for o in clause.obligations)
            for _, guard, clause in implications(rule, ruleset.reading)
            if any(is_of(o, literal) for o in clause.obligations)
        ]
    )
