"""Exact counts of situations over the names in a change."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from sleec_runtime.model import Atom, Formula, Measure, Rule, Truth
from sleec_verify.changes.compare.result import Extent
from sleec_verify.changes.diagram.decision_diagram import FALSE, TRUE
from sleec_verify.changes.diagram.formulas import FormulaDiagram
from sleec_verify.encoding.equation import conjunction
from sleec_verify.query.names import Name, names_in


class SituationCounter:
    """The diagram of one question: some formulas, under assumptions, if the `given` triggers occur."""

    def __init__(
        self,
        formulas: Sequence[Formula],
        assumed: Sequence[Formula],
        given: Iterable[str],
        measures: dict[str, Measure],
    ) -> None:
        """Raises `TooLarge` at a limit of the diagram, as the methods do."""
        self.given = tuple(sorted(given))
        occurring = [Atom("trigger", name) for name in self.given]
        self.diagram = FormulaDiagram([*occurring, *formulas, *assumed], measures)
        self._possible = TRUE
        for formula in (*occurring, *assumed):
            self._possible = self.diagram.both(self._possible, self.diagram.node(formula))

    def where(self, formula: Formula, never: Iterable[Formula] = ()) -> int:
        """The node of the possible situations that make `formula` true and none of `never`."""
        node = self.diagram.both(self._possible, self.diagram.node(formula))
        for forbidden in never:
            node = self.diagram.both(node, self.diagram.opposite(self.diagram.node(forbidden)))
        return node

    def meets(self, node: int, formula: Formula) -> bool:
        """Whether some situation of the node makes `formula` true."""
        return self.diagram.both(node, self.diagram.node(formula)) != FALSE

    def extent(self, node: int, named: Iterable[Name]) -> Extent:
        """The number of situations of the node, counted over these names and all others on which it depends."""
        wanted = set(named)
        over = self.diagram.support(node)
        over.update(at for at, variable in enumerate(self.diagram.variables) if not wanted.isdisjoint(variable.names))
        shown = [
            self.diagram.variables[at]
            for at in sorted(over)
            if not all(kind == "trigger" and name in self.given for kind, name in self.diagram.variables[at].names)
        ]
        possible = self.diagram.some(self._possible, over)
        counted = over | self.diagram.support(possible)
        return Extent(
            self.diagram.count(node, counted), self.diagram.count(possible, counted), tuple(shown), self.given
        )


def unknown_extent(given: Iterable[str], why: str) -> Extent:
    """The extent of what could not be counted."""
    return Extent(None, None, (), tuple(sorted(given)), why)


def conditions_of(rules: Iterable[Rule | None]) -> list[Formula]:
    """The guards and the conditions of hedges of some rules, without those of alternatives."""
    found: list[Formula] = []
    for rule in rules:
        if rule is not None:
            found += [] if rule.guard is None else [rule.guard]
            found += [clause.condition for clause in rule.clauses() if clause.condition is not None]
    return found


def names_of_formulas(formulas: Iterable[Formula]) -> list[Name]:
    """The names in formulas, each once."""
    return list(dict.fromkeys(name for formula in formulas for name in names_in(formula)))


def all_of(formulas: Iterable[Formula]) -> Formula:
    """The conjunction of formulas, without those that are always true."""
    return conjunction([formula for formula in formulas if formula != Truth(True)])
