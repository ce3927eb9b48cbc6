"""Rules, claims and relations of the DSL as text."""

from __future__ import annotations

from sleec_runtime.errors import Unsayable
from sleec_runtime.language.common.comment_lines import trimmed
from sleec_runtime.language.common.statement_printer import StatementPrinter
from sleec_runtime.language.dsl.formula_printer import LegosFormulaPrinter, SleecTkFormulaPrinter
from sleec_runtime.model import (
    Clause,
    Dialect,
    Effect,
    EventRelation,
    MeasureRelation,
    Relation,
    Rule,
    Window,
)

INDENT = "    "


class DslPrinter(StatementPrinter):
    """Prints statements in a dialect of the DSL."""

    def __init__(self, dialect: Dialect) -> None:
        self.is_legos = dialect == "legos"
        super().__init__(LegosFormulaPrinter() if self.is_legos else SleecTkFormulaPrinter())

    def keyword(self, word: str) -> str:
        return word

    def rule(self, label: str, rule: Rule) -> None:
        """Writes a rule."""
        self.write(f"{label} when {rule.trigger}{self.formulas.guard(rule.guard)} then ")
        self.response(rule.default, INDENT)
        for hedge in rule.hedges:
            self._hedge(hedge, INDENT * 2)

    def claim_response(self, clause: Clause) -> None:
        self._obligation(clause, INDENT)
        for hedge in clause.hedges:
            self._hedge(hedge, INDENT * 2)

    def relation(self, relation: Relation) -> str:
        """The text of a relation."""
        formula = self.formulas.formula
        if isinstance(relation, EventRelation):
            return f"{relation.relation} {relation.left} {relation.right}"
        if isinstance(relation, Effect):
            return f"{relation.relation} {relation.event} {formula(relation.formula)}"
        if isinstance(relation, MeasureRelation):
            right = "" if relation.right is None else f" {formula(relation.right)}"
            return f"measure {relation.relation} {formula(relation.left)}{right}"
        return self.lasting(relation)

    # Responses ------------------------------------------------------------------------------------------------

    def _hedge(self, hedge: Clause, indent: str) -> None:
        assert hedge.condition is not None, "a hedge has a condition"
        self.begin(indent, trimmed(hedge.comments.above), hedge.comments.behind)
        self.write(f"unless {self.formulas.formula(hedge.condition)}")
        if hedge.obligations or hedge.hedges:
            self.write(" then ")
            self.response(hedge, indent)

    def response(self, clause: Clause, indent: str = "", in_braces: bool = False) -> None:
        """Writes a response, in braces if it has hedges of its own."""
        in_braces = in_braces or bool(clause.hedges)
        if in_braces:
            self.write("{")
        self._obligation(clause, indent)
        for hedge in clause.hedges:
            self._hedge(hedge, indent + INDENT)
        if in_braces:
            self.write("}")

    def _obligation(self, clause: Clause, indent: str) -> None:
        if len(clause.obligations) != 1:
            found = ", ".join(map(str, clause.obligations)) or "empty"
            raise Unsayable(
                f"a response in the DSL is one event, but this one is {found}", "write one rule for each event"
            )
        (obligation,) = clause.obligations
        self.write(f"{'not ' if obligation.negated else ''}{obligation.name}")
        timing = obligation.timing
        if timing is None:
            return
        if timing.window is not None:
            self.write(f" {self._window(timing.window)}")
        if timing.otherwise is not None:
            # Without braces an `else` would belong to the nearest response before it.
            self.write(" otherwise ")
            self.response(timing.otherwise, indent, in_braces=timing.instead is not None)
        if timing.instead is not None:
            self.write(" else ")
            self.response(timing.instead, indent)

    def _window(self, window: Window) -> str:
        if window.end is None:
            return "eventually"
        if window.start is None:
            return f"within {self.length(window.end)}"
        return f"within [{self.length(window.start)}, {self.length(window.end)}]"
