"""The obligations in a situation, and the clauses and conditions that decide."""

from __future__ import annotations

from collections.abc import Mapping

from sleec_runtime.model import READINGS, Context, Reading, Ruleset
from sleec_verify.conformance.cases.fields import values_of
from sleec_verify.entailment.answer import ActiveClause, Alternative, DueLiteral, Entailment
from sleec_verify.entailment.explanation import explain
from sleec_verify.entailment.situation_text import parse_situation
from sleec_verify.entailment.triggered_part import triggered_part
from sleec_verify.report.explanation import result_line
from sleec_verify.report.palette import PLAIN
from sleec_verify.results.json_values import Json
from sleec_verify.serve.analysis import finding_of_page
from sleec_verify.serve.answers.reasons import decided_steps, guarded_steps
from sleec_verify.serve.answers.remarks import remarks
from sleec_verify.serve.body import BadRequest, Body
from sleec_verify.serve.session import Session
from sleec_verify.wording.phrases import listed, quoted
from sleec_verify.wording.sentence import sentence


def situation(session: Session, body: Body) -> dict[str, Json]:
    """What the rules require in a situation, with the clause that decides in each rule and the reasons. Instead of the
    text, a request may have the digest `of` a text that was checked before."""
    digest = body.text_or_none("of")
    whole = session.ruleset(body.text("text")) if digest is None else session.known_ruleset(digest)
    # The switches are those of all domains.
    context = context_of(whole, body.texts("triggers"), body.values("conditions"))
    ruleset = scoped(whole, body)
    answer = explain(triggered_part(ruleset, context.triggers), context)
    steps = [_rule(ruleset, context, because) for because in answer.because]
    return {
        "obligations": list(answer.obligations),
        "prohibitions": list(answer.prohibitions),
        "consistent": answer.consistent,
        "alternatives": [_alternative(one) for one in answer.alternatives],
        "rules": steps + _inactive(ruleset, context, answer),
        "conflicts": [finding_of_page(finding) for finding in answer.conflicts],
        "sentence": result_line(answer, PLAIN),
        "notes": [*remarks(ruleset, context, answer)],
    }


def _alternative(alternative: Alternative) -> str:
    """```ring` within 5 minutes, or else `knock```"""
    first, *others = (
        listed([quoted(_literal(one)) for one in option]) if option else sentence("nothing")
        for option in alternative.options
    )
    for other in others:
        first = sentence("{response}, or else {other}", response=first, other=other)
    return first


def _literal(literal: DueLiteral) -> str:
    """``NOT ring within 5 minutes``"""
    name = f"NOT {literal.name}" if literal.negated else literal.name
    return f"{name} {literal.when}".rstrip()


def scoped(ruleset: Ruleset, body: Body) -> Ruleset:
    """The rules of the domain, in the reading that the request asks for. Raises `BadRequest` for unknown ones."""
    reading, domain = body.text_or_none("reading"), body.text_or_none("domain")
    if reading is not None:
        ruleset = ruleset.read_as(_reading(reading))
    if domain is None:
        return ruleset
    if domain not in ruleset.domains:
        raise BadRequest("the rules have no domain of this name")
    return ruleset.in_domain(domain)


def _reading(name: str) -> Reading:
    for reading in READINGS:
        if reading == name:
            return reading
    raise BadRequest(f"a reading is {' or '.join(READINGS)}")


def context_of(ruleset: Ruleset, triggers: tuple[str, ...], values: Mapping[str, object]) -> Context:
    """The situation of the switches. Raises `SituationError` for a name or value that does not fit the rules."""
    return Context(parse_situation(ruleset, ",".join(triggers), "").triggers, values_of(values, ruleset))


def _rule(ruleset: Ruleset, context: Context, because: ActiveClause) -> Json:
    return {
        "label": because.rule,
        "clause": because.clause,
        "layer": because.layer,
        "obligations": list(because.in_words()),
        "start": because.span.start,
        "end": because.span.end,
        "steps": [*decided_steps(ruleset, context, because)],
    }


def _inactive(ruleset: Ruleset, context: Context, answer: Entailment) -> list[Json]:
    """The rules whose trigger occurs, and whose guard is false."""
    active = {because.rule for because in answer.because}
    return [
        {
            "label": rule.label,
            "clause": None,
            "layer": None,
            "obligations": [],
            "start": rule.span.start,
            "end": rule.span.end,
            "steps": [*guarded_steps(ruleset, context, rule, rule.guard)],
        }
        for rule in ruleset.rules
        if rule.trigger in context.triggers and rule.label not in active and rule.guard is not None
    ]
