"""Rules and hedges that are active in no situation."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from typing import TYPE_CHECKING

from sleec_runtime.model import RELATIONS, Assume, Clause, Formula, MeasureRelation, Rule, in_text_order
from sleec_verify.checks.base import Check, FindingKind
from sleec_verify.checks.questions import ask_both_parts, ask_each, ask_each_shape
from sleec_verify.checks.relevant_rules import in_words
from sleec_verify.query.question import Question
from sleec_verify.query.ruleset_index import RulesetIndex
from sleec_verify.results.finding import ClauseRef, Finding
from sleec_verify.traces.partition import without
from sleec_verify.wording.phrases import clause_name, exception, listed, quoted
from sleec_verify.wording.sentence import sentence

if TYPE_CHECKING:
    from sleec_verify.traces.index import TraceIndex


def _dead_rules(index: RulesetIndex) -> Iterator[Finding]:
    """A finding for each rule that never applies."""
    yield from _ask_with_relations(index, _rules_in_situations, _rules_in_traces)


def _dead_hedges(index: RulesetIndex) -> Iterator[Finding]:
    """A finding for each hedge that never decides."""
    yield from _ask_with_relations(index, _hedges_in_situations, _hedges_in_traces)


def _ask_with_relations(
    index: RulesetIndex,
    in_situations: Callable[[RulesetIndex], Iterable[Finding]],
    in_traces: Callable[[TraceIndex, Rule, Collection[ClauseRef]], Iterable[Finding]],
) -> Iterator[Finding]:
    """The findings about situations. Then, for each rule that relations and constraints of traces concern, the findings
    of `in_traces`, which gets the rules (as clause 0) and hedges that are found already."""
    dead: set[ClauseRef] = set()

    def situations(_: RulesetIndex) -> Iterator[Finding]:
        for finding in in_situations(with_facts(index)):
            dead.update(finding.clauses or (ClauseRef(finding.rules[0], 0),))
            yield finding

    def traces(part: TraceIndex) -> Iterator[Finding]:
        from sleec_verify.traces.questions import is_constrained

        def of(rule: Rule) -> Iterator[Finding]:
            if is_constrained(part, rule):
                yield from in_traces(part, rule, dead)

        yield from ask_each(((quoted(rule.label), rule) for rule in part.rules), of)

    yield from ask_both_parts(index, situations, traces)


def with_facts(index: RulesetIndex) -> RulesetIndex:
    """The ruleset for questions about situations, with the relations between measures as assumptions."""
    relations = [law for law in index.ruleset.statements if isinstance(law, RELATIONS)]
    between_events = [law for law in relations if not isinstance(law, MeasureRelation)]
    return without(index, (), between_events) if relations else index


def _rules_in_situations(index: RulesetIndex) -> Iterator[Finding]:
    """The disjunction of the guards of a rule. It is unsatisfiable if and only if the rule is dead. A model is a
    situation that triggers the rule."""

    def of(position: int) -> Iterator[Finding]:
        with Question(index) as question:
            guards = question.guards(position)
            if not question.ask(question.encoder.any_of(guards)):
                yield _dead_rule(
                    index.rules[position], sentence("check its condition and the assumptions, or remove it")
                )

    yield from ask_each_shape(index, of)


def _dead_rule(rule: Rule, help: str, note: str | None = None) -> Finding:
    return DEAD_RULE.finding(
        sentence("rule {rule} never applies", rule=quoted(rule.label)),
        rule.heading_span,
        rules=(rule.label,),
        note=note,
        help=help,
    )


def _rules_in_traces(traces: TraceIndex, rule: Rule, dead: Collection[ClauseRef]) -> Iterator[Finding]:
    """A finding if the rule applies at no instant that the relations allow, for all traces, lawful or not."""
    from sleec_verify.traces.questions import find_application

    if ClauseRef(rule.label, 0) in dead:
        return
    answer = find_application(traces, rule)
    if answer.trace is None:
        yield _dead_rule(
            rule, sentence("check its condition and the relations, or remove it"), _prevented(traces, answer.matter)
        )


def _hedges_in_traces(traces: TraceIndex, rule: Rule, dead: Collection[ClauseRef]) -> Iterator[Finding]:
    """A finding for each hedge of the rule that is not already reported as dead and that decides at no instant that the
    relations allow, for all traces, lawful or not."""
    from sleec_verify.traces.questions import find_decision

    for number, hedge in enumerate(rule.clauses()):
        if not number or ClauseRef(rule.label, number) in dead:
            continue
        answer = find_decision(traces, rule, number)
        if answer.trace is None:
            yield DEAD_HEDGE.finding(
                sentence("{clause} never applies", clause=clause_name(rule, number)),
                hedge.span,
                rules=(rule.label,),
                clauses=(ClauseRef(rule.label, number),),
                note=_prevented(traces, answer.matter),
                help=sentence("check its condition and the relations, or remove it"),
            )


def _prevented(traces: TraceIndex, matter: Iterable[str]) -> str | None:
    """The relations and constraints with which something never applies, in words."""
    others = in_words(traces, matter)
    return sentence("{relations} excludes it", relations=listed(others)) if others else None


def places_of_hedges(rules: Iterable[Rule]) -> Iterator[tuple[str, tuple[Rule, int]]]:
    """Every hedge of some rules by its name, as the rule and the number of the clause."""
    for rule in rules:
        for number, _ in enumerate(rule.clauses()):
            if number:
                yield clause_name(rule, number), (rule, number)


def _hedges_in_situations(index: RulesetIndex) -> Iterator[Finding]:
    """The guard of a hedge. It is unsatisfiable if and only if the hedge is dead. A model is a situation in which the
    hedge decides."""

    def of(position: int) -> Iterator[Finding]:
        rule, clauses = index.rules[position], index.clauses[position]
        inside = _alternatives_with_hedges(clauses)
        if len(clauses) == 1 and not inside:
            return
        with Question(index) as question:
            guards = question.guards(position)
            # The formula is complete before the first question.
            nested = list(_guards_inside(question, guards, clauses)) if inside else []
            for number, guard in enumerate(guards):
                if number and not question.ask(guard):
                    name, found = clause_name(rule, number), _causes(index, position, number)
                    causes = listed(found) if found else ""
                    yield DEAD_HEDGE.finding(
                        sentence("{clause} never applies because of {causes}", clause=name, causes=causes)
                        if causes
                        else sentence("{clause} never applies", clause=name),
                        clauses[number].span,
                        rules=(rule.label,),
                        clauses=(ClauseRef(rule.label, number),),
                        note=_why(index, position, number),
                        help=sentence("correct its condition or {causes}, or remove it", causes=causes)
                        if causes
                        else sentence("correct its condition, or remove it"),
                    )
            for number, hedge, guard in nested:
                # If the clause itself never decides, this is reported already.
                if question.ask(guards[number]) and not question.ask(guard):
                    yield DEAD_HEDGE.finding(
                        sentence(
                            "in {clause}, {exception} inside OTHERWISE or ELSE never applies",
                            clause=clause_name(rule, number),
                            exception=exception(hedge),
                        ),
                        hedge.span,
                        rules=(rule.label,),
                        clauses=(ClauseRef(rule.label, number),),
                        note=sentence(
                            "the conditions inside OTHERWISE and ELSE are evaluated when the rule is triggered"
                        ),
                        help=sentence("correct its condition, or remove it"),
                    )

    yield from ask_each_shape(index, of)


def _alternatives_with_hedges(clauses: Iterable[Clause]) -> bool:
    """Whether an alternative (``OTHERWISE``, ``ELSE``) of these clauses has hedges, at any depth."""
    return any(
        alternative.hedges or _alternatives_with_hedges(in_text_order(alternative))
        for clause in clauses
        for obligation in clause.obligations
        if obligation.timing is not None
        for alternative in obligation.timing.alternatives()
    )


def _guards_inside(
    question: Question, guards: Sequence[int], clauses: Sequence[Clause]
) -> Iterator[tuple[int, Clause, int]]:
    """The hedges inside the alternatives of these clauses: the number of the clause, the hedge, and the literal "the
    clause decides, and so does the hedge"."""
    for number, (guard, clause) in enumerate(zip(guards, clauses)):
        for hedge, decides in _hedges_inside(question, guard, clause):
            yield number, hedge, decides


def _hedges_inside(question: Question, guard: int, clause: Clause) -> Iterator[tuple[Clause, int]]:
    encoder = question.encoder
    for obligation in clause.obligations:
        for alternative in obligation.timing.alternatives() if obligation.timing is not None else ():
            decided = encoder.chain(alternative, question.index.ruleset.reading)
            for member, decides in zip(in_text_order(alternative), decided):
                here = encoder.both(guard, decides)
                if member is not alternative:
                    yield member, here
                yield from _hedges_inside(question, here, member)


def _causes(index: RulesetIndex, position: int, number: int) -> list[str]:
    """What makes a hedge dead whose condition can be true without it, in words: a minimal set of assumptions, and the
    exceptions that prevent it."""
    clauses = index.clauses[position]
    condition = clauses[number].condition
    assert condition is not None, "only hedges are asked about"
    with Question(index, assuming=False) as question:
        encoder = question.encoder
        guards = question.guards(position)
        about = index.assumptions_about(question.names())
        switches = {encoder.fresh(): assumption for assumption in about}
        for switch, assumption in switches.items():
            question.require(-switch, encoder.literal(assumption.formula))
        applies = [encoder.any_of(guards), encoder.literal(condition)]
        earlier = {
            encoder.literal(formula): hedge
            for hedge in clauses[1:number]
            for formula in [hedge.condition]
            if formula in _earlier_in_cascade(index, position, number)
        }
        if question.ask(guards[number], *switches):
            return []
        needed = question.core_among(switches)
        for switch in list(needed):
            less = [kept for kept in needed if kept != switch]
            if len(less) < len(needed) and not question.ask(guards[number], *less):
                needed = question.core_among(less)
        assumed = [_in_words(index, switches[switch]) for switch in needed]
        if not question.ask(*applies, *switches):
            return assumed
        if earlier and not question.ask(*applies, *earlier, *switches):
            blocking = [earlier[literal] for literal in question.core_among(earlier)]
        else:
            blocking = [
                clause
                for other, clause in enumerate(clauses)
                if other and other != number and question.ask(*applies, guards[other], *switches)
            ]
    return [*map(exception, blocking), *assumed]


def _in_words(index: RulesetIndex, assumption: Assume) -> str:
    """``the ASSUME in line 3``; a relation between measures is a relation."""
    source = index.ruleset.source
    is_written = source.text[assumption.span.start : assumption.span.end].startswith("ASSUME")
    kind = "ASSUME" if is_written else sentence("relation")
    return sentence("the {relation} in line {line}", relation=kind, line=source.place(assumption.span).line)


def _why(index: RulesetIndex, position: int, number: int) -> str:
    """The reason in words why the hedge never decides."""
    condition = index.clauses[position][number].condition
    assert condition is not None, "only hedges are asked about"
    with Question(index) as question:
        triggered = question.encoder.any_of(question.guards(position))
        if not question.ask(triggered):
            return sentence("its rule never applies")
    with Question(index) as question:
        if not question.ask(question.encoder.literal(condition)):
            return sentence("its condition can never be true")
    if len(index.clauses[position]) == 2:
        return sentence("its condition can be true, but never when the rule is triggered")
    earlier = _earlier_in_cascade(index, position, number)
    with Question(index) as question:
        triggered = question.encoder.any_of(question.guards(position))
        if earlier and not question.ask(triggered, *map(question.encoder.literal, (*earlier, condition))):
            return sentence(
                "its condition can be true, but never when the rule is triggered and the conditions of all exceptions "
                "before it are true"
            )
    return sentence(
        "its condition can be true, but whenever the rule is triggered then, the default or another exception applies"
    )


def _earlier_in_cascade(index: RulesetIndex, position: int, number: int) -> list[Formula]:
    """The conditions of the exceptions before this one, in a cascade without nested exceptions; empty otherwise."""
    rule = index.rules[position]
    if index.ruleset.reading != "cascade" or len(rule.hedges) + 1 != len(index.clauses[position]):
        return []
    return [hedge.condition for hedge in rule.hedges[: number - 1] if hedge.condition is not None]


_EXAMPLE_SCALE = "MEASURE RiskLevel: r_low < r_moderate < r_severe\n"

DEAD_RULE = Check(
    "dead-rule",
    "Does every rule apply in some situation?",
    (
        FindingKind(
            "SLEEC201",
            "warning",
            "a rule that never applies",
            "The restriction of the rule (`AND` after `WHEN`) can never be true, or an assumption says that its "
            "trigger never occurs. The rule looks like a protection but protects nobody.",
            "Correct the restriction or the assumption, or remove the rule.",
            "MEASURE UserAge: number\nWHEN UserCalls AND UserAge < 18 AND UserAge > 65 THEN Answer\n",
            "MEASURE UserAge: number\nWHEN UserCalls AND (UserAge < 18 OR UserAge > 65) THEN Answer\n",
        ),
    ),
    _dead_rules,
    scope="every domain",
)

DEAD_HEDGE = Check(
    "dead-hedge",
    "Does every exception apply in some situation?",
    (
        FindingKind(
            "SLEEC202",
            "warning",
            "an exception that never applies",
            "This exception applies in no situation: its condition cannot be true, or another exception of the rule "
            "always applies instead. So its response is never required.",
            "Check its condition first: a bound may be off by one, or an AND should be an OR. If another exception "
            "always applies instead, change their order or the reading, or remove this one.",
            _EXAMPLE_SCALE + "WHEN UserSaysStop THEN RobotStop\n"
            "UNLESS RiskLevel < r_low IN WHICH CASE AskToFinishFirst\n",
            _EXAMPLE_SCALE + "WHEN UserSaysStop THEN RobotStop\n"
            "UNLESS RiskLevel > r_low IN WHICH CASE AskToFinishFirst\n",
        ),
    ),
    _dead_hedges,
    scope="every domain",
)
