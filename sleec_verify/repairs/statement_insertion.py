"""Insertion of new statements, in the language and the layout of the text."""

from __future__ import annotations

import re

from sleec_runtime.errors import Unsayable
from sleec_runtime.model import RELATIONS, Clause, Formula, Obligation, Rule, Ruleset
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
    return _inserted(end, between + line_break.join(indent + line for line in lines))


def with_relation(ruleset: Ruleset, relation: str) -> tuple[TextEdit, ...]:
    """The text in the DSL with a relation after the last one, or in a block of its own after the rules."""
    text = ruleset.source.text
    line_break = line_break_of(text)
    relations = [statement for statement in ruleset.statements if isinstance(statement, RELATIONS)]
    if relations:
        last = relations[-1].span
        return _inserted(end_of_line(text, last.end), f"{line_break}{indent_at(text, last.start)}{relation}")
    rule = ruleset.rules[-1].span
    closing = re.compile(r"^[ \t]*rule_end\b", re.MULTILINE).search(text, rule.end)
    if closing is None:
        raise Unsayable("the relation has no place", "write rule_end on a line of its own")
    lines = ("", "", "relation_start", f"{indent_at(text, rule.start)}{relation}", "relation_end")
    return _inserted(end_of_line(text, closing.end()), line_break.join(lines))


def _inserted(offset: int, text: str) -> tuple[TextEdit, ...]:
    return (TextEdit(offset, offset, text),)


def new_label(ruleset: Ruleset, stem: str) -> str:
    """A label that no statement has: `stem`, or `stem` with a number."""
    taken = {getattr(statement, "label", None) for statement in ruleset.statements}
    number = 1
    label = stem
    while label in taken:
        number += 1
        label = f"{stem}_{number}"
    return label
