"""Removal of rules, exceptions and declarations."""

from __future__ import annotations

from collections.abc import Iterator

from sleec_runtime.model import Declaration, Rule, Ruleset
from sleec_verify.repairs.edit import TextEdit
from sleec_verify.repairs.repair import Candidate
from sleec_verify.repairs.statement_edits import removed_rule, without
from sleec_verify.results.finding import Finding
from sleec_verify.results.phrases import clause_name, quoted


def rules(ruleset: Ruleset, finding: Finding) -> Iterator[Candidate]:
    """Rule removal: without one of the rules of the finding."""
    for label in finding.rules:
        rule = ruleset.by_label[label]
        yield Candidate("rule-removal", f"remove rule {quoted(label)}", removed_rule(ruleset, rule))


def hedges(ruleset: Ruleset, finding: Finding) -> Iterator[Candidate]:
    """Defeater removal: without an exception of the finding."""
    for label, number in finding.clauses:
        if number:
            rule = ruleset.by_label[label]
            clause = list(rule.clauses())[number]
            title = f"remove {clause_name(rule, number)}"
            yield Candidate("defeater-removal", title, without(ruleset, clause.span))


def declarations(ruleset: Ruleset, finding: Finding) -> Iterator[Candidate]:
    """Without the declaration of an unused name."""
    for statement in ruleset.statements:
        if isinstance(statement, Rule) or not statement.span.start <= finding.span.start < statement.span.end:
            continue
        if isinstance(statement, Declaration) and len(statement.names) > 1:
            spans = statement.name_spans
            at = spans.index(finding.span)
            edit = (
                TextEdit(spans[at].start, spans[at + 1].start, "")
                if at == 0
                else TextEdit(spans[at - 1].end, spans[at].end, "")
            )
            yield Candidate("declaration-removal", f"remove {quoted(statement.names[at])}", (edit,))
        else:
            yield Candidate("declaration-removal", "remove the declaration", without(ruleset, statement.span))
