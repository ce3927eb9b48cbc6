"""Decision tables agree with brute force over all situations, and stay small."""

from __future__ import annotations

from typing import Any

from hypothesis import given, settings
from hypothesis import strategies as st

from sleec_runtime.evaluation.conflicts import forbidding, has_conflict
from sleec_runtime.evaluation.formula_truth import Situation
from sleec_runtime.language import parse
from sleec_runtime.model import READINGS, Context, Obligation, Ruleset
from sleec_verify.decision_tables.paths import most_rows
from sleec_verify.decision_tables.readings import reading_table
from sleec_verify.decision_tables.splits import Cell
from sleec_verify.decision_tables.table import DecisionTable, Row, decision_table
from sleec_verify.query.prime_implicates import inconsistent_sets_of
from sleec_verify.query.ruleset_index import RulesetIndex
from sleec_verify.report.document.table_words import cell_words, column_words
from sleec_verify.results.finding import ClauseRef
from tests.support.brute_force import active, contexts
from tests.support.small_rulesets import small_rulesets


def holds(cell: Cell, ruleset: Ruleset, context: Context) -> bool:
    (kind, name), *_ = cell.variable.names
    if cell.variable.orders:
        ((one, other),) = cell.variable.orders
        values: Any = context.conditions
        return (values[one] > values[other]) - (values[one] < values[other]) + 1 in cell.values
    if kind == "trigger":
        return (name in context.triggers) in cell.values
    measure = ruleset.measures.get(name)
    given: Any = context.conditions.get(name, False)
    if measure is None:
        return bool(given) in cell.values
    if measure.kind == "scale":
        return measure.values.index(given) in cell.values
    (_, cuts), *_ = cell.variable.cuts
    return sum(given > cut.value if cut.inclusive else given >= cut.value for cut in cuts) in cell.values


def rows_of(table: DecisionTable, ruleset: Ruleset, context: Context) -> list[Row]:
    return [row for row in table.rows if all(holds(cell, ruleset, context) for cell in row.cells)]


def response(ruleset: Ruleset, one: ClauseRef) -> tuple[Obligation, ...]:
    return list(ruleset.by_label[one.rule].clauses())[one.clause].obligations


def check_contradictions(row: Row, ruleset: Ruleset, context: Context, due: list[Obligation]) -> None:
    """The row has a contradiction exactly if the evaluator finds one, unless a constraint forbids the situation."""
    constraints, situation = forbidding(ruleset), Situation(context, ruleset.measures)
    if not has_conflict((), constraints, situation):
        assert bool(row.inconsistent) == has_conflict(due, constraints, situation)


@settings(max_examples=25)
@given(st.data())
def test_each_possible_situation_is_in_one_row(data: st.DataObject) -> None:
    ruleset = data.draw(small_rulesets(measures=data.draw(st.booleans()), rules=3))
    trigger = ruleset.rules[0].trigger
    rules = [rule for rule in ruleset.rules if rule.trigger == trigger]
    table = decision_table(ruleset, rules, inconsistent_sets_of(RulesetIndex(ruleset)))
    parted = [(rule, reading_table(ruleset, rule)) for rule in rules]
    for context in contexts(ruleset):
        if trigger not in context.triggers:
            continue
        if table.why is None and table.total <= most_rows(3):
            (row,) = rows_of(table, ruleset, context)
            decide = [(rule, active(rule, ruleset, context)) for rule in rules]
            due = {rule.label: list(rule.clauses())[at].obligations for rule, at in decide if at is not None}
            assert {one.rule: response(ruleset, one) for one in row.deciding} == due
            check_contradictions(row, ruleset, context, [one for responses in due.values() for one in responses])
        for rule, other in parted:
            if other is None or (other.why is None and other.total <= most_rows(3)):
                both = [active(rule, ruleset, context, reading) for reading in READINGS]
                clauses = list(rule.clauses())
                required = {frozenset(() if at is None else clauses[at].obligations) for at in both}
                found = [] if other is None else rows_of(other, ruleset, context)
                assert len(found) == len(required) - 1
                for row in found:
                    shown = [response(ruleset, one) for one in row.deciding]
                    assert shown == [clauses[at].obligations for at in both if at is not None]


def test_ranges_of_a_measure_with_one_decision_are_one_row() -> None:
    ruleset = parse("WHEN A THEN B UNLESS x < 3 OR x > 7 IN WHICH CASE C")
    table = decision_table(ruleset, ruleset.rules)
    assert [(row.cells[0].values, row.deciding[0].clause) for row in table.rows] == [((0, 2), 1), ((1,), 0)]


def test_large_tables_are_cut_and_huge_rules_have_none() -> None:
    exceptions = "\n".join(f"UNLESS c{n} AND d{n} IN WHICH CASE E{n}" for n in range(20))
    ruleset = parse(f"READING priority\nWHEN A THEN B\n{exceptions}")
    table = decision_table(ruleset, ruleset.rules)
    assert len(table.rows) == most_rows(1)
    assert table.total > 1_000_000
    huge = parse("WHEN A THEN B\n" + "\n".join(f"UNLESS c{n} IN WHICH CASE E{n}" for n in range(100)))
    assert decision_table(huge, huge.rules).why == "the rules have 101 clauses, and the limit is 60"


def test_a_row_is_collapsed_to_what_matters() -> None:
    text = """MEASURE Age: number
ASSUME Age >= 18 OR NOT LivesAlone
RULE fall
WHEN Fall THEN Light
UNLESS Age < 16 IN WHICH CASE CallParents
UNLESS LivesAlone IN WHICH CASE CallNurse
RULE dark
WHEN Fall THEN NOT Light
UNLESS Requested IN WHICH CASE Light
UNLESS Drill IN WHICH CASE Light
"""
    ruleset = parse(text)
    fall, dark = (decision_table(ruleset, [rule]) for rule in ruleset.rules)
    assert [(row.cells[0].variable.names, row.deciding[0].clause) for row in fall.rows] == [
        ((("condition", "Age"),), 1),
        ((("condition", "Age"),), 0),
    ]
    assert [[(cell.variable.names[0][1], cell.values) for cell in row.cells] for row in dark.rows] == [
        [("Requested", (0,))],
        [("Requested", (1,))],
    ]


def test_contradictions_through_constraints_are_in_their_rows() -> None:
    text = """NEVER HoldDoor AND CarryTray UNLESS Helped
EXCLUSIVE Sing, Whisper
RULE door
WHEN Supper THEN HoldDoor AND Sing
RULE tray
WHEN Supper THEN CarryTray
UNLESS Quiet IN WHICH CASE Whisper
"""
    ruleset = parse(text)
    table = decision_table(ruleset, ruleset.rules, inconsistent_sets_of(RulesetIndex(ruleset)))
    shown = {
        tuple((cell.variable.names[0][1], cell.values) for cell in row.cells): [
            sorted(map(str, one.literals)) for one in row.inconsistent
        ]
        for row in table.rows
    }
    assert shown == {
        (("Quiet", (0,)), ("Helped", (0,))): [["CarryTray", "HoldDoor"]],
        (("Quiet", (0,)), ("Helped", (1,))): [],
        (("Quiet", (1,)),): [["Sing", "Whisper"]],
    }


def test_measures_that_are_compared_have_columns_for_their_order() -> None:
    ruleset = parse("WHEN A THEN B UNLESS x < y IN WHICH CASE C UNLESS x > 3 AND y < 2 IN WHICH CASE D")
    table = decision_table(ruleset, ruleset.rules)
    shown = [
        ([(column_words(cell.variable), cell_words(cell, ruleset)) for cell in row.cells], row.deciding[0].clause)
        for row in table.rows
    ]
    # x > 3 and y < 2 exclude x < y, so the second exception never decides in a cascade.
    assert shown == [([("x and y", "x is below y")], 1), ([("x and y", "x is at least y")], 0)]
    table = decision_table(ruleset.read_as("priority"), ruleset.rules)
    shown = [
        ([(column_words(cell.variable), cell_words(cell, ruleset)) for cell in row.cells], row.deciding[0].clause)
        for row in table.rows
    ]
    assert shown == [
        ([("x and y", "x is below y")], 1),
        ([("x and y", "x equals y")], 0),
        ([("x and y", "x is above y"), ("x", "at most 3")], 0),
        ([("x and y", "x is above y"), ("x", "above 3"), ("y", "below 2")], 2),
        ([("x and y", "x is above y"), ("x", "above 3"), ("y", "at least 2")], 0),
    ]
