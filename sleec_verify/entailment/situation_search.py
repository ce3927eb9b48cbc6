"""Situations that a person asks for: an obligation is due, rules apply together, a clause applies, the readings differ.

Each is a question of satisfiability. If the solver finds none, there is none: the answer "none" is a proof.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from sleec_runtime.model import And, Atom, Context, Formula, Rule
from sleec_verify.checks.base import guard_at
from sleec_verify.checks.reading import where_readings_differ
from sleec_verify.encoding.budget import Undecided
from sleec_verify.entailment.entailment import entail
from sleec_verify.entailment.replay import applies
from sleec_verify.query.cone import rules_active_with
from sleec_verify.query.prime_implicates import inconsistent_sets_of
from sleec_verify.query.question import Question
from sleec_verify.query.ruleset_index import ClausePosition, RulesetIndex
from sleec_verify.query.witness import smallest_situation
from sleec_verify.wording.phrases import quoted
from sleec_verify.wording.sentence import sentence

Clauses = Sequence[tuple[str, int | None]]
"""Rules with the number of the clause that decides; None for any clause."""


def with_obligation(index: RulesetIndex, name: str) -> Context | None:
    """A situation without conflict in which an obligation is due. Raises `Undecided`."""
    doubt: Undecided | None = None
    for place in _places(index, name):
        label = index.rules[place.rule].label
        for context in _candidates(index, place):
            answer = entail(index.ruleset, context)
            if answer.broken_assumptions:
                doubt = Undecided(sentence("relations of the rules may exclude the situation that the solver found"))
            elif name in answer.obligations:
                return _confirmed(index, context, [(label, place.number)])
            else:
                doubt = Undecided(
                    sentence(
                        "in the situations that were tried, the rules contradict each other, or {name} is one of "
                        "several alternatives",
                        name=quoted(name),
                    )
                )
    if doubt is not None:
        raise doubt
    return None


def _places(index: RulesetIndex, name: str) -> Iterator[ClausePosition]:
    for obligation, places in index.by_obligation.items():
        if obligation.name == name and not obligation.negated:
            yield from places


def _candidates(index: RulesetIndex, place: ClausePosition) -> Iterator[Context]:
    """The smallest situation of a clause, and if that is a conflict, any one without a conflict. Other triggers need
    not occur, so only the rules of its trigger matter."""
    smallest = smallest_situation(index, guard_at(index, place))
    if smallest is None:
        return
    if entail(index.ruleset, smallest.context()).consistent:
        yield smallest.context()
        return
    group = rules_active_with(index, index.rules[place.rule].trigger, satisfying=True)
    with Question(index) as question:
        encoder = question.encoder
        due = encoder.due([pair for one in group for pair in zip(index.clauses[one], question.guards(one))])
        clashes = inconsistent_sets_of(index).among(due)
        for exclusion in clashes.exclusions:
            question.require(-encoder.at_least_two([due[literal] for literal in exclusion.literals]))
        for clash in clashes.listed:
            allowed = -encoder.literal(clash.situation)
            question.require(*(-due[literal] for literal in sorted(clash.literals, key=str)), allowed)
        question.require(question.guards(place.rule)[place.number])
        if question.ask():
            yield question.situation()


def with_rules(index: RulesetIndex, labels: Iterable[str]) -> Context | None:
    """A smallest situation in which all these rules apply. Raises `Undecided`."""
    rules = [index.ruleset.by_label[label] for label in labels]
    formulas = [formula for rule in rules for formula in _triggered(rule)]
    return _smallest(index, And(tuple(formulas)), [(rule.label, None) for rule in rules])


def _triggered(rule: Rule) -> Iterator[Formula]:
    yield Atom("trigger", rule.trigger)
    if rule.guard is not None:
        yield rule.guard


def with_clause(index: RulesetIndex, label: str, number: int) -> Context | None:
    """A smallest situation in which a clause of a rule applies. Raises `Undecided`."""
    position = index.rules.index(index.ruleset.by_label[label])
    return _smallest(index, guard_at(index, ClausePosition(position, number)), [(label, number)])


def with_different_readings(index: RulesetIndex) -> tuple[str, Context] | None:
    """A smallest situation in which the readings of some rule differ, and its label. Raises `Undecided`."""
    for label, position in index.labelled():
        found = where_readings_differ(index, position) if len(index.clauses[position]) > 2 else None
        if found is not None:
            deciding = found.deciding[index.ruleset.reading]
            return label, _confirmed(index, found.witness.context(), [(label, deciding)])
    return None


def _smallest(index: RulesetIndex, formula: Formula, clauses: Clauses) -> Context | None:
    witness = smallest_situation(index, formula)
    return None if witness is None else _confirmed(index, witness.context(), clauses)


def _confirmed(index: RulesetIndex, context: Context, clauses: Clauses) -> Context:
    """The situation, if the evaluator confirms it and no relation excludes it. Raises `Undecided` otherwise."""
    if not applies(index.ruleset, context, clauses):
        raise Undecided(sentence("the evaluator rejected the situation; this is a bug in sleec-verify"))
    if index.ruleset.is_timed and entail(index.ruleset, context).broken_assumptions:
        raise Undecided(sentence("relations of the rules may exclude the situation that the solver found"))
    return context
