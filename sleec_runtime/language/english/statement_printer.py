"""Rules, claims and relations as text: one line for each exception, and parentheses only where they are needed.

A response of several obligations after IN WHICH CASE also has parentheses, for readability.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TypeVar

from sleec_runtime.language.common.comment_lines import trimmed
from sleec_runtime.language.common.formula_printer import FormulaPrinter
from sleec_runtime.language.common.statement_printer import StatementPrinter
from sleec_runtime.language.english.relations import EFFECTS, OF_CONDITIONS, OF_EVENTS
from sleec_runtime.language.english.responses import is_choice
from sleec_runtime.model import (
    Clause,
    Effect,
    EventRelation,
    Length,
    MeasureRelation,
    Number,
    Obligation,
    Relation,
    Window,
)

_INDENT = "    "
_Value = TypeVar("_Value")


class EnglishPrinter(StatementPrinter):
    """Prints statements in structured English."""

    def __init__(self, has_comments: bool = True) -> None:
        super().__init__(FormulaPrinter())
        self._has_comments = has_comments

    def keyword(self, word: str) -> str:
        return word.upper()

    # Chains ---------------------------------------------------------------------------------------------------

    def hedges(self, hedges: Sequence[Clause], indent: str = "") -> None:
        """A chain, one line for each exception."""
        for hedge in hedges:
            assert hedge.condition is not None, "a hedge has a condition"
            if self._has_comments:
                self.begin(indent, trimmed(hedge.comments.above), hedge.comments.behind)
            else:
                self.begin(indent)
            self.write(f"UNLESS {self.formulas.formula(hedge.condition)}")
            if hedge.obligations or hedge.hedges:
                self.write(" IN WHICH CASE ")
                self.response(hedge, indent, of_hedge=True)

    def response(self, clause: Clause, indent: str = "", of_hedge: bool = False) -> None:
        """The obligations of a clause, and the chain nested in it."""
        *first, last = clause.obligations or (None,)
        grouped = bool(clause.hedges) or (of_hedge and bool(first) and not any(map(_has_alternatives, first)))
        if grouped:
            self.write("(")
        for obligation in first:
            self._in_list(obligation, indent, _has_alternatives(obligation))
            self.write(" AND ")
        if last is not None:
            self._in_list(last, indent, of_hedge and not grouped and is_choice(last))
        self.hedges(clause.hedges, indent + _INDENT)
        if grouped:
            self.write(")")

    def _in_list(self, obligation: Obligation, indent: str, in_parentheses: bool) -> None:
        if in_parentheses:
            self.write("(")
        self._obligation(obligation, indent)
        if in_parentheses:
            self.write(")")

    def _obligation(self, obligation: Obligation, indent: str) -> None:
        self.write(str(obligation))
        timing = obligation.timing
        if timing is None:
            return
        if timing.window is not None:
            self.write(f" {self._window(timing.window)}")
        if timing.otherwise is not None:
            self.write(" OTHERWISE ")
            # Without parentheses an ELSE would belong to the nearest obligation before it.
            self._alternative(timing.otherwise, indent, timing.instead is not None)
        if timing.instead is not None:
            self.write(" ELSE ")
            self._alternative(timing.instead, indent, False)

    def _alternative(self, clause: Clause, indent: str, in_parentheses: bool) -> None:
        in_parentheses = in_parentheses or len(clause.obligations) > 1
        if in_parentheses and not clause.hedges:
            self.write("(")
        self.response(clause, indent)
        if in_parentheses and not clause.hedges:
            self.write(")")

    def _window(self, window: Window) -> str:
        if window.end is None:
            return "EVENTUALLY"
        if window.start is None:
            return f"WITHIN {self.length(window.end)}"
        has_same_unit = window.start.unit == window.end.unit
        start = self.formulas.term(window.start.amount) if has_same_unit else self.length(window.start)
        return f"WITHIN {start} TO {self.length(window.end)}"

    def length(self, length: Length) -> str:
        """A length of time, with the unit in the singular for the number one."""
        unit = length.unit[:-1] if length.amount == Number(1) else length.unit
        return f"{self.formulas.term(length.amount)} {unit}"

    # Relations ------------------------------------------------------------------------------------------------

    def relation(self, relation: Relation) -> str:
        """The text of a relation, without its keyword."""
        formula = self.formulas.formula
        if isinstance(relation, EventRelation):
            return f"{relation.left} {_word(OF_EVENTS, relation.relation)} {relation.right}"
        if isinstance(relation, Effect):
            return f"{relation.event} {_word(EFFECTS, relation.relation)} {formula(relation.formula)}"
        if isinstance(relation, MeasureRelation):
            text = f"ALWAYS {formula(relation.left)}"
            if relation.right is None:
                return text
            return f"{text} {_word(OF_CONDITIONS, relation.relation)} {formula(relation.right)}"
        return self.lasting(relation)


def print_relation(relation: Relation) -> str:
    """A relation as text, without its keyword and comments."""
    return EnglishPrinter().relation(relation)


def _has_alternatives(obligation: Obligation) -> bool:
    return obligation.timing is not None and any(True for _ in obligation.timing.alternatives())


def _word(words: Mapping[str, _Value], value: _Value) -> str:
    return next(word for word, meaning in words.items() if meaning == value)
