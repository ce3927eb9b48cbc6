"""Decision tables: for each distinguishable situation, the clause of each rule that decides, and the contradictions.

The table is read off a decision diagram with several terminals (Bahar et al. 1997): a row is a path from the root to a
terminal. So the rows exclude each other, they cover every situation, and a name is in a row only if it matters there.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple, Union

from sleec_runtime.model import Clause, Formula, Obligation, Or, Reading, Rule, Ruleset
from sleec_verify.changes.diagram.decision_diagram import TRUE, TooLarge
from sleec_verify.changes.diagram.variables import Variable
from sleec_verify.decision_tables.clashes import clashes
from sleec_verify.decision_tables.situations import Situations
from sleec_verify.decision_tables.splits import Cell
from sleec_verify.encoding.equation import Implication, implications
from sleec_verify.query.inconsistent_sets import InconsistentSet, InconsistentSets
from sleec_verify.results.finding import ClauseRef
from sleec_verify.wording.sentence import sentence

MOST_CLAUSES = 60
"""The most clauses of the rules of one table."""


class Row(NamedTuple):
    """Situations that have the values of all `cells`, the clauses that decide in them, and the inconsistent sets of
    their responses."""

    cells: tuple[Cell, ...]
    deciding: tuple[ClauseRef, ...]
    inconsistent: tuple[InconsistentSet, ...] = ()


class Guard(NamedTuple):
    """The formula that says where a clause decides in a reading, and the clause. Clauses of a rule with the same
    response count as one: the first."""

    reading: Reading
    clause: ClauseRef
    formula: Formula
    content: Clause


Guards = Sequence[Guard]


class DecisionTable(NamedTuple):
    """Situations in which `trigger` occurs. `rows` are the first of `total` rows.

    `why` says why there is no table, or which assumptions it does not use; situations that these exclude are then rows,
    too.
    """

    trigger: str
    rules: tuple[str, ...]
    rows: tuple[Row, ...]
    total: int
    why: str | None = None

    @property
    def variables(self) -> list[Variable]:
        """The variables that are in some row, in their order."""
        return list(dict.fromkeys(cell.variable for row in self.rows for cell in row.cells))


def decision_table(
    ruleset: Ruleset, rules: Sequence[Rule], inconsistent: InconsistentSets | None = None
) -> DecisionTable:
    """The table of rules of one trigger, in the reading of the ruleset. All constraints of the ruleset apply.

    `inconsistent` are the sets of literals of the ruleset that cannot be due together. Without them, no row has a
    contradiction.
    """

    def build() -> Rows:
        guards = guards_of(rules, (ruleset.reading,))
        found = [] if inconsistent is None else clashes([(one.formula, one.content) for one in guards], inconsistent)
        formulas = [*(one.formula for one in guards), *(formula for _, formula in found)]
        situations = Situations(ruleset, rules[0].trigger, formulas)
        paths, total = situations.paths(TRUE, formulas)
        rows = []
        for cells, true in paths:
            deciding = tuple(guards[number].clause for number in true if number < len(guards))
            inconsistent_here = tuple(found[number - len(guards)][0] for number in true if number >= len(guards))
            rows.append(Row(cells, deciding, inconsistent_here))
        return rows, total, situations.why

    return table(rules, build)


Rows = tuple[list[Row], int, Union[str, None]]
"""The first rows, the number of all, and why the assumptions are not used, if they are not."""


def table(rules: Sequence[Rule], build: Callable[[], Rows]) -> DecisionTable:
    """The table that `build` makes, if it is not too large."""
    trigger, labels = rules[0].trigger, tuple(rule.label for rule in rules)
    clauses = sum(1 for rule in rules for _ in rule.clauses())
    if clauses > MOST_CLAUSES:
        why = sentence("the rules have {number} clauses, and the limit is {limit}", number=clauses, limit=MOST_CLAUSES)
        return DecisionTable(trigger, labels, (), 0, why)
    try:
        rows, total, why_not = build()
    except TooLarge as error:
        return DecisionTable(trigger, labels, (), 0, error.args[0])
    return DecisionTable(trigger, labels, tuple(rows), total, why_not)


def guards_of(rules: Sequence[Rule], readings: Sequence[Reading]) -> Guards:
    """Where each response of the rules is required, in each of the readings."""
    found: list[Guard] = []
    for reading in readings:
        for rule in rules:
            alike: dict[tuple[Obligation, ...], list[Implication]] = {}
            for one in implications(rule, reading):
                alike.setdefault(one.clause.obligations, []).append(one)
            for ones in alike.values():
                guard = ones[0].guard if len(ones) == 1 else Or(tuple(one.guard for one in ones))
                found.append(Guard(reading, ClauseRef(rule.label, ones[0].number), guard, ones[0].clause))
    return found
