"""Insertion of new statements, in the language and the layout of the text."""

from __future__ import annotations

from sleec_runtime.model import Clause, Formula, Obligation, Rule, Ruleset
from sleec_verify.repairs.edit import TextEdit
from sleec_verify.repairs.statement_edits import as_read, end_of_line, indent_at, line_break_of, printer_of


def rule_text(ruleset: Ruleset, label: str, trigger: str, guard: Formula | None, response: Obligation) -> list[str]:
    """The lines of a rule without hedges. Raises `Unsayable` if the language has no such response."""
    printer = printer_of(ruleset)
    is_dsl = ruleset.syntax == "dsl"
    printer.begin()
    when, then = printer.keyword("when"), printer.keyword("then")
    guarded = printer.formulas.guard(None if guard is None else as_read(ruleset, guard))
    printer.write(f"{f'{label} ' if is_dsl else ''}{when} {trigger}{guarded} {then} ")
    printer.response(Clause(None, (response,)))
    lines = printer.take_lines()
    return lines if is_dsl else [f"RULE {label}", *lines]


def with_rule_after(ruleset: Ruleset, last: Rule, lines: list[str]) -> tuple[TextEdit, ...]:
    """The text with these lines of a rule after another rule, with its indentation, and an empty line between them
    in structured English."""
    text = ruleset.source.text
    end = end_of_line(text, last.span.end)
    line_break = line_break_of(text)
    between = line_break * (1 if ruleset.syntax == "dsl" else 2)
    indent = indent_at(text, last.span.start)
    return (TextEdit(end, end, between + line_break.join(indent + line for line in lines)),)


def new_label(ruleset: Ruleset, stem: str) -> str:
    """A label that no statement has: `stem`, or `stem` with a number."""
    taken = {getattr(statement, "label", None) for statement in ruleset.statements}
    number = 1
    label = stem
    while label in taken:
        number += 1
        label = f"{stem}_{number}"
    return label
