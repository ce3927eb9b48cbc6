"""The record of a decision: a comment above the changed rule that says who gives way to whom, and why."""

from __future__ import annotations

from typing import TYPE_CHECKING

from sleec_verify.repairs.edit import OffsetMap, TextEdit, in_order
from sleec_verify.repairs.statement_edits import indent_at, line_break_of, printer_of
from sleec_verify.results.phrases import listed, quoted

if TYPE_CHECKING:
    from datetime import date

    from sleec_runtime.model import Ruleset
    from sleec_verify.repairs.repair import Repair


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
    """The label of a rule. A rule without a label has a number, which changes, so its trigger and guard name it."""
    rule = ruleset.by_label[label]
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
        after = text[edits[0].start :]
        changed = edits[0].start + len(after) - len(after.lstrip())
        spans = (statement.span for statement in repair.repaired.statements)
        at = next((span.start for span in spans if span.start <= changed < span.end), changed)
    start = text.rfind("\n", 0, at) + 1
    if at == len(text) and start < at:  # the last rule was removed with its line break
        return TextEdit(at, at, f"{line_break_of(text)}// {comment}")
    return TextEdit(start, start, f"{indent_at(text, at)}// {comment}{line_break_of(text)}")
