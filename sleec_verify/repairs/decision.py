"""The record of a decision: a comment above the changed rule that says who gives way to whom, and why."""

from __future__ import annotations

from typing import TYPE_CHECKING

from sleec_verify.repairs.clause_names import always_statement
from sleec_verify.repairs.comments import comment_around
from sleec_verify.repairs.edit import OffsetMap, TextEdit, in_order
from sleec_verify.repairs.statement_edits import indent_at, line_break_of, printer_of
from sleec_verify.wording.phrases import listed, quoted

if TYPE_CHECKING:
    from datetime import date

    from sleec_runtime.model import Ruleset
    from sleec_verify.repairs.repair import Candidate, Repair


def decision(ruleset: Ruleset, repair: Repair, day: date, reason: str) -> str:
    """``decision 2026-11-23: `air` gives way to `privacy`: the reason``, in one line. `ruleset` is that before the
    repair."""
    candidate = repair.candidate
    said = candidate.title
    if candidate.gives_way is not None:
        others = [_name(ruleset, label) for label in repair.finding.rules if label != candidate.gives_way]
        removed = " and is removed" if candidate.operator == "rule-removal" else ""
        said = f"{_name(ruleset, candidate.gives_way)} gives way to {listed(others)}{removed}" if others else said
    why = " ".join("".join(c if c.isprintable() else " " for c in reason).split())
    return f"decision {day.isoformat()}: {said}{f': {why}' if why else ''}"


def _name(ruleset: Ruleset, label: str) -> str:
    """The label of a rule. A rule without a label has a number, which changes, so its text names it."""
    rule = ruleset.by_label[label]
    if rule.always is not None:
        return always_statement(ruleset, rule)
    if rule.labelled:
        return quoted(label)
    guard = "" if rule.guard is None else printer_of(ruleset).formulas.guard(rule.guard)
    return quoted(f"WHEN {rule.trigger}{guard}")


def comment_edit(ruleset: Ruleset, repair: Repair, comment: str) -> TextEdit:
    """The edit of the repaired text that writes a comment above the changed statement, or where a removed rule was.

    `ruleset` is that before the repair.
    """
    text = repair.repaired.source.text
    edits = in_order(repair.candidate.edits)
    at = None
    if repair.candidate.gives_way is not None:
        at = OffsetMap(edits).after(ruleset.by_label[repair.candidate.gives_way].span.start)
    if at is None:
        start = _changed_at(ruleset, repair.candidate, edits)
        after = text[start:]
        changed = start + len(after) - len(after.lstrip())
        spans = (statement.span for statement in repair.repaired.statements)
        at = next((span.start for span in spans if span.start <= changed < span.end), changed)
    start = text.rfind("\n", 0, at) + 1
    comment_start = comment_around(text, start, ruleset.syntax)
    if comment_start is not None:  # the line begins inside a comment
        start = at = text.rfind("\n", 0, comment_start) + 1
    if at == len(text) and start < at:  # the last rule was removed with its line break
        return TextEdit(at, at, f"{line_break_of(text)}// {comment}")
    return TextEdit(start, start, f"{indent_at(text, at)}// {comment}{line_break_of(text)}")


def _changed_at(ruleset: Ruleset, candidate: Candidate, edits: list[TextEdit]) -> int:
    """Where the edit that removes the rule that gives way is in the edited text; otherwise, where the first one is."""
    place = edits[0].start if candidate.gives_way is None else ruleset.by_label[candidate.gives_way].span.start
    shift = 0
    for start, end, new in edits:
        if start <= place < end:
            return start + shift
        shift += len(new) - (end - start)
    return edits[0].start
