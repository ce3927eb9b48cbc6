"""Removal of rules, exceptions and declarations."""

from __future__ import annotations

from collections.abc import Iterator

from sleec_runtime.model import Constant, Declaration, Measure, Ruleset
from sleec_verify.repairs.clause_names import clause_name
from sleec_verify.repairs.edit import TextEdit
from sleec_verify.repairs.repair import Candidate
from sleec_verify.repairs.statement_edits import removed_rule, without
from sleec_verify.results.finding import Finding
from sleec_verify.results.phrases import quoted

DECLARATION = "remove the declaration of "
"""How the title of the removal of a declaration begins."""


def rules(ruleset: Ruleset, finding: Finding) -> Iterator[Candidate]:
    """Rule removal: without one of the rules of the finding."""
    for label in finding.rules:
        rule = ruleset.by_label[label]
        title = f"remove rule {quoted(label)}"
        if rule.always is not None:  # the text has only the statement of all its rules
            title = f"remove {quoted(' '.join(ruleset.source.text[slice(*rule.span)].split()))}"
        yield Candidate("rule-removal", title, removed_rule(ruleset, rule), label)


def redundant_rule(ruleset: Ruleset, finding: Finding) -> Iterator[Candidate]:
    """Rule removal: without the rule that the finding calls redundant, its first one."""
    yield next(rules(ruleset, finding))


def hedges(ruleset: Ruleset, finding: Finding) -> Iterator[Candidate]:
    """Defeater removal: without an exception of the finding."""
    for label, number in finding.clauses:
        if number:
            rule = ruleset.by_label[label]
            clause = list(rule.clauses())[number]
            title = f"remove {clause_name(ruleset, rule, number)}"
            yield Candidate("defeater-removal", title, without(ruleset, clause.span), label)


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


def _declaration(name: str, edits: tuple[TextEdit, ...]) -> Candidate:
    return Candidate("declaration-removal", f"{DECLARATION}{quoted(name)}", edits)


def without_name(ruleset: Ruleset, declaration: Declaration, at: int) -> tuple[TextEdit, ...]:
    """The text without name number `at` of a declaration."""
    spans = declaration.name_spans
    if len(spans) == 1:
        return without(ruleset, declaration.span)
    if at == 0:
        return (TextEdit(spans[0].start, spans[1].start, ""),)
    return (TextEdit(spans[at - 1].end, spans[at].end, ""),)
