"""Diagrams of formulas."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from sleec_runtime.model import (
    And,
    Atom,
    Comparison,
    Formula,
    Measure,
    MeasureRef,
    Not,
    Number,
    Operator,
    ScaleValue,
    Truth,
    measures_of,
)
from sleec_verify.changes.diagram.decision_diagram import FALSE, TRUE, DecisionDiagram
from sleec_verify.changes.diagram.variables import Variables, against_number
from sleec_verify.encoding.regions import Cut, cut_at


class FormulaDiagram(DecisionDiagram):
    """The diagrams of formulas over the names of `formulas`. Two formulas are equivalent exactly if they have the
    same node."""

    def __init__(
        self, formulas: Sequence[Formula], measures: Mapping[str, Measure], most_nodes: int | None = None
    ) -> None:
        """Raises `TooLarge` as `Variables` does."""
        self._measures = measures
        self._variables = Variables(formulas, measures)
        self.variables = self._variables.all
        self._built: dict[int, tuple[Formula, int]] = {}
        super().__init__([variable.ways for variable in self.variables], most_nodes)

    def combinations(self, variable: int) -> Sequence[tuple[tuple[int, ...], tuple[int, ...]]]:
        """For each value of a variable of several numbers: the region of each number, and -1, 0 or 1 for each order."""
        return self._variables.cells[variable]

    def node(self, formula: Formula) -> int:
        """The node of a formula whose names and comparisons occur in the formulas of the diagram."""
        built = self._built.get(id(formula))
        if built is None:
            # The formula is kept, so that its id stays its own.
            built = self._built[id(formula)] = (formula, self._build(formula))
        return built[1]

    def _build(self, formula: Formula) -> int:
        if isinstance(formula, Truth):
            return TRUE if formula.value else FALSE
        if isinstance(formula, Not):
            return self.opposite(self.node(formula.operand))
        if isinstance(formula, Atom):
            return self.make(self._variables.of((formula.kind, formula.name)), (FALSE, TRUE))
        if isinstance(formula, Comparison):
            return self._compared(formula)
        joined = TRUE
        conjunction = isinstance(formula, And)
        for operand in formula.operands:
            node = self.node(operand)
            joined = self.both(joined, node if conjunction else self.opposite(node))
        return joined if conjunction else self.opposite(joined)

    def _compared(self, comparison: Comparison) -> int:
        names = measures_of(comparison)
        if len(names) == 2 and names[0] == names[1]:
            return TRUE if comparison.operator in ("=", "<=", ">=") else FALSE
        if self._measures[names[0]].kind == "scale":
            return self._on_scale(comparison, names)
        variable = self._variables.of(("condition", names[0]))
        ways = range(self.variables[variable].ways)
        if len(names) == 2:
            pair = (min(names), max(names))
            at = self.variables[variable].orders.index(pair)
            turned = 1 if pair == names else -1
            signs = (turned * self._variables.cells[variable][way][1][at] for way in ways)
            return self.make(variable, tuple(int(compares(sign, comparison.operator)) for sign in signs))
        name, operator, number = against_number(comparison)
        member = [one for one, _ in self.variables[variable].cuts].index(name)
        cuts = self.variables[variable].cuts[member][1]
        cells = self._variables.cells.get(variable)
        regions = [cells[way][0][member] if cells else way for way in ways]
        below = self._measured(name, cuts, number, inclusive=False)
        at_most = self._measured(name, cuts, number, inclusive=True)
        signs = (-1 if region <= below else 0 if region <= at_most else 1 for region in regions)
        return self.make(variable, tuple(int(compares(sign, operator)) for sign in signs))

    def _measured(self, name: str, cuts: Sequence[Cut], number: Number, inclusive: bool) -> int:
        """The last region below the number (or at most it). Without a cut there, regions need no distinction."""
        wanted = cut_at(self._measures[name], number.value, inclusive)
        return max((at for at, cut in enumerate(cuts) if cut <= wanted), default=-1)

    def _on_scale(self, comparison: Comparison, names: tuple[str, ...]) -> int:
        def sides(term: object) -> list[tuple[int, int]]:
            """Each place in the scale that a side can have, with the node of "it has it"."""
            if isinstance(term, ScaleValue):
                return [(term.rank, TRUE)]
            assert isinstance(term, MeasureRef)
            variable = self._variables.of(("condition", term.name))
            ways = self.variables[variable].ways
            return [(rank, self.make(variable, tuple(int(way == rank) for way in range(ways)))) for rank in range(ways)]

        found = FALSE
        for left, here in sides(comparison.left):
            for right, there in sides(comparison.right):
                if compares((left > right) - (left < right), comparison.operator):
                    found = self.either(found, self.both(here, there))
        return found


def compares(sign: int, operator: Operator) -> bool:
    """Whether a comparison holds, if `sign` is -1, 0 or 1 for less, equal or greater."""
    return {"<": sign < 0, "<=": sign <= 0, "=": sign == 0, "!=": sign != 0, ">=": sign >= 0, ">": sign > 0}[operator]
