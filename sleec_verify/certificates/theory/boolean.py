"""Boolean abstraction of rules: comparisons of measures become conditions, and their order becomes assumptions.

The theory has no numbers. ``UserAge < 18`` is a condition there, named by its text. An `Assume` for each pair of
neighbours states the order of the cuts. The order of measures that are compared with each other is stated in the same
way. These assumptions hold for all values.

So every context of the rules is a context of the abstraction, and a property of all contexts of the abstraction is a
property of the rules. The converse holds with one exception: whole numbers that are compared with each other may leave
no room between two values (`sleec_verify.encoding.measures`). Every measure has a value, as in all checks.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from sleec_runtime.model import (
    And,
    Assume,
    Atom,
    Clause,
    Comparison,
    Context,
    Formula,
    Never,
    Not,
    Or,
    Rule,
    Ruleset,
    Statement,
    Truth,
)
from sleec_verify.encoding.measures import Measures


class Boolean:
    """`ruleset` has the rules without comparisons. Its constraints include the order of the cuts. O(size of the rules),
    plus the size of the order of measures that are compared with each other."""

    def __init__(self, ruleset: Ruleset) -> None:
        self._meanings: dict[int, Formula] = {}
        self._order: list[Formula] = []
        self._true = 0
        self._measures = Measures(ruleset.measures, self._always, self._cut, self._ordered, self._both)
        stated = [self._statement(statement) for statement in ruleset.statements]
        self._measures.close()
        self.ruleset = replace(
            ruleset, statements=(*stated, *(Assume(formula) for formula in self._order)), inferred=()
        )

    @property
    def compared(self) -> set[str]:
        """The measures that are compared with each other."""
        return {name for pair in self._measures.orders for name in pair}

    def facts(self, context: Context) -> Iterator[Atom]:
        """The triggers, conditions and cuts that are true in a context with a value for every measure."""
        yield from (Atom("trigger", name) for name in sorted(context.triggers))
        for name, value in context.conditions.items():
            if value is True:
                yield Atom("condition", name)
        values = {name: value for name, value in context.conditions.items() if not isinstance(value, bool)}
        for literal in self._measures.assumptions(values):
            meaning = self._meanings[abs(literal)]
            if literal > 0 and isinstance(meaning, Atom):
                yield meaning

    # Comparisons ----------------------------------------------------------------------------------------------

    def _stands_for(self, meaning: Formula) -> int:
        literal = len(self._meanings) + 1
        self._meanings[literal] = meaning
        return literal

    def _always(self) -> int:
        if not self._true:
            self._true = self._stands_for(Truth(True))
        return self._true

    def _cut(self, key: tuple[str, ...]) -> int:
        # No name of a condition has a sign of comparison in it.
        kind, left, right = key
        return self._stands_for(Atom("condition", f"{left} <= {right}" if kind == "at-most" else f"{left} {right}"))

    def _both(self, a: int, b: int) -> int:
        return self._stands_for(And((self._meaning(a), self._meaning(b))))

    def _ordered(self, clause: list[int]) -> None:
        first, *rest = (self._meaning(literal) for literal in clause)
        self._order.append(Or((first, *rest)) if rest else first)

    def _meaning(self, literal: int) -> Formula:
        meaning = self._meanings[abs(literal)]
        return meaning if literal > 0 else Not(meaning)

    # Everything else ------------------------------------------------------------------------------------------

    def _formula(self, formula: Formula) -> Formula:
        if isinstance(formula, Comparison):
            return self._meaning(self._measures.literal(formula))
        if isinstance(formula, Not):
            return Not(self._formula(formula.operand))
        if isinstance(formula, And):
            return And(tuple(map(self._formula, formula.operands)))
        if isinstance(formula, Or):
            return Or(tuple(map(self._formula, formula.operands)))
        return formula

    def _clause(self, clause: Clause) -> Clause:
        condition = None if clause.condition is None else self._formula(clause.condition)
        return replace(clause, condition=condition, hedges=tuple(map(self._clause, clause.hedges)))

    def _statement(self, statement: Statement) -> Statement:
        if isinstance(statement, Rule):
            return replace(
                statement,
                guard=None if statement.guard is None else self._formula(statement.guard),
                default=self._clause(statement.default),
                hedges=tuple(map(self._clause, statement.hedges)),
            )
        if isinstance(statement, (Never, Assume)):
            return replace(statement, formula=self._formula(statement.formula))
        return statement
