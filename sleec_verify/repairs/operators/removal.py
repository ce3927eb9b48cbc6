"""Removal of rules, exceptions and declarations."""

from __future__ import annotations

from collections.abc import Iterator

from sleec_runtime.model import Claim, Constant, Declaration, Measure, Ruleset
from sleec_verify.repairs.clause_names import clause_name
from sleec_verify.repairs.edit import TextEdit
from sleec_verify.repairs.repair import Candidate
from sleec_verify.repairs.statement_edits import without
from sleec_verify.results.finding import Finding
from sleec_verify.wording.phrases import quoted
from sleec_verify.wording.sentence import sentence

DECLARATION = "remove the declaration of "
"""How the title of the removal of a declaration begins."""


def rules(ruleset: Ruleset, finding: Finding) -> Iterator[Candidate]:
    """Rule removal: without one of the rules of the finding."""
    for label in finding.rules:
        rule = ruleset.by_label[label]
        title = sentence("remove rule {rule}", rule=quoted(label))
        if rule.always is not None:  # the text has only the statement of all its rules
            title = sentence("remove {text}", text=quoted(ruleset.source.in_one_line(rule.span)))
        yield Candidate("rule-removal", title, without(ruleset, rule.span), label)


def redundant_rule(ruleset: Ruleset, finding: Finding) -> Iterator[Candidate]:
    """Rule removal: without the rule that the finding calls redundant, its first one."""
    yield next(rules(ruleset, finding))


def hedges(ruleset: Ruleset, finding: Finding) -> Iterator[Candidate]:
    """Defeater removal: without an exception of the finding."""
    for label, number in finding.clauses:
        if number:
            rule = ruleset.by_label[label]
            clause = list(rule.clauses())[number]
            title = sentence("remove {clause}", clause=clause_name(ruleset, rule, number))
            yield Candidate("defeater-removal", title, without(ruleset, clause.span), label)


def without_claim(ruleset: Ruleset, claim: Claim) -> Candidate:
    """Without a concern or purpose."""
    label = quoted(claim.label)
    is_concern = claim.kind == "concern"
    title = (
        sentence("remove the concern {claim}", claim=label)
        if is_concern
        else sentence("remove the purpose {claim}", claim=label)
    )
    return Candidate("claim-removal", title, without(ruleset, claim.span))


def declarations(ruleset: Ruleset, finding: Finding) -> Iterator[Candidate]:
    """Without the declaration of an unused name."""
    for statement in ruleset.statements:
        if not statement.span.start <= finding.span.start < statement.span.end:
            continue
        if isinstance(statement, (Measure, Constant)):
            yield _declaration(statement.name, without(ruleset, statement.span))
        elif isinstance(statement, Declaration):
            at = statement.name_spans.index(finding.span)
            yield _declaration(statement.names[at], without_name(ruleset, statement, at))


def declaration_removal(name: str) -> str:
    """The title of the removal of a declaration, which begins with `DECLARATION`. `name` is quoted."""
    return sentence("remove the declaration of {name}", name=name)


def _declaration(name: str, edits: tuple[TextEdit, ...]) -> Candidate:
    return Candidate("declaration-removal", declaration_removal(quoted(name)), edits)


def without_name(ruleset: Ruleset, declaration: Declaration, at: int) -> tuple[TextEdit, ...]:
    """The text without name number `at` of a declaration."""
    spans = declaration.name_spans
    if len(spans) == 1:
        return without(ruleset, declaration.span)
    if at == 0:
        return (TextEdit(spans[0].start, spans[1].start, ""),)
    return (TextEdit(spans[at - 1].end, spans[at].end, ""),)
