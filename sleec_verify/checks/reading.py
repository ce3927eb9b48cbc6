"""Rules whose meaning depends on the reading of their hedges."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import NamedTuple

from sleec_runtime.model import Clause, Formula, Not, Obligation, Reading, Rule, Ruleset
from sleec_verify.checks.base import Check, FindingKind
from sleec_verify.checks.questions import ask_each
from sleec_verify.encoding.equation import conjunction, disjunction, guard, implications
from sleec_verify.query.question import Question
from sleec_verify.query.rule_shape import Shape, shape_at
from sleec_verify.query.ruleset_index import RulesetIndex
from sleec_verify.query.witness import smallest_situation
from sleec_verify.results.finding import ClauseRef, Finding, Witness
from sleec_verify.wording.phrases import exception, quoted
from sleec_verify.wording.sentence import joined, sentence

LONG = 30
"""The longest chain of hedges that is examined for all pairs of clauses. Longer ones are one question, and get a
smallest situation for one pair of clauses."""

OTHER: dict[Reading, Reading] = {"cascade": "priority", "priority": "cascade"}


def _readings(index: RulesetIndex) -> Iterator[Finding]:
    """Unsatisfiable exactly if the rule means the same: some literal is due under one reading and not under the
    other. A model is a situation in which the readings differ."""

    known: dict[object, tuple[Shape, _Parted | None]] = {}

    def of(position: int) -> Iterator[Finding]:
        if len(index.clauses[position]) > 2:
            parted = _parted_by_shape(index, position, known)
            if parted is not None:
                yield _finding(index, position, parted)

    yield from ask_each(((quoted(label), position) for label, position in index.labelled()), of)


class _Parted(NamedTuple):
    """A smallest situation in which the readings differ, and the number of the clause that decides under each."""

    witness: Witness
    deciding: dict[Reading, int]


def _parted_by_shape(
    index: RulesetIndex, position: int, known: dict[object, tuple[Shape, _Parted | None]]
) -> _Parted | None:
    """Where the readings differ. Rules of the same shape are one question."""
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
    assert witness is not None, "the readings differ in some situation"
    with Question(index) as question:
        by_reading = {r: question.encoder.guards(rule, r) for r in (reading, OTHER[reading])}
        question.ask(*question.encoder.assumptions(witness.context()))
        deciding = {r: next(n for n, g in enumerate(guards) if question.true(g)) for r, guards in by_reading.items()}
    return _Parted(witness, deciding)


def _parting(index: RulesetIndex, position: int) -> Formula | None:
    """The formula for the situations in which the readings differ; None if there are none. For a long chain, only the
    situations in which the same two clauses decide as in the model: the full formula is quadratic in the length."""
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
    """Whether the readings differ in some situation, for a chain without nested chains.

    They differ if hedge j is the last true one, the cascade ends at a clause before hedge j - 1, and the two oblige
    different things. Each j is one question for each run of adjacent clauses with other obligations. So most negative
    answers need no search and have a short refutation.
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
    """The runs of clauses before hedge j - 1 with other obligations than hedge j: for each its first clause, and
    the clause after its last."""
    due = [frozenset(clause.obligations) for clause in (rule.default, *rule.hedges)]
    first = None
    for k in range(j):
        if k < j - 1 and due[k] != due[j]:
            first = k if first is None else first
        elif first is not None:
            yield first, k
            first = None


def _situations(rule: Rule, here: Reading) -> Formula:
    """The formula for all situations in which the readings differ."""
    one, other = _due(rule, here), _due(rule, OTHER[here])
    return disjunction([conjunction([a[o], Not(b[o])]) for a, b in ((one, other), (other, one)) for o in one])


def _finding(index: RulesetIndex, position: int, parted: _Parted) -> Finding:
    rule, reading, (witness, deciding) = index.rules[position], index.ruleset.reading, parted
    clauses = index.clauses[position]
    said = [
        sentence(
            "with READING {reading}, {exception} applies: {response}",
            reading=r,
            exception=exception(clauses[deciding[r]]) if deciding[r] else sentence("no exception"),
            response=_response(clauses[deciding[r]], index.ruleset.syntax == "dsl"),
        )
        for r in (reading, OTHER[reading])
    ]
    return READING.finding(
        sentence("what rule {rule} requires depends on how its exceptions are read", rule=quoted(rule.label)),
        rule.heading_span,
        rules=(rule.label,),
        clauses=tuple(ClauseRef(rule.label, n) for n in dict.fromkeys(deciding.values())),
        obligations=tuple(sorted({o.name for n in deciding.values() for o in clauses[n].obligations})),
        witness=witness,
        note=sentence("if nothing else holds: {said}", said=joined("; ", said)),
        help=_help(index.ruleset),
    )


def _help(ruleset: Ruleset) -> str:
    """What to write so that the check has nothing to report. A DSL text cannot state its reading."""
    if ruleset.syntax == "dsl":
        return sentence(
            "if you mean priority, add the conditions of all later exceptions to each exception with "
            "`or`; if you mean cascade, add those of all earlier exceptions with `and`"
        )
    return sentence(
        "at the top of the text, write READING {reading} to keep this reading, or READING {other} for the other one",
        reading=ruleset.reading,
        other=OTHER[ruleset.reading],
    )


def _due(rule: Rule, reading: Reading) -> dict[Obligation, Formula]:
    """For each literal of the rule, the formula for the situations in which it is due."""
    guards: dict[Obligation, list[Formula]] = {}
    for implication in implications(rule, reading):
        for obligation in implication.clause.obligations:
            guards.setdefault(obligation, []).append(implication.guard)
    return {obligation: disjunction(where) for obligation, where in guards.items()}


def _response(clause: Clause, dsl: bool) -> str:
    """The response of a clause with its windows; in the DSL with `not` in lower case."""
    from sleec_runtime.model import obligation_text

    if not clause.obligations:
        return sentence("nothing is required")
    words = quoted(f" {'and' if dsl else 'AND'} ".join(map(obligation_text, clause.obligations)))
    return re.sub(r"\bNOT ", "not ", words) if dsl else words


READING = Check(
    "reading",
    "Does every rule require the same under both readings of its exceptions?",
    (
        FindingKind(
            "SLEEC401",
            "warning",
            "a rule whose meaning depends on the reading",
            "There are two ways to read several exceptions. `cascade` applies the last exception before the first "
            "false condition. `priority` applies the last exception whose condition is true. If a later "
            "condition can be true while an earlier one is false, the two readings can require different things, and "
            "another tool may read this rule differently. A text that sets its reading with `READING cascade` or "
            "`READING priority` has no such finding.",
            "At the top of the text, write the reading that you mean: `READING cascade` or `READING priority`. If "
            "other tools read the rule, write it so that both readings agree: repeat the condition of each exception "
            "in the next one, as in the example below. docs/language.md shows exceptions that do not depend on each "
            "other.",
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
