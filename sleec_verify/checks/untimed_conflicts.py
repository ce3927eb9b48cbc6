"""Causes of conflicts: minimal sets of clauses whose responses are inconsistent, by themselves or with the
constraints."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import chain
from math import prod

from sleec_runtime.model import Formula, Not, Obligation
from sleec_verify.checks.base import clause_at, guard_at
from sleec_verify.checks.questions import ask_each
from sleec_verify.encoding.budget import spend
from sleec_verify.encoding.equation import conjunction
from sleec_verify.query.inconsistent_sets import Exclusion, InconsistentSet
from sleec_verify.query.prime_implicates import inconsistent_sets_of
from sleec_verify.query.question import Question
from sleec_verify.query.ruleset_index import ClausePosition, InstantIndex, RulesetIndex
from sleec_verify.query.witness import smallest_situation
from sleec_verify.results.finding import Witness
from sleec_verify.wording.phrases import listed, quoted
from sleec_verify.wording.sentence import sentence

MOST, MOST_PER_RULE = 1_000, 3
"""The maximal number of causes that are listed: this number, plus more for each rule. Contradicting clauses
multiply, and a ruleset with more causes has one problem, not millions."""

MANY_WAYS = 16
"""The number of ways to oblige the literals of an inconsistent set from which on the first question is whether any
of them is possible."""

PER_ATTEMPT = 8
"""Budget steps for one attempt to complete a cause."""

Cause = tuple[ClausePosition, ...]
"""A minimal set of clauses with inconsistent responses, in the order of the text."""


class Enough(Exception):
    """The maximal number of causes is found, and there may be more."""


def causes(index: InstantIndex) -> Iterator[tuple[Cause, list[tuple[InconsistentSet, Witness]]]]:
    """Every cause, in the order of the text, with its inconsistent set and a smallest situation.

    Unsatisfiable exactly if a set of clauses is not a cause: the guards of the clauses, and the situation in which
    their literals are inconsistent. A model is a conflicting context. Raises `Undecided` or `Enough` after the last
    cause.
    """
    found: dict[Cause, list[tuple[InconsistentSet, Witness]]] = {}
    most = MOST + MOST_PER_RULE * len(index.rules)

    def look(at: tuple[Cause, InconsistentSet]) -> tuple[()]:
        cause, clash = at
        situation = _situation(index, cause, clash)
        if situation is None or not _possible(index, cause, situation):
            return ()
        witness = smallest_situation(index, situation)
        if witness is not None:
            found.setdefault(cause, []).append((clash, witness))
            if len(found) >= most:
                raise Enough(sentence("only the first {most} conflicts are listed; there may be more", most=most))
        return ()

    try:
        for _ in ask_each(_candidates(index), look):
            raise AssertionError("a look makes no finding")
    finally:
        yield from sorted(found.items())


def _candidates(index: RulesetIndex) -> Iterator[tuple[str, tuple[Cause, InconsistentSet]]]:
    """The inconsistent sets, each with every set of clauses that may be its cause, and the rules of these."""
    found = inconsistent_sets_of(index)
    pairs = (pair for exclusion in found.exclusions for pair in _due_together(index, exclusion))
    for clash in chain(found.listed, pairs):
        ways = prod(len(index.by_obligation[literal]) for literal in clash.literals)
        if ways > MANY_WAYS and not _all_due(index, clash):
            continue
        for cause in _covers(index, clash):
            rules = dict.fromkeys(index.rules[place.rule].label for place in cause)
            yield listed(map(quoted, rules)) if rules else "the constraints", (cause, clash)


def _all_due(index: RulesetIndex, clash: InconsistentSet) -> bool:
    """Whether all literals of an inconsistent set are due in some situation."""
    rules = {place.rule for literal in clash.literals for place in index.by_obligation[literal]}
    with Question(index) as question:
        return question.ask(*question.due(sorted(rules), clash.literals).values())


def _due_together(index: RulesetIndex, exclusion: Exclusion) -> Iterator[InconsistentSet]:
    """The pairs of an exclusion that may be due in some situation: all pairs of a literal that can be due with
    another one. One formula, satisfiable exactly if there is a further such literal. A model shows one."""
    rules = {place.rule for literal in exclusion.literals for place in index.by_obligation[literal]}
    with Question(index) as question:
        encoder = question.encoder
        due = question.due(sorted(rules), set(exclusion.literals))
        counting = {literal: encoder.fresh() for literal in due}
        several = encoder.at_least_two([encoder.both(due[literal], counting[literal]) for literal in due])
        while question.ask(several):
            one = next(
                literal for literal in counting if question.true(due[literal]) and question.true(counting[literal])
            )
            question.exclude(counting.pop(one))
            yield from (exclusion.clash(one, other) for other in counting)


def _covers(index: RulesetIndex, clash: InconsistentSet) -> Iterator[Cause]:
    """The minimal sets of clauses, at most one of each rule, that oblige every literal of the inconsistent set."""
    literals = sorted(clash.literals, key=str)
    seen: set[Cause] = set()

    def extend(
        chosen: tuple[ClausePosition, ...], covered: frozenset[Obligation]
    ) -> Iterator[tuple[ClausePosition, ...]]:
        spend(PER_ATTEMPT)
        missing = next((literal for literal in literals if literal not in covered), None)
        if missing is None:
            yield chosen
            return
        for place in index.by_obligation[missing]:
            # Two clauses of one rule never decide together.
            if all(place.rule != other.rule for other in chosen):
                yield from extend((*chosen, place), covered.union(clause_at(index, place).obligations))

    for chosen in extend((), frozenset()):
        cause = tuple(sorted(chosen))
        if cause not in seen and _minimal(index, cause, clash.literals):
            seen.add(cause)
            yield cause


def _minimal(index: RulesetIndex, cause: Cause, literals: frozenset[Obligation]) -> bool:
    return not any(literals <= _obliged(index, (other for other in cause if other != place)) for place in cause)


def _obliged(index: RulesetIndex, places: Iterable[ClausePosition]) -> set[Obligation]:
    return set(chain.from_iterable(clause_at(index, place).obligations for place in places))


def _situation(index: RulesetIndex, cause: Cause, clash: InconsistentSet) -> Formula | None:
    """A situation in which the clauses decide together and are inconsistent, and no proper subset of them is. None
    if a subset always is."""
    conjuncts = [guard_at(index, place) for place in cause]
    if clash.labels:
        conjuncts.append(clash.situation)
    for place in cause:
        for smaller in inconsistent_sets_of(index).among(_obliged(index, (other for other in cause if other != place))):
            if not smaller.labels:
                return None
            if smaller != clash:
                conjuncts.append(Not(smaller.situation))
    return conjunction(list(dict.fromkeys(conjuncts)))


def _possible(index: RulesetIndex, cause: Cause, situation: Formula) -> bool:
    """Whether the clauses decide together, by a question that can be recorded. Without recorder and assumptions, the
    search for a smallest situation answers it."""
    if index.recorder is None and not index.assumptions:
        return True
    with Question(index) as question:
        for place in cause:
            question.require(question.guards(place.rule)[place.number])
        question.require_formula(situation)
        return question.ask()
