"""Edits of rules and their parts, in the language and the layout of the text."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace

from sleec_runtime.language.common.formula_printer import FormulaPrinter
from sleec_runtime.language.common.statement_printer import StatementPrinter
from sleec_runtime.language.dsl.statement_printer import DslPrinter
from sleec_runtime.language.english.statement_printer import EnglishPrinter
from sleec_runtime.model import (
    And,
    Clause,
    Comparison,
    Formula,
    MeasureRef,
    Not,
    Obligation,
    Or,
    Rule,
    Ruleset,
    ScaleValue,
    Span,
)
from sleec_verify.repairs.comments import blanked
from sleec_verify.repairs.edit import TextEdit


def printer_of(ruleset: Ruleset) -> StatementPrinter:
    """A printer for statements in the language of a ruleset."""
    if ruleset.syntax == "dsl":
        return DslPrinter(ruleset.dialect or "legos")
    return EnglishPrinter(has_comments=False)


def formula_text(ruleset: Ruleset, formula: Formula) -> str:
    """A formula in the language of a ruleset."""
    return _formulas(ruleset).formula(as_read(ruleset, formula))


def as_read(ruleset: Ruleset, formula: Formula) -> Formula:
    """A formula in which every value of a scale has the name that it has in that scale. A copy of a foreign value
    would be another defect."""
    if isinstance(formula, Not):
        return Not(as_read(ruleset, formula.operand))
    if isinstance(formula, (And, Or)):
        return type(formula)(tuple(as_read(ruleset, operand) for operand in formula.operands))
    if not isinstance(formula, Comparison):
        return formula
    left, right = formula.left, formula.right
    if isinstance(left, MeasureRef) and isinstance(right, ScaleValue):
        return replace(formula, right=_own_value(ruleset, left, right))
    if isinstance(right, MeasureRef) and isinstance(left, ScaleValue):
        return replace(formula, left=_own_value(ruleset, right, left))
    return formula


def _own_value(ruleset: Ruleset, measure: MeasureRef, value: ScaleValue) -> ScaleValue:
    values = ruleset.measures[measure.name].values
    return ScaleValue(values[value.rank], value.rank) if 0 <= value.rank < len(values) else value


def _formulas(ruleset: Ruleset) -> FormulaPrinter:
    return printer_of(ruleset).formulas


def exception_text(ruleset: Ruleset, condition: Formula, response: Sequence[Obligation]) -> str:
    """``UNLESS condition IN WHICH CASE response`` in the language of a ruleset, on one line."""
    is_dsl = ruleset.syntax == "dsl"
    text = f"{'unless' if is_dsl else 'UNLESS'} {formula_text(ruleset, condition)}"
    if not response:
        return text
    return f"{text} {'then' if is_dsl else 'IN WHICH CASE'} {response_text(ruleset, response)}"


def response_text(ruleset: Ruleset, response: Sequence[Obligation]) -> str:
    """Obligations in the language of a ruleset. Raises `Unsayable` if it has no such response."""
    printer = printer_of(ruleset)
    printer.begin()
    printer.response(Clause(None, tuple(response)))
    return "\n".join(printer.take_lines())


def strengthened(ruleset: Ruleset, rule: Rule, condition: Formula) -> tuple[TextEdit, ...]:
    """The rule with one more condition at its trigger: ``WHEN trigger AND condition``."""
    formulas = _formulas(ruleset)
    condition = as_read(ruleset, condition)
    if rule.guard is None:
        return (TextEdit(rule.trigger_span.end, rule.trigger_span.end, formulas.guard(condition)),)
    return _conjoined(ruleset, rule.trigger_span.end, rule.guard, condition)


def narrowed(ruleset: Ruleset, hedge: Clause, condition: Formula) -> tuple[TextEdit, ...]:
    """The exception with one more condition: ``UNLESS a AND condition``."""
    assert hedge.condition is not None, "a hedge has a condition"
    return _conjoined(ruleset, hedge.span.start, hedge.condition, as_read(ruleset, condition))


def _conjoined(ruleset: Ruleset, after: int, formula: Formula, condition: Formula) -> tuple[TextEdit, ...]:
    """A formula that begins behind the offset `after`, and one more condition. The text of the formula stays as it is,
    with its comments."""
    formulas = _formulas(ruleset)
    start, end = _with_parentheses(ruleset, after, formula.span)
    own = int(isinstance(formula, Or) and start == formula.span.start)
    around = int(ruleset.syntax == "dsl")  # which has one formula after an event
    added = f"{formulas.connectives[And]}{formulas.operand(condition, And((formula, condition)))}"
    opening = TextEdit(start, start, "(" * (around + own))
    return (*([opening] if opening.text else []), TextEdit(end, end, f"{')' * own}{added}{')' * around}"))


def _with_parentheses(ruleset: Ruleset, after: int, span: Span) -> Span:
    """A formula that begins behind the offset `after`, with the parentheses around it."""
    text = blanked(ruleset.source.text, ruleset.syntax)
    opened = text.count("(", after, span.start)
    start = text.find("(", after, span.start) if opened else span.start
    end = span.end
    for _ in range(opened):
        end = text.index(")", end) + 1
    return Span(start, end)


def with_condition(ruleset: Ruleset, hedge: Clause, condition: Formula) -> tuple[TextEdit, ...]:
    """The exception with another condition."""
    assert hedge.condition is not None, "a hedge has a condition"
    start, end = _with_parentheses(ruleset, hedge.span.start, hedge.condition.span)
    return (TextEdit(start, end, formula_text(ruleset, condition)),)


def reordered(ruleset: Ruleset, first: Clause, second: Clause) -> tuple[TextEdit, ...]:
    """The rule with two of its exceptions in the other order."""
    text = ruleset.source.text
    return (
        TextEdit(*first.span, text[slice(*second.span)]),
        TextEdit(*second.span, text[slice(*first.span)]),
    )


def with_exception(
    ruleset: Ruleset, rule: Rule, clause: Clause, condition: Formula, response: Sequence[Obligation]
) -> tuple[TextEdit, ...]:
    """The rule with an exception to one of its clauses.

    It follows the last clause of the chain. An exception to any other clause is nested in the response of that clause,
    so that it applies only where this clause decides.
    """
    text = ruleset.source.text
    exception = exception_text(ruleset, condition, response)
    chain = (rule.default, *rule.hedges)
    if clause is chain[-1]:
        end = end_of_line(text, rule.span.end)
        indent = _indent_of_exceptions(ruleset, rule)
        return (TextEdit(end, end, f"{line_break_of(text)}{indent}{exception}"),)
    first, last = clause.obligations[0].span.start, clause.obligations[-1].span.end
    if _is_in_parentheses(blanked(text, ruleset.syntax), first, last):
        return (TextEdit(last, last, f" {exception}"),)
    opening, closing = "{}" if ruleset.syntax == "dsl" else "()"
    return (TextEdit(first, first, opening), TextEdit(last, last, f" {exception}{closing}"))


def _is_in_parentheses(text: str, start: int, end: int) -> bool:
    return text[:start].rstrip().endswith(("(", "{")) and text[end:].lstrip().startswith((")", "}"))


def end_of_line(text: str, offset: int) -> int:
    """The end of the line of `offset`, if only spaces and a comment follow; otherwise `offset`."""
    end = text.find("\n", offset)
    end = len(text) if end < 0 else end
    rest = text[offset:end].strip()
    if rest and not rest.startswith(("//", "#")):
        return offset
    return end - 1 if text[:end].endswith("\r") else end


def line_break_of(text: str) -> str:
    return "\r\n" if "\r\n" in text else "\n"


def indent_at(text: str, offset: int) -> str:
    """The white space at the beginning of the line of `offset`."""
    start = text.rfind("\n", 0, offset) + 1
    line = text[start:offset]
    return line[: len(line) - len(line.lstrip())]


def _indent_of_exceptions(ruleset: Ruleset, rule: Rule) -> str:
    text = ruleset.source.text
    start = indent_at(text, rule.span.start)
    for hedge in rule.hedges:
        begin = text.rfind("\n", 0, hedge.span.start) + 1
        if not text[begin : hedge.span.start].strip():
            return text[begin : hedge.span.start]
    return start + ("\t" if start.startswith("\t") else "    ") if ruleset.syntax == "dsl" else start


def without(ruleset: Ruleset, span: Span) -> tuple[TextEdit, ...]:
    """The text without a part, and without the lines that have nothing else."""
    text = ruleset.source.text
    start = text.rfind("\n", 0, span.start) + 1
    if text[start : span.start].strip():
        return (TextEdit(_end_of_word(text, span.start), span.end, ""),)
    end = end_of_line(text, span.end)
    if end == span.end and text[end : end + 1] not in ("", "\r", "\n"):
        return (TextEdit(span.start, span.end, ""),)
    for line_break in ("\r\n", "\n"):
        if text.startswith(line_break, end):
            end += len(line_break)
            break
    after = text[end:]
    if not text[:start].strip(" \t\r\n") or text[:start].endswith(("\n\n", "\n\r\n")):
        # Of the empty lines around the part, only those before it stay.
        end += len(after) - len(after.lstrip("\r\n"))
    return (TextEdit(start, end, ""),)


def _end_of_word(text: str, offset: int) -> int:
    """The end of the last word before `offset`."""
    return len(text[:offset].rstrip())


def without_obligations(ruleset: Ruleset, clause: Clause, removed: Iterable[Obligation]) -> tuple[TextEdit, ...] | None:
    """The clause without some obligations of its response; None if none would be left."""
    gone = list(removed)
    kept = [one for one in clause.obligations if one not in gone]
    if not kept:
        return None
    edits = []
    every = clause.obligations
    first_kept = every.index(kept[0])
    for number, one in enumerate(every):
        if one in kept:
            continue
        if number < first_kept:
            edits.append(TextEdit(one.span.start, every[number + 1].span.start, ""))
        else:
            edits.append(TextEdit(every[number - 1].span.end, one.span.end, ""))
    return tuple(edits)


def replaced(span: Span, text: str) -> tuple[TextEdit, ...]:
    return (TextEdit(span.start, span.end, text),)
