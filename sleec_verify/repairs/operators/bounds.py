"""Corrections of comparisons: another bound in a conflict, and another operator in a condition that has no effect.

In a conflict, two comparisons of one measure no longer overlap: ``x <= 10`` becomes ``x < 10`` beside ``x >= 10``, and
``x > 50`` becomes ``x >= 60`` beside ``x < 60``, the negation of the other comparison.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import NamedTuple

from sleec_runtime.model import NEGATED, Comparison, MeasureRef, Operator, Rule, Ruleset, formulas_of, leaves
from sleec_verify.encoding.equation import guard
from sleec_verify.repairs.clause_names import rule_name
from sleec_verify.repairs.operators.conditions import conjuncts
from sleec_verify.repairs.repair import Candidate
from sleec_verify.repairs.statement_edits import as_read, printer_of, replaced
from sleec_verify.results.finding import Finding
from sleec_verify.wording.phrases import quoted
from sleec_verify.wording.sentence import sentence

_SAME_SIDE: Mapping[Operator, Operator] = {"<": "<=", "<=": "<", ">=": ">", ">": ">="}


class _Bound(NamedTuple):
    """A comparison of a measure with a bound, in the guard of a clause of a rule."""

    rule: Rule
    comparison: Comparison

    def is_opposite(self, other: _Bound) -> bool:
        """Whether the other one bounds the same measure from the other side."""
        one, two = self.comparison, other.comparison
        return one.left == two.left and one.operator[0] != two.operator[0]


def bounds(ruleset: Ruleset, finding: Finding) -> Iterator[Candidate]:
    """One comparison is the negation of another one of the conflict."""
    found = list(_bounds(ruleset, finding))
    for changed in found:
        for kept in found:
            if changed.rule is not kept.rule and changed.is_opposite(kept):
                negated = replace(kept.comparison, operator=NEGATED[kept.comparison.operator])
                text, old = _text(ruleset, negated), _text(ruleset, changed.comparison)
                title = sentence(
                    "replace {old} with {text} in {rule}",
                    old=quoted(old),
                    text=quoted(text),
                    rule=rule_name(ruleset, changed.rule),
                )
                edits = replaced(changed.comparison.span, text)
                yield Candidate("correction", title, edits, changed.rule.label)


def _bounds(ruleset: Ruleset, finding: Finding) -> Iterator[_Bound]:
    for label, number in finding.clauses:
        rule = ruleset.by_label[label]
        for part in conjuncts(guard(rule, ruleset.reading, number)):
            if isinstance(part, Comparison) and part.operator in _SAME_SIDE and isinstance(part.left, MeasureRef):
                yield _Bound(rule, part)


def operators(ruleset: Ruleset, finding: Finding) -> Iterator[Candidate]:
    """The bound itself counts, or no longer, or the comparison is the other way round."""
    for label in finding.rules:
        rule = ruleset.by_label[label]
        is_whole_rule = finding.span == rule.heading_span
        start, end = rule.guard.span if is_whole_rule and rule.guard is not None else finding.span
        for leaf in (leaf for formula in formulas_of(rule) for leaf in leaves(formula)):
            if isinstance(leaf, Comparison) and leaf.operator in _SAME_SIDE and start <= leaf.span.start < end:
                same_side = _SAME_SIDE[leaf.operator]
                for operator in (same_side, NEGATED[same_side]):
                    text, old = _text(ruleset, replace(leaf, operator=operator)), _text(ruleset, leaf)
                    title = sentence(
                        "replace {old} with {text} in {rule}",
                        old=quoted(old),
                        text=quoted(text),
                        rule=rule_name(ruleset, rule),
                    )
                    yield Candidate("correction", title, replaced(leaf.span, text))


def _text(ruleset: Ruleset, comparison: Comparison) -> str:
    """A comparison without parentheses, in the language of a ruleset."""
    read = as_read(ruleset, comparison)
    assert isinstance(read, Comparison), "a comparison is read as one"
    formulas = printer_of(ruleset).formulas
    return f"{formulas.term(read.left)} {formulas.operator(read.operator)} {formulas.term(read.right)}"
