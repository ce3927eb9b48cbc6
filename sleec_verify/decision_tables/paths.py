"""Paths through several decision diagrams at once, from the root to what they decide."""

from __future__ import annotations

from sleec_verify.changes.diagram.decision_diagram import FALSE, TRUE, TooLarge
from sleec_verify.changes.diagram.formulas import FormulaDiagram
from sleec_verify.decision_tables.splits import Cell, split
from sleec_verify.wording.sentence import sentence

MOST_STATES = 5_000
"""The most nodes of one diagram, and of one with several terminals."""


Path = tuple[tuple[Cell, ...], tuple[int, ...]]
"""The values on a path, and the numbers of the formulas that are true at its end."""


def most_rows(rules: int) -> int:
    """The most rows of one table of a ruleset. Large rulesets have many tables, and a report may take three times as
    long as a check."""
    return 64 if rules <= 50 else 16


_State = tuple[int, ...]


class Paths:
    """The paths from a state to the terminals. A state has a node for the possible situations, one for those that are
    shown, and one for each formula. In a terminal, all except the first are decided."""

    def __init__(self, diagram: FormulaDiagram, most: int) -> None:
        """`most` is the most paths that are returned."""
        self._diagram = diagram
        self._most = most
        self._known: dict[_State, tuple[list[Path], int]] = {}

    def below(self, state: _State) -> tuple[list[Path], int]:
        """The first paths, and the number of all. Raises `TooLarge`."""
        possible, shown, *nodes = state = self._simplified(state)
        if FALSE in (possible, shown):
            return [], 0
        if possible == TRUE and _are_decided((shown, *nodes)):
            return [((), tuple(number for number, node in enumerate(nodes) if node == TRUE))], 1
        found = self._known.get(state)
        if found is None:
            if len(self._known) >= MOST_STATES:
                raise TooLarge(sentence("it would need a diagram of more than {limit} nodes", limit=f"{MOST_STATES:,}"))
            found = self._known[state] = self._at(state)
        return found

    def _simplified(self, state: _State) -> _State:
        """The same state, with what the possible situations decide as decided, and without what does not matter for
        the rest. So states with the same decisions are equal."""
        possible, *nodes = state
        if possible in (FALSE, TRUE):
            return state
        for number, node in enumerate(nodes):
            both = self._diagram.both(node, possible)
            nodes[number] = TRUE if both == possible else both and node
        kept = set().union(*map(self._diagram.support, nodes))
        return self._diagram.some(possible, kept), *nodes

    def _at(self, state: _State) -> tuple[list[Path], int]:
        first = self._diagram.first_variable(state)
        children: dict[_State, int] = {}
        groups: dict[int, int] = {}
        for value in range(self._diagram.variables[first].ways):
            child = self._simplified(tuple(self._diagram.child(node, first, value) for node in state))
            if child[0] != FALSE:
                groups[value] = children.setdefault(child, len(children))
        states = list(children)
        rows: list[Path] = []
        count = 0
        for above, group in split(self._diagram, first, groups):
            below, number = self.below(states[group])
            rows += [((*above, *cells), leaf) for cells, leaf in below[: self._most - len(rows)]]
            count += number
        return rows, count


def _are_decided(nodes: tuple[int, ...]) -> bool:
    return all(node in (FALSE, TRUE) for node in nodes)
