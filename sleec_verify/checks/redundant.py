"""Rules and hedges without effect."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

from sleec_runtime.model import Clause, Obligation, Rule
from sleec_verify.checks.base import Check, FindingKind, literals_of
from sleec_verify.checks.dead import places_of_hedges
from sleec_verify.checks.questions import ask_both_parts, ask_each, ask_each_shape
from sleec_verify.checks.relevant_rules import in_words, rules_in
from sleec_verify.encoding.solver import Undecided
from sleec_verify.query.cone import rules_of_same_obligation
from sleec_verify.query.question import Question
from sleec_verify.query.ruleset_index import RulesetIndex
from sleec_verify.results.finding import ClauseRef, Finding
from sleec_verify.wording.phrases import clause_name, listed, quoted
from sleec_verify.wording.sentence import plural, sentence

if TYPE_CHECKING:
    from sleec_verify.traces.index import TraceIndex


def with_others(findings: Iterator[Finding]) -> Iterator[Finding]:
    """The findings about rules that can be removed, with advice: if one is redundant because of another, only one of
    them can be removed.

    Raises Undecided, after all findings, if `findings` does."""
    found = []
    why: Undecided | None = None
    try:
        for finding in findings:
            found.append(finding)
    except Undecided as error:
        why = error
    can_go = {finding.rules[0] for finding in found}
    for finding in found:
        others = [label for label in finding.rules[1:] if label in can_go]
        named = listed(map(quoted, others)) if others else ""
        advice = sentence("remove it, or keep it and say why in a comment")
        if others:
            advice = sentence(
                "remove it, and check again before you also remove {rules}; or keep it and say why in a comment",
                rules=named,
            )
        yield replace(finding, help=advice)
    if why is not None:
        raise why


def _redundant_rules(index: RulesetIndex) -> Iterator[Finding]:
    """A finding for each rule without effect."""
    yield from with_others(ask_both_parts(index, _rules_in_situations, _rules_in_traces))


def _rules_in_traces(traces: TraceIndex) -> Iterator[Finding]:
    """A finding for each rule that no trace violates that satisfies all other rules."""
    from sleec_verify.traces.questions import find_violation

    def of(rule: Rule) -> Iterator[Finding]:
        answer = find_violation(traces, rule)
        if answer.trace is not None:
            return
        others = in_words(traces, answer.matter)
        yield REDUNDANT_RULE.finding(
            sentence(
                "rule {rule} can be removed: the rules require and allow the same without it", rule=quoted(rule.label)
            ),
            rule.heading_span,
            rules=(rule.label, *rules_in(traces, answer.matter)),
            note=sentence("a robot that follows {rules} follows it, too", rules=listed(others))
            if others
            else sentence("nothing can break it"),
        )

    yield from ask_each(((quoted(rule.label), rule) for rule in traces.rules), of)


def _rules_in_situations(index: RulesetIndex) -> Iterator[Finding]:
    """Unsatisfiable exactly when the rule is redundant: it obliges a literal that no other rule obliges. A model is a
    situation in which the rule makes a difference."""

    def of(position: int) -> Iterator[Finding]:
        rule, others = index.rules[position], rules_of_same_obligation(index, position)
        if _makes_a_difference(index, position, others):
            return
        needed = _needed(index, position, others)
        cover = [index.rules[other].label for other in needed]
        yield REDUNDANT_RULE.finding(
            sentence(
                "rule {rule} can be removed: every situation requires the same without it", rule=quoted(rule.label)
            ),
            rule.heading_span,
            rules=(rule.label, *cover),
            note=plural(
                len(cover), "{rules} requires the same", "{rules} require the same", rules=listed(map(quoted, cover))
            )
            if cover
            else sentence("it requires nothing in any situation"),
        )

    yield from ask_each_shape(index, of, lambda position: not rules_of_same_obligation(index, position))


def _makes_a_difference(index: RulesetIndex, position: int, others: Sequence[int]) -> bool:
    about = literals_of(index.clauses[position])
    with Question(index) as question:
        mine, theirs = question.due([position], about), question.due(others, about)
        return question.ask(_differs(question, mine, {}, theirs))


def _differs(
    question: Question, one: dict[Obligation, int], other: dict[Obligation, int], anyway: dict[Obligation, int]
) -> int:
    """A literal that is equivalent to "some literal is due by one and not by the other, and not due by other rules"."""
    encoder, never = question.encoder, -question.encoder.true()
    differences = []
    for obligation in {**one, **other}:
        a, b = one.get(obligation, never), other.get(obligation, never)
        unequal = encoder.any_of([encoder.both(a, -b), encoder.both(-a, b)])
        differences.append(encoder.both(unequal, -anyway.get(obligation, never)))
    return encoder.any_of(differences)


def _needed(index: RulesetIndex, position: int, others: Sequence[int]) -> list[int]:
    """A minimal part of `others` that makes the rule redundant. Starts from a core and removes one rule after the
    other. One formula, with a switch for each of the others, because a hundred copies of one rule do occur."""
    about = literals_of(index.clauses[position])
    with Question(index) as question:
        encoder = question.encoder
        mine = question.due([position], about)
        switches = {encoder.fresh(): other for other in others}
        pairs = []
        for switch, other in switches.items():
            guards = question.guards(other)
            pairs += [(c, encoder.both(switch, guard)) for c, guard in zip(index.clauses[other], guards)]
        differs = _differs(question, mine, {}, encoder.due(pairs))
        question.ask(differs, *switches)
        needed = question.core_among(switches)
        for switch in needed:
            without = [kept for kept in needed if kept != switch]
            if len(without) < len(needed) and not question.ask(differs, *without):
                needed = question.core_among(without)
    return [switches[switch] for switch in needed]


def _redundant_hedges(index: RulesetIndex) -> Iterator[Finding]:
    """A finding for each hedge without effect."""
    yield from ask_both_parts(index, _hedges_in_situations, _hedges_in_traces)


def _hedges_in_traces(traces: TraceIndex) -> Iterator[Finding]:
    """A finding for each hedge without which the same traces satisfy everything: no trace violates the rule and
    satisfies it without the hedge, or the reverse."""
    from sleec_verify.traces.questions import find_difference

    def of(place: tuple[Rule, int]) -> Iterator[Finding]:
        rule, number = place
        less = without_hedge(rule, number)
        if find_difference(traces, rule, number, less).trace is not None:
            return
        hedge = list(rule.clauses())[number]
        yield REDUNDANT_HEDGE.finding(
            sentence(
                "{clause} can be removed: the rules require and allow the same without it",
                clause=clause_name(rule, number),
            ),
            hedge.span,
            rules=(rule.label,),
            clauses=(ClauseRef(rule.label, number),),
            help=what_to_do(hedge),
        )

    yield from ask_each(places_of_hedges(traces.rules), of)


def _hedges_in_situations(index: RulesetIndex) -> Iterator[Finding]:
    """Unsatisfiable exactly when the hedge is redundant: some literal is due with it and not without it, or without
    it and not with it, and no other rule obliges it. A model is a situation in which the hedge makes a difference."""

    def of(position: int) -> Iterator[Finding]:
        rule, clauses = index.rules[position], index.clauses[position]
        about = literals_of(clauses)
        others = rules_of_same_obligation(index, position)
        for number in _not_plainly_needed(index, position, others):
            with Question(index) as question:
                changed = without_hedge(rule, number)
                with_it = question.due([position], about)
                without = question.encoder.due(zip(changed.clauses(), question.guards_of(changed)))
                if question.ask(_differs(question, with_it, without, question.due(others, about))):
                    continue
            yield REDUNDANT_HEDGE.finding(
                sentence(
                    "{clause} can be removed: every situation requires the same without it",
                    clause=clause_name(rule, number),
                ),
                clauses[number].span,
                rules=(rule.label,),
                clauses=(ClauseRef(rule.label, number),),
                help=what_to_do(clauses[number]),
            )

    yield from ask_each_shape(index, of, lambda position: not rules_of_same_obligation(index, position))


def what_to_do(hedge: Clause) -> str:
    """Advice for a hedge that can be removed."""
    if not hedge.obligations:
        return sentence("it has no response: add the response that you meant, or remove it and check again")
    return sentence("check whether its response is the one that you meant, or remove it and check again")


def _not_plainly_needed(index: RulesetIndex, position: int, others: Sequence[int]) -> list[int]:
    """The hedges except those that oblige, in some situation, what no other clause and no other rule obliges. One
    formula finds these, instead of one for each hedge."""
    clauses = index.clauses[position]
    if len(clauses) == 1:
        return []
    count: dict[Obligation, int] = {}
    for clause in clauses:
        for literal in set(clause.obligations):
            count[literal] = count.get(literal, 0) + 1
    with Question(index) as question:
        encoder, never = question.encoder, -question.encoder.true()
        anyway = question.due(others, literals_of(clauses))
        added = []
        for clause, guard in zip(clauses, question.guards(position)):
            alone = [-anyway.get(literal, never) for literal in clause.obligations if count[literal] == 1]
            added.append(encoder.both(guard, encoder.any_of(alone)) if alone else never)
        return [number for number in range(1, len(clauses)) if not question.ask(added[number])]


def without_hedge(rule: Rule, number: int) -> Rule:
    """The rule without hedge `number` (from 1, in the order of `Rule.clauses`) and the chain nested in it."""
    left = number

    def pruned(hedges: tuple[Clause, ...]) -> tuple[Clause, ...]:
        nonlocal left
        kept = []
        for hedge in hedges:
            left -= 1
            if left == 0:
                continue
            kept.append(replace(hedge, hedges=pruned(hedge.hedges)) if hedge.hedges else hedge)
        return tuple(kept)

    default = replace(rule.default, hedges=pruned(rule.default.hedges))
    return replace(rule, default=default, hedges=pruned(rule.hedges))


REDUNDANT_RULE = Check(
    "redundant-rule",
    "Does every rule require something that the other rules do not?",
    (
        FindingKind(
            "SLEEC301",
            "warning",
            "a rule without effect",
            "Other rules require everything that this rule requires, in the same situations. If you later change only "
            "one of two equal rules, they can start to contradict each other.",
            "Remove the rule. If two rules are reported because each makes the other redundant, keep one of them.",
            "RULE answer\nWHEN UserCalls THEN Answer\nRULE answer_kindly\nWHEN UserCalls THEN Answer AND Smile\n",
            "RULE answer_kindly\nWHEN UserCalls THEN Answer AND Smile\n",
        ),
    ),
    _redundant_rules,
    scope="every domain",
)

REDUNDANT_HEDGE = Check(
    "redundant-hedge",
    "Does every exception change what is required in some situation?",
    (
        FindingKind(
            "SLEEC302",
            "warning",
            "an exception without effect",
            "The rules require the same in every situation with and without this exception. Either it repeats the "
            "response that would be required anyway, or it never applies, or it cancels a response that other rules "
            "still require.",
            "Remove the exception, or correct its response. If it has no response, add one, or check which other "
            "rules require what it should cancel.",
            "WHEN UserCalls THEN Answer\nUNLESS UserAsleep IN WHICH CASE Answer\n",
            "WHEN UserCalls THEN Answer\nUNLESS UserAsleep IN WHICH CASE WaitUntilAwake\n",
        ),
    ),
    _redundant_hedges,
    scope="every domain",
)
