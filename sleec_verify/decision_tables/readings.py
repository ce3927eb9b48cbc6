"""Situations in which the readings of a rule differ."""

from __future__ import annotations

from sleec_runtime.model import READINGS, Obligation, Rule, Ruleset
from sleec_verify.changes.diagram.decision_diagram import FALSE
from sleec_verify.decision_tables.situations import Situations
from sleec_verify.decision_tables.table import DecisionTable, Row, Rows, guards_of, table


def reading_table(ruleset: Ruleset, rule: Rule) -> DecisionTable | None:
    """The situations in which the readings of a rule require different things. The two clauses of a row decide in the
    readings, in the order of `READINGS`. None for a rule with fewer than two exceptions, which has one meaning."""
    if sum(1 for _ in rule.clauses()) <= 2:
        return None

    def build() -> Rows:
        guards = guards_of([rule], READINGS)
        formulas = [one.formula for one in guards]
        situations = Situations(ruleset, rule.trigger, formulas)
        diagram = situations.diagram
        required: dict[frozenset[Obligation], list[int]] = {}
        for one in guards:
            nodes = required.setdefault(frozenset(one.content.obligations), [FALSE, FALSE])
            at = READINGS.index(one.reading)
            nodes[at] = diagram.either(nodes[at], diagram.node(one.formula))
        differ = FALSE
        for one_way, other_way in required.values():
            differ = diagram.either(differ, diagram.both(one_way, diagram.opposite(other_way)))
        paths, total = situations.paths(differ, formulas)
        rows = [Row(cells, tuple(guards[number].clause for number in true)) for cells, true in paths]
        return rows, total, situations.why

    return table([rule], build)
