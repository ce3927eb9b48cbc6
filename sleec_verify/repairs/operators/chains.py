"""Repairs of chains of exceptions that readers can misunderstand: the text says which reading applies, or the trigger
says where nothing is due."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from sleec_runtime.model import NO_COMMENTS, READINGS, Clause, Formula, Or, Ruleset
from sleec_verify.encoding.equation import conjunction, disjunction
from sleec_verify.repairs.clause_names import rule_name
from sleec_verify.repairs.edit import TextEdit, joined
from sleec_verify.repairs.operators.conditions import conjuncts, negation
from sleec_verify.repairs.repair import Candidate
from sleec_verify.repairs.statement_edits import formula_text, line_break_of, strengthened, with_condition, without
from sleec_verify.results.finding import Finding
from sleec_verify.wording.phrases import exception, listed, quoted
from sleec_verify.wording.sentence import sentence


def readings(ruleset: Ruleset, finding: Finding) -> Iterator[Candidate]:
    """Structured English states the reading. The DSL cannot, so the conditions of each exception include others."""
    if ruleset.syntax == "dsl":
        yield from _independent_of_reading(ruleset, finding)
        return
    for reading in sorted(READINGS, key=lambda one: one != ruleset.reading):
        text = f"READING {reading}"
        edit = TextEdit(0, 0, f"{text}{line_break_of(ruleset.source.text) * 2}")
        yield Candidate("canonical-form", sentence("write {text} at the top", text=quoted(text)), (edit,))


def _independent_of_reading(ruleset: Ruleset, finding: Finding) -> Iterator[Candidate]:
    """Exceptions for which both readings agree: with the conditions of all later ones they mean priority, with those of
    all earlier ones cascade."""
    rule = ruleset.by_label[finding.rules[0]]
    conditions = [hedge.condition for hedge in rule.hedges if hedge.condition is not None]
    if not conditions:  # the exceptions are those of a clause
        return
    wider = [_any(conditions[number:]) for number in range(len(conditions))]
    narrower = [_all(conditions[: number + 1]) for number in range(len(conditions))]
    for reading, others in (("priority", wider), ("cascade", narrower)):
        edits: list[TextEdit] = []
        written = []
        for number, hedge in enumerate(rule.hedges):
            if number and _are_alike(rule.hedges[number - 1], hedge):
                edits += without(ruleset, hedge.span)
                continue
            text = formula_text(ruleset, others[number])
            written.append(quoted(f"unless {text}"))
            if text != formula_text(ruleset, conditions[number]):
                edits += with_condition(ruleset, hedge, others[number])
        title = sentence(
            "rewrite the exceptions of {rule} for the reading {reading}: {written}",
            rule=rule_name(ruleset, rule),
            reading=reading,
            written=listed(written),
        )
        yield Candidate("canonical-form", title, tuple(edits))


def _are_alike(one: Clause, other: Clause) -> bool:
    """Whether one exception is enough for both, which follow each other. The comments of one would have no place."""
    return one.obligations == other.obligations and not (one.hedges or other.hedges) and other.comments == NO_COMMENTS


def _any(conditions: Sequence[Formula]) -> Formula:
    parts = (part for one in conditions for part in (one.operands if isinstance(one, Or) else (one,)))
    return disjunction(list(dict.fromkeys(parts)))


def _all(conditions: Sequence[Formula]) -> Formula:
    return conjunction(list(dict.fromkeys(part for one in conditions for part in conjuncts(one))))


def silences(ruleset: Ruleset, finding: Finding) -> Iterator[Candidate]:
    """The last exceptions say nothing: the rule does not apply where one of them does."""
    for label, number in finding.clauses:
        rule = ruleset.by_label[label]
        empty = list(rule.clauses())[number]
        at = next((at for at, hedge in enumerate(rule.hedges) if hedge is empty), None)
        if at is None or (at and ruleset.reading == "cascade"):
            continue
        last = rule.hedges[at:]
        # The comments of an exception would have no place.
        if any(hedge.obligations or hedge.hedges or hedge.comments != NO_COMMENTS for hedge in last):
            continue
        excluded = conjunction([negation(hedge.condition) for hedge in last if hedge.condition is not None])
        edits = [edit for hedge in last for edit in without(ruleset, hedge.span)]
        replaced = sentence(
            "{exceptions} of {rule}", exceptions=listed(map(exception, last)), rule=rule_name(ruleset, rule)
        )
        title = sentence(
            "replace {exceptions} with a condition at its trigger: {condition}",
            exceptions=replaced,
            condition=quoted(formula_text(ruleset, excluded)),
        )
        yield Candidate("canonical-form", title, joined((*strengthened(ruleset, rule, excluded), *edits)))
