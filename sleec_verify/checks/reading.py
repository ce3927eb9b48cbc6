"""Rules that mean something else under the other reading of a chain of hedges."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import NamedTuple

from sleec_runtime.model import Clause, Formula, Not, Obligation, Reading, Rule
from sleec_verify.checks.base import Check, FindingKind, clause_name, listed
from sleec_verify.checks.each import each
from sleec_verify.encoding.equation import conjunction, disjunction, guard, implications
from sleec_verify.query.question import Question
from sleec_verify.query.rule_shape import Shape, shape_at
from sleec_verify.query.ruleset_index import RulesetIndex
from sleec_verify.query.witness import smallest_situation
from sleec_verify.results.finding import ClauseRef, Finding, Witness

LONG = 30
"""Chains of more hedges than this get a smallest situation for one pair of clauses, not for all pairs; and whether they
part is one question, not one for each hedge."""

OTHER: dict[Reading, Reading] = {"cascade": "priority", "priority": "cascade"}


def _readings(index: RulesetIndex) -> Iterator[Finding]:
    """Unsatisfiable exactly when the rule means the same: some literal is due under one reading and not under the
    other. A model is a situation in which the readings part."""

    known: dict[object, tuple[Shape, _Parted | None]] = {}

    def of(position: int) -> Iterator[Finding]:
        if len(index.clauses[position]) > 2:
            parted = _parted_by_shape(index, position, known)
            if parted is not None:
                yield _finding(index, position, parted)

    yield from each(index.labelled(), of)


class _Parted(NamedTuple):
    """A smallest situation in which the readings part, and the clause that decides by each."""

    witness: Witness
    deciding: dict[Reading, int]


def _parted_by_shape(
    index: RulesetIndex, position: int, known: dict[object, tuple[Shape, _Parted | None]]
) -> _Parted | None:
    """Where the readings part, asked once for all rules of one shape."""
    shape = shape_at(index, position)
    if shape is None:
        return where_readings_differ(index, position)
    found = known.get(shape.key)
    if found is None:
        found = known[shape.key] = shape, where_readings_differ(index, position)
    one, parted = found
    return None if parted is None else parted._replace(witness=shape.renamed(parted.witness, one.names))


def where_readings_differ(index: RulesetIndex, position: int) -> _Parted | None:
    situations = _parting(index, position)
    if situations is None:
        return None
    rule, reading = index.rules[position], index.ruleset.reading
    witness = smallest_situation(index, situations)
    assert witness is not None, "the readings part in some situation"
    with Question(index) as question:
        by_reading = {r: question.encoder.guards(rule, r) for r in (reading, OTHER[reading])}
        question.ask(*question.encoder.assumptions(witness.context()))
        deciding = {r: next(n for n, g in enumerate(guards) if question.true(g)) for r, guards in by_reading.items()}
    return _Parted(witness, deciding)


def _parting(index: RulesetIndex, position: int) -> Formula | None:
    """Where the readings part; None if nowhere. Of a long chain, where they part as they do in the situation that was
    found: all of them, written out, grow with the square of its length."""
    rule, clauses = index.rules[position], index.clauses[position]
    here, there = index.ruleset.reading, OTHER[index.ruleset.reading]
    if len(clauses) == 1 + len(rule.hedges) and len(rule.hedges) <= LONG:
        return _situations(rule, here) if _parts_in_chain(index, rule) else None
    with Question(index) as question:
        encoder = question.encoder
        guards = (question.guards(position), encoder.guards(rule, there))
        one, other = (encoder.due(zip(clauses, each)) for each in guards)
        unequal = [(one[o], other[o]) for o in one if one[o] != other[o]]
        if not question.ask(encoder.any_of([encoder.both(a, -b) for a, b in unequal + [(b, a) for a, b in unequal]])):
            return None
        deciding = [next(n for n, guard in enumerate(each) if question.true(guard)) for each in guards]
    if len(rule.hedges) <= LONG:
        return _situations(rule, here)
    return conjunction([guard(rule, reading, n) for reading, n in zip((here, there), deciding)])


def _parts_in_chain(index: RulesetIndex, rule: Rule) -> bool:
    """Whether they part anywhere, of a chain without chains in it.

    They part where hedge j is the last that is true, and one before hedge j - 1 the last before the first false one,
    and the two oblige different things. Each j is asked by itself, with clauses beside one another that oblige others
    than it as one: so the answer "no" needs no search most of the time, and has a short refutation.
    """
    with Question(index) as question:
        encoder = question.encoder
        conditions = [encoder.literal(hedge.condition) for hedge in rule.hedges if hedge.condition is not None]
        triggered = encoder.triggered(rule)
        reached = [triggered]
        for condition in conditions[:-1]:
            reached.append(encoder.both(reached[-1], condition))
        last = [triggered]
        for condition in reversed(conditions[2:]):
            last.append(encoder.both(last[-1], -condition))
        return any(
            question.ask(reached[first], -reached[behind], conditions[j - 1], last[len(conditions) - j])
            for j in range(2, len(conditions) + 1)
            for first, behind in _unequal(rule, j)
        )


def _unequal(rule: Rule, j: int) -> Iterator[tuple[int, int]]:
    """The clauses before hedge j - 1 that oblige something else than hedge j, in runs: the first, and the one behind
    the last."""
    due = [frozenset(clause.obligations) for clause in (rule.default, *rule.hedges)]
    first = None
    for k in range(j):
        if k < j - 1 and due[k] != due[j]:
            first = k if first is None else first
        elif first is not None:
            yield first, k
            first = None


def _situations(rule: Rule, here: Reading) -> Formula:
    """All situations in which the readings part."""
    one, other = _due(rule, here), _due(rule, OTHER[here])
    return disjunction([conjunction([a[o], Not(b[o])]) for a, b in ((one, other), (other, one)) for o in one])


def _finding(index: RulesetIndex, position: int, parted: _Parted) -> Finding:
    rule, reading, (witness, deciding) = index.rules[position], index.ruleset.reading, parted
    clauses = index.clauses[position]
    said = [
        f"read as {r}, {clause_name(rule, n)} decides: {_response(clauses[n], index.ruleset.syntax == 'dsl')}"
        for r, n in ((r, deciding[r]) for r in (reading, OTHER[reading]))
    ]
    return READING.finding(
        f"what {rule.label} obliges depends on the reading of its hedges",
        rule.label_span if rule.labelled else rule.span,
        rules=(rule.label,),
        clauses=tuple(ClauseRef(rule.label, n) for n in dict.fromkeys(deciding.values())),
        obligations=tuple(sorted({o.name for n in deciding.values() for o in clauses[n].obligations})),
        witness=witness,
        note=f"with all else false: {'; '.join(said)}",
        help=_help(index),
    )


def _help(index: RulesetIndex) -> str:
    ruleset = index.ruleset
    if ruleset.syntax == "dsl":
        return f"this ruleset is read as {ruleset.reading}; the DSL means priority, structured English cascade"
    if ruleset.reading_stated:
        return f"the text says READING {ruleset.reading}; other tools may read it otherwise"
    return (
        f"this ruleset is read as {ruleset.reading}; if that is what you mean, say it in the text: "
        f"READING {ruleset.reading}"
    )


def _due(rule: Rule, reading: Reading) -> dict[Obligation, Formula]:
    """For each literal of the rule, where it is due."""
    guards: dict[Obligation, list[Formula]] = {}
    for implication in implications(rule, reading):
        for obligation in implication.clause.obligations:
            guards.setdefault(obligation, []).append(implication.guard)
    return {obligation: disjunction(where) for obligation, where in guards.items()}


def _response(clause: Clause, dsl: bool) -> str:
    """What a clause calls for, with its times; in rules of the DSL with `not` as it is written there."""
    from sleec_runtime.model import obligation_text

    if not clause.obligations:
        return "nothing is due"
    words = listed(map(obligation_text, clause.obligations))
    return re.sub(r"\bNOT ", "not ", words) if dsl else words


READING = Check(
    "reading",
    "Does every rule oblige the same under both readings of a chain of hedges?",
    (
        FindingKind(
            "SLEEC401",
            "warning",
            "a rule whose meaning depends on the reading",
            "Two readings of a chain of hedges are in use. `cascade` stops at the first false condition; `priority` "
            "lets the last true condition win, whatever came before it. Where a later condition can be true while an "
            "earlier one is false, they may oblige different things, and tools of others may read this rule unlike "
            "you.",
            "Write the rule so that both agree, for example by making each hedge repeat the condition before it. "
            "`sleec-verify convert --to english --reading …` does it for you.",
            "WHEN HumanOnFloor THEN CallEmergencyServices\n"
            "UNLESS UserResponsive IN WHICH CASE AskForUserStatus\n"
            "UNLESS UserWithCompanion IN WHICH CASE AskCompanionToCheck\n",
            "WHEN HumanOnFloor THEN CallEmergencyServices\n"
            "UNLESS UserResponsive IN WHICH CASE AskForUserStatus\n"
            "UNLESS UserResponsive AND UserWithCompanion IN WHICH CASE AskCompanionToCheck\n",
        ),
    ),
    _readings,
)
