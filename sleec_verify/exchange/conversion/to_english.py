"""Conversion from the DSL to structured English."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from sleec_runtime.model import (
    And,
    Claim,
    Comments,
    Comparison,
    Constant,
    Declaration,
    Formula,
    Measure,
    MeasureRef,
    Not,
    Or,
    Rule,
    Ruleset,
    ScaleValue,
    Span,
    Statement,
)
from sleec_verify.encoding.calculations import refuse_unsayable_calculations
from sleec_verify.encoding.measures import MIRRORED
from sleec_verify.encoding.statement_parts import with_formulas

_HINT = "compare a measure with a number or with another measure"


def to_english(ruleset: Ruleset) -> tuple[Ruleset, list[str]]:
    """Returns `ruleset` in structured English, and notes about the result.

    Tolerated mistakes are corrected:

    - A value of another scale, or a number, becomes the value of the measure's scale at the same position.
    - The second of two rules with the same label gets a new label.
    - A repeated definition is removed.

    Raises Unsayable for calculations.
    """
    refuse_unsayable_calculations(ruleset, "structured English", _HINT)
    if ruleset.syntax == "english":
        return replace(ruleset, reading_stated=True), []
    labels = {s.label for s in ruleset.statements if isinstance(s, (Rule, Claim))}
    notes = [_at_line(d.span, d.message, ruleset) for d in ruleset.defects if d.kind != "repeated-label"]
    statements: list[Statement] = []
    for statement in _defined_once(ruleset.statements):
        if isinstance(statement, (Rule, Claim)) and "#" in statement.label:
            new = _new_label(statement.label, labels)
            notes.append(_at_line(statement.label_span, f"rule `{statement.label}` is renamed to `{new}`", ruleset))
            statement = replace(statement, label=new)
        statements.append(with_formulas(statement, lambda formula: _own_values(formula, ruleset)))
    english = replace(
        ruleset, statements=tuple(statements), syntax="english", dialect=None, defects=(), reading_stated=True
    )
    return english, notes


def _defined_once(statements: Iterable[Statement]) -> list[Statement]:
    """The statements without repeated definitions, whose comments move to the first ones."""
    found: dict[int | Statement, Statement] = {}
    for number, statement in enumerate(statements):
        if not isinstance(statement, (Declaration, Measure, Constant)):
            found[number] = statement
        elif statement not in found:
            found[statement] = statement
        else:
            first, again = found[statement].comments, statement.comments
            above = (*first.above, *again.above, *([] if again.behind is None else [again.behind]))
            found[statement] = replace(statement, comments=Comments(above, first.behind))
    return list(found.values())


def _new_label(label: str, labels: set[str]) -> str:
    """A label for the second ``R1``, whose internal label is ``R1#2``."""
    new = label.replace("#", "_")
    while new in labels:
        new += "_"
    labels.add(new)
    return new


def _at_line(span: Span, said: str, ruleset: Ruleset) -> str:
    return f"line {ruleset.source.place(span).line}: {said}"


def _own_values(formula: Formula, ruleset: Ruleset) -> Formula:
    """A formula whose comparisons name values of the measure's own scale."""
    if isinstance(formula, Not):
        return replace(formula, operand=_own_values(formula.operand, ruleset))
    if isinstance(formula, (And, Or)):
        return replace(formula, operands=tuple(_own_values(operand, ruleset) for operand in formula.operands))
    return _own_comparison(formula, ruleset) if isinstance(formula, Comparison) else formula


def _own_comparison(comparison: Comparison, ruleset: Ruleset) -> Comparison:
    left, right = comparison.left, comparison.right
    measure, value = (left, right) if isinstance(left, MeasureRef) else (right, left)
    if not isinstance(measure, MeasureRef) or not isinstance(value, ScaleValue):
        return comparison
    values = ruleset.measures[measure.name].values
    if 0 <= value.rank < len(values):
        own = replace(value, value=values[value.rank])
        return replace(comparison, right=own) if measure is left else replace(comparison, left=own)
    # Out of the scale, the order is always the same. A comparison says so and is, as every one, false of a measure
    # that has no value, which `true` would not be.
    below = value.rank > 0
    operator = comparison.operator if measure is left else MIRRORED[comparison.operator]
    holds = operator in ("<", "<=", "!=") if below else operator in (">", ">=", "!=")
    return replace(comparison, left=measure, operator=">=" if holds else "<", right=ScaleValue(values[0], 0))
