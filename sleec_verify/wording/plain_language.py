"""Conditions, situations and clauses of rules in plain language, for readers who do not know the language of rules.

Names are words here (`names.spoken`), not identifiers in backticks as in messages.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from sleec_runtime.model import (
    And,
    Atom,
    Clause,
    Comparison,
    Formula,
    MeasureRef,
    Not,
    Number,
    Obligation,
    Operator,
    Or,
    ScaleValue,
    Term,
    Truth,
    Value,
)
from sleec_runtime.model.formula import NEGATED
from sleec_verify.wording.names import is_phrase, spoken
from sleec_verify.wording.phrases import Situation, listed, value_words
from sleec_verify.wording.sentence import joined, sentence
from sleec_verify.wording.times import window_words


def condition_words(formula: Formula) -> str:
    """``user age is below 16``, ``“user undressed” is true and “door open” is false``"""
    if isinstance(formula, Truth):
        return sentence("always") if formula.value else sentence("never")
    if isinstance(formula, Atom):
        return _atom_words(formula, True)
    if isinstance(formula, Comparison):
        return _comparison_words(formula)
    if isinstance(formula, Not):
        return _negation_words(formula.operand)
    if isinstance(formula, And):
        return listed(map(_operand_words, formula.operands))
    *most, last = map(_operand_words, formula.operands)
    return sentence("{conditions} or {last}", conditions=joined(", ", most), last=last)


def _operand_words(formula: Formula) -> str:
    """An operand of AND or OR; parentheses keep nested ones together."""
    words = condition_words(formula)
    return sentence("({condition})", condition=words) if isinstance(formula, (And, Or)) else words


def _negation_words(formula: Formula) -> str:
    if isinstance(formula, Atom):
        return _atom_words(formula, False)
    if isinstance(formula, Comparison):
        return _comparison_words(Comparison(formula.left, NEGATED[formula.operator], formula.right))
    if isinstance(formula, Not):
        return condition_words(formula.operand)
    return sentence("it is not true that {condition}", condition=_operand_words(formula))


def _atom_words(atom: Atom, holds: bool) -> str:
    if atom.kind == "trigger":
        return trigger_words(atom.name) if holds else _absence_words(atom.name)
    if atom.kind == "obligation":
        action = spoken(atom.name)
        return (
            sentence("“{action}” is due", action=action) if holds else sentence("“{action}” is not due", action=action)
        )
    return _value_words(atom.name, holds)


def _comparison_words(comparison: Comparison) -> str:
    left, right = _term_words(comparison.left), _term_words(comparison.right)
    if isinstance(comparison.right, MeasureRef) and comparison.operator in ("=", "!="):
        if comparison.operator == "=":
            return sentence("{left} equals {right}", left=left, right=right)
        return sentence("{left} does not equal {right}", left=left, right=right)
    words: Mapping[Operator, str] = {
        "<": sentence("{left} is below {right}", left=left, right=right),
        "<=": sentence("{left} is at most {right}", left=left, right=right),
        "=": sentence("{left} is {right}", left=left, right=right),
        "!=": sentence("{left} is not {right}", left=left, right=right),
        ">=": sentence("{left} is at least {right}", left=left, right=right),
        ">": sentence("{left} is above {right}", left=left, right=right),
    }
    return words[comparison.operator]


def _term_words(term: Term) -> str:
    if isinstance(term, MeasureRef):
        return spoken(term.name)
    if isinstance(term, Number):
        value = value_words(term.value)
        return f"{spoken(term.constant)} ({value})" if term.constant else value
    if isinstance(term, ScaleValue):
        return spoken(term.value)
    return term.written(spoken, str)


def trigger_words(name: str) -> str:
    """``“curtain open request” occurs``; a phrase stays as it is, because it says what occurs."""
    return name if is_phrase(name) else sentence("“{event}” occurs", event=spoken(name))


def _absence_words(name: str) -> str:
    return sentence("“{event}” does not occur", event=spoken(name))


def _value_words(name: str, value: Value) -> str:
    if isinstance(value, bool):
        return sentence("“{name}” is {value}", name=spoken(name), value=value_words(value))
    return sentence("{name} is {value}", name=spoken(name), value=_spoken(value))


def _spoken(value: Value) -> str:
    return spoken(value) if isinstance(value, str) else value_words(value)


def situation_words(situation: Situation) -> str:
    """``“curtain open request” occurs and “user undressed” is true``: a witness. Everything else does not matter."""
    facts = [
        *map(trigger_words, situation.triggers),
        *map(_absence_words, situation.absent),
        *(_value_words(name, value) for name, value in situation.conditions.items()),
    ]
    return listed(facts) if facts else sentence("in every situation")


def obligation_words(obligation: Obligation) -> str:
    """The action of an obligation or prohibition, with its window: ``refuse request within 5 minutes``."""
    timing = obligation.timing
    words = spoken(obligation.name)
    if timing is None:
        return words
    if timing.window is not None:
        words = sentence("{action} {window}", action=words, window=window_words(timing.window))
    if timing.otherwise is not None:
        words = sentence("{action} (otherwise: {other})", action=words, other=_alternative_words(timing.otherwise))
    if timing.instead is not None:
        words = sentence("{action} (or instead: {other})", action=words, other=_alternative_words(timing.instead))
    return words


def _alternative_words(clause: Clause) -> str:
    """``the robot must call nurse, unless “asleep” is true (then: nothing is required)``: with the exceptions."""
    words = response_words(clause)
    for hedge in clause.hedges:
        assert hedge.condition is not None, "every hedge has a condition"
        words = sentence(
            "{response}, unless {condition} (then: {other})",
            response=words,
            condition=condition_words(hedge.condition),
            other=_alternative_words(hedge),
        )
    return words


def response_words(clause: Clause) -> str:
    """``the robot must refuse request and explain why``. A clause without a response requires nothing."""
    due = [obligation_words(one) for one in clause.obligations if not one.negated]
    forbidden = [obligation_words(one) for one in clause.obligations if one.negated]
    if due and forbidden:
        return sentence(
            "the robot must {actions} and must not {forbidden}", actions=listed(due), forbidden=_any_of(forbidden)
        )
    if due:
        return sentence("the robot must {actions}", actions=listed(due))
    if forbidden:
        return sentence("the robot must not {forbidden}", forbidden=_any_of(forbidden))
    return sentence("nothing is required")


def _any_of(actions: Sequence[str]) -> str:
    *most, last = actions
    return sentence("{actions} or {last}", actions=joined(", ", most), last=last) if most else last
