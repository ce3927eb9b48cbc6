"""Corrections of single words: the text says what it is read as, or names what exists."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from sleec_runtime.model import (
    Claim,
    Comparison,
    Formula,
    MeasureRef,
    Rule,
    Ruleset,
    ScaleValue,
    Span,
    claims,
    formulas_of,
    leaves,
    literals,
)
from sleec_runtime.support.suggestions import nearest
from sleec_verify.encoding.name_uses import events_of_rules, formulas_beside_rules
from sleec_verify.repairs.edit import TextEdit
from sleec_verify.repairs.operators.removal import without_claim
from sleec_verify.repairs.repair import Candidate
from sleec_verify.repairs.statement_edits import indent_at, replaced, without
from sleec_verify.repairs.statement_insertion import new_label
from sleec_verify.results.finding import Finding
from sleec_verify.wording.phrases import quoted
from sleec_verify.wording.sentence import sentence


def labels(ruleset: Ruleset, finding: Finding) -> Iterator[Candidate]:
    """A repeated label gets a number."""
    for statement in ruleset.statements:
        if isinstance(statement, (Rule, Claim)) and statement.label_span == finding.span:
            stem = ruleset.source.text[slice(*finding.span)]
            label = new_label(ruleset, stem)
            edit = TextEdit(finding.span.end, finding.span.end, label[len(stem) :])
            yield Candidate(
                "renaming",
                sentence("rename the second {stem} to {label}", stem=quoted(stem), label=quoted(label)),
                (edit,),
            )


def values(ruleset: Ruleset, finding: Finding) -> Iterator[Candidate]:
    """A foreign value, or a number, is the value of the scale as which it is read."""
    formulas: list[Formula] = [formula for rule in ruleset.rules for formula in formulas_of(rule)]
    for formula in (*formulas, *formulas_beside_rules(ruleset)):
        for leaf in leaves(formula):
            if isinstance(leaf, Comparison) and leaf.span.start <= finding.span.start < leaf.span.end:
                meant = _value(ruleset, leaf)
                if meant is not None:
                    written = ruleset.source.text[slice(*finding.span)]
                    title = sentence("replace {written} with {meant}", written=quoted(written), meant=quoted(meant))
                    yield Candidate("correction", title, replaced(finding.span, meant))
                    return


def _value(ruleset: Ruleset, comparison: Comparison) -> str | None:
    sides = (comparison.left, comparison.right)
    for measure, value in (sides, sides[::-1]):
        if isinstance(measure, MeasureRef) and isinstance(value, ScaleValue):
            scale = ruleset.measures[measure.name].values
            return scale[value.rank] if 0 <= value.rank < len(scale) else None
    return None


def events(ruleset: Ruleset, finding: Finding) -> Iterator[Candidate]:
    """A claim names an event of a rule instead of one that no rule mentions; or a purpose is removed, which is always
    possible then."""
    yield from _nearest(ruleset, finding.span, events_of_rules(ruleset))
    yield from (without_claim(ruleset, one) for one in claims(ruleset, "purpose") if one.label in finding.obligations)


def constrained(ruleset: Ruleset, finding: Finding) -> Iterator[Candidate]:
    """A constraint names an obligation of a rule instead of one that no rule has."""
    required = {one.name for rule in ruleset.rules for clause in rule.clauses() for one in literals(clause)}
    yield from _nearest(ruleset, finding.span, required)


def _nearest(ruleset: Ruleset, place: Span, names: Iterable[str]) -> Iterator[Candidate]:
    """The most similar of these names, if one is similar to the name at this place."""
    written = ruleset.source.text[slice(*place)]
    meant = nearest(written, sorted(names))
    if meant is not None:
        yield Candidate(
            "renaming",
            sentence("replace {written} with {meant}", written=quoted(written), meant=quoted(meant)),
            replaced(place, meant),
        )


def definitions(ruleset: Ruleset, finding: Finding) -> Iterator[Candidate]:
    """The second definition of a name is removed, if it has a line of its own."""
    text = ruleset.source.text
    start = text.rfind("\n", 0, finding.span.start) + 1
    end = text.find("\n", finding.span.end)
    line = Span(start + len(indent_at(text, finding.span.start)), len(text) if end < 0 else end)
    written = quoted(text[slice(*finding.span)])
    yield Candidate(
        "declaration-removal",
        sentence("remove the second definition of {written}", written=written),
        without(ruleset, line),
    )


def windows(ruleset: Ruleset, finding: Finding) -> Iterator[Candidate]:
    """A window without length is removed, because a response without a window is due at the same instant."""
    text = ruleset.source.text
    if finding.obligations:  # otherwise it is the time of a relation
        start = len(text[: finding.span.start].rstrip())
        title = sentence("remove {text}", text=quoted(text[slice(*finding.span)]))
        yield Candidate("canonical-form", title, (TextEdit(start, finding.span.end, ""),))
