"""Conditions that are true in every situation, or false in every situation."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, NamedTuple

from sleec_runtime.model import (
    And,
    Atom,
    Calculation,
    Clause,
    Comparison,
    Formula,
    MeasureRef,
    Not,
    Or,
    Reading,
    Ruleset,
    ScaleValue,
    Truth,
    measures_of,
)
from sleec_verify.checks.base import Check, FindingKind
from sleec_verify.checks.questions import ask_each
from sleec_verify.query.question import Question
from sleec_verify.query.ruleset_index import RulesetIndex
from sleec_verify.results.finding import Finding
from sleec_verify.wording.sentence import sentence

if TYPE_CHECKING:
    from sleec_runtime.model import Claim


class _Place(NamedTuple):
    """A whole condition, the labels of its rule, and advice if it is always true or always false. `if_false` is None
    where another check reports an always-false condition."""

    condition: Formula
    labels: tuple[str, ...]
    if_true: str
    if_false: str | None = None


def _constant(index: RulesetIndex) -> Iterator[Finding]:
    """For each part of a condition: unsatisfiable exactly if it is always false, or its negation exactly if it is
    always true. A model is a situation in which it is not."""
    changing: set[Formula] = set()
    source = index.ruleset.source
    places = (
        (sentence("line {line}", line=source.place(place.condition.span).line), place)
        for place in _places(index.ruleset)
    )
    yield from ask_each(places, lambda place: _in_condition(index, place, changing))


def _in_condition(index: RulesetIndex, place: _Place, changing: set[Formula]) -> Iterator[Finding]:
    """The smallest parts of a condition that are constant. `changing` collects the conditions that have none."""
    condition = place.condition
    if not _may_be_constant(condition) or condition in changing:
        return
    parts = list(_parts(condition))
    always = _always(index, parts)
    if place.if_false is None and always[-1] is False:
        # The whole condition of a guard or hedge: the finding about the dead rule or hedge says so already.
        return
    constant = {id(part): value for part, value in zip(parts, always) if value is not None}
    around = {id(operand): part for part in parts for operand in _operands(part)}
    for part in parts:
        if id(part) not in constant or any(id(inner) in constant for inner in _operands(part)):
            continue
        if _is_defect(part, index.ruleset):
            continue
        what = sentence("this condition") if part is condition else sentence("this part of the condition")
        whole, value = _with_it(part, constant[id(part)], around)
        yield CONSTANT_CONDITION.finding(
            sentence("{what} is always {value}", what=what, value=_word(constant[id(part)])),
            part.span,
            rules=place.labels,
            help=_advice(place, part, whole, value, dsl=index.ruleset.syntax == "dsl"),
            related=((whole.span, sentence("so this whole part is always {value}", value=_word(value))),)
            if whole is not part
            else (),
        )
    if not constant:
        changing.add(condition)


def _with_it(part: Formula, value: bool, around: dict[int, Formula]) -> tuple[Formula, bool]:
    """The smallest formula around a part that is always `value`, or the part itself, that can be removed without a
    change of meaning, and the constant value of that formula; the whole condition if there is none. A true operand
    can be removed from AND, and a false one from OR. Other operands make the whole formula constant."""
    while id(part) in around:
        outer = around[id(part)]
        if isinstance(outer, And if value else Or):
            break
        part, value = outer, value != isinstance(outer, Not)
    return part, value


def _word(value: bool) -> str:
    return sentence("true") if value else sentence("false")


def _advice(place: _Place, part: Formula, whole: Formula, value: bool, dsl: bool) -> str:
    if whole is place.condition:
        advice = place.if_true if value else place.if_false
        assert advice is not None, "that it is never true is said by other checks"
        return advice
    if whole is part:
        return sentence("correct it, or remove it")
    name = "NOT" if isinstance(whole, Not) else "AND" if isinstance(whole, And) else "OR"
    return sentence(
        "correct it, or remove the whole {operator}, which is always {value}",
        operator=name.lower() if dsl else name,
        value=_word(value),
    )


def _places(ruleset: Ruleset) -> Iterator[_Place]:
    """All conditions of rules, concerns, purposes and relations, with what to do about them."""
    for rule in ruleset.rules:
        labels = (rule.label,)
        if rule.guard is not None:
            yield _Place(
                rule.guard,
                labels,
                sentence(
                    "correct it, or remove the whole condition after the trigger: the rule means the same without it"
                ),
            )
        yield from _in_clause(rule.default, ruleset.reading, labels)
        yield from _in_chain(rule.hedges, ruleset.reading, labels, sentence("the default response"))
    if ruleset.is_timed:
        yield from _beside_rules(ruleset)


def _beside_rules(ruleset: Ruleset) -> Iterator[_Place]:
    from sleec_runtime.model import RELATIONS, Claim
    from sleec_verify.encoding.relations import formulas_of_relation

    for statement in ruleset.statements:
        if isinstance(statement, Claim):
            yield from _in_claim(statement, ruleset.reading)
        elif isinstance(statement, RELATIONS):
            advice = sentence("correct it, or check whether you need the relation")
            yield from (_Place(formula, (), advice, advice) for formula in formulas_of_relation(statement))


def _in_claim(claim: Claim, reading: Reading) -> Iterator[_Place]:
    if claim.condition is not None:
        words = sentence("the concern") if claim.kind == "concern" else sentence("the purpose")
        yield _Place(
            claim.condition,
            (),
            sentence("correct it, or remove the whole condition: {claim} means the same without it", claim=words),
            sentence("correct it: at present, {claim} can never happen", claim=words),
        )
    for response in claim.responses:
        yield from _in_clause(response, reading, ())
    if claim.meanwhile is not None:
        yield from _in_claim(claim.meanwhile, reading)


def _in_clause(clause: Clause, reading: Reading, labels: tuple[str, ...]) -> Iterator[_Place]:
    """The conditions in the chain that is nested in a clause, and in the alternatives of its responses."""
    yield from _in_chain(clause.hedges, reading, labels, sentence("the response before the first UNLESS"))
    for obligation in clause.obligations:
        for alternative in obligation.timing.alternatives() if obligation.timing is not None else ():
            yield from _in_clause(alternative, reading, labels)


def _in_chain(hedges: Sequence[Clause], reading: Reading, labels: tuple[str, ...], first: str) -> Iterator[_Place]:
    """The conditions of a chain of hedges. `first` decides if none of them does."""
    for position, hedge in enumerate(hedges):
        if hedge.condition is not None:
            if_false = None
            if not labels:
                # The cascade stops at it, so no later hedge decides.
                later = reading == "cascade" and position + 1 < len(hedges)
                if_false = (
                    sentence("correct it, or remove the exception and those after it")
                    if later
                    else sentence("correct it, or remove the exception")
                )
            yield _Place(hedge.condition, labels, _always_holds(hedges, position, reading, first), if_false)
        yield from _in_clause(hedge, reading, labels)


def _always_holds(hedges: Sequence[Clause], position: int, reading: Reading, first: str) -> str:
    """Advice for a hedge whose condition is always true. Removing the hedge would change the meaning: another clause
    would decide."""
    alone = position == 0 or reading == "priority"
    last = position + 1 == len(hedges)
    instead = first if alone else sentence("that of the exception before it")
    if position == 0:
        never, gone = sentence("{first} never applies", first=first), sentence("the exception")
    elif reading == "cascade":
        never, gone = sentence("the exception before it never applies"), sentence("this exception")
    else:
        never, gone = (
            sentence("neither {first} nor an exception before it ever applies", first=first),
            sentence("the exception and those before it"),
        )
    holds = (
        sentence("the exception always applies")
        if alone and last
        else sentence("the condition of the exception is always true")
    )
    said = sentence("correct it: at present, {holds}, so {never}", holds=holds, never=never)
    if not hedges[position].obligations:
        return said
    return sentence(
        "{said}; if you mean that, replace {instead} by its response, and remove {gone}",
        said=said,
        instead=instead,
        gone=gone,
    )


def _parts(formula: Formula) -> Iterator[Formula]:
    """A formula and the formulas in it, the inner ones first."""
    for operand in _operands(formula):
        yield from _parts(operand)
    yield formula


def _operands(formula: Formula) -> tuple[Formula, ...]:
    if isinstance(formula, Not):
        return (formula.operand,)
    return formula.operands if isinstance(formula, (And, Or)) else ()


def _always(index: RulesetIndex, parts: Sequence[Formula]) -> list[bool | None]:
    """The constant value of each formula without assumptions; None if it has both values."""
    with Question(index, assuming=False) as question:
        literals = [question.encoder.literal(part) for part in parts]
        possible: set[int] = set()
        for literal in (sign * literal for literal in literals for sign in (1, -1)):
            # One model shows possible values of many parts.
            if literal not in possible and question.ask(literal):
                possible.update(one if question.true(one) else -one for one in literals)
    return [None if {literal, -literal} <= possible else literal in possible for literal in literals]


def _may_be_constant(formula: Formula) -> bool:
    """False only if no part of the formula is constant: each name occurs once in it, and a number that is not
    calculated can be on either side of any other. Most conditions are like this, and need no solver."""
    seen: set[str] = set()
    for part in _parts(formula):
        names: tuple[str, ...] = ()
        if isinstance(part, Atom):
            names = (part.name,)
        elif isinstance(part, Comparison):
            if isinstance(part.left, (Calculation, ScaleValue)) or isinstance(part.right, ScaleValue):
                return True
            names = measures_of(part)
        elif isinstance(part, Truth):
            return True
        for name in names:
            if name in seen:
                return True
            seen.add(name)
    return False


def _is_defect(part: Formula, ruleset: Ruleset) -> bool:
    """Whether it is constant because it compares a scale with a value outside the scale, which is reported
    separately."""
    if not isinstance(part, Comparison):
        return False
    measure, value = (part.left, part.right) if isinstance(part.left, MeasureRef) else (part.right, part.left)
    if not isinstance(measure, MeasureRef) or not isinstance(value, ScaleValue):
        return False
    return not 0 <= value.rank < len(ruleset.measures[measure.name].values)


CONSTANT_CONDITION = Check(
    "constant-condition",
    "Does every part of a condition depend on the situation?",
    (
        FindingKind(
            "SLEEC512",
            "warning",
            "a condition, or a part of one, that never changes",
            "This part of a condition is true in every situation, or false in every situation, so it has no effect. "
            "Often a bound is off by one, or AND and OR are mixed up. If the whole condition of a rule or an exception "
            "is never true, `dead-rule` or `dead-hedge` reports it instead.",
            "Compare the bounds with what you want to say, and check whether AND should be OR. If the condition is "
            "correct, simplify it. Remove a part of an AND that is always true, and a part of an OR that is always "
            "false. If a part of an AND is always false, remove the whole AND. If a part of an OR is always true, "
            "remove the whole OR. If the condition of an exception is always true, the response before it never "
            "applies: replace that response by the one of the exception, and remove the exception.",
            "MEASURE Heat: number\nWHEN UserCalls THEN Answer\nUNLESS Heat > 30 OR Heat < 40 IN WHICH CASE Cool\n",
            "MEASURE Heat: number\nWHEN UserCalls THEN Answer\nUNLESS Heat > 40 OR Heat < 0 IN WHICH CASE Cool\n",
        ),
    ),
    _constant,
    scope="text",
)
