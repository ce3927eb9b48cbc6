"""The evaluator of traces: histories, which can go on."""

from __future__ import annotations

from dataclasses import replace

import pytest

from sleec_runtime.evaluation.trace_violations import violations_so_far
from sleec_runtime.language import parse
from tests.support.short_traces import ruleset, times, trace


def hopeless_at(rules, timeline, untimed="at"):
    return times(violations_so_far(ruleset(f"R1 when {rules}"), trace(timeline), untimed))


def relation_hopeless_at(relation, timeline):
    return times(violations_so_far(ruleset(relations=relation), trace(timeline)))


@pytest.mark.parametrize(
    ("rule", "timeline", "expected"),
    [
        # Now may hold more, the past may not.
        ("A then B", "0: A", []),
        ("A then B", "0: A | 1: A", [0]),
        ("A then not B", "0: A B", [0]),
        ("A then not B", "0: A | 1:", []),
        ("A then not A", "0: A", [0]),
        # Windows that include now, or what is later.
        ("A then B within 2 seconds", "0: A | 2:", []),
        ("A then B within 2 seconds", "0: A | 3:", [0]),
        ("A then B within 2 seconds", "0: A | 1: B | 3:", []),
        ("A then B within [1, 2] seconds", "0: A B | 3:", [0]),
        ("A then not B within 2 seconds", "0: A | 2: B", [0]),
        ("A then B within {x} seconds", "1: A x=-1", [1]),
        ("A then B eventually", "0: A | 99:", []),
        ("A then not B eventually", "0: A | 99: B", [0]),
        # What is due in place of it.
        ("A then B within 2 seconds otherwise C", "0: A | 2:", []),
        ("A then B within 2 seconds otherwise C", "0: A | 3:", [0]),
        ("A then B within 2 seconds otherwise C", "0: A | 2: C | 3:", []),
        ("A then B within 2 seconds otherwise C within 2 seconds", "0: A | 4:", []),
        ("A then B within 2 seconds otherwise not C", "0: A | 2: C | 3:", [0]),
        ("A then not B within 2 seconds otherwise C", "0: A | 1: B", []),
        ("A then not B within 2 seconds otherwise C", "0: A B | 3:", [0]),
        ("A then not B else C within 1 second", "0: A B | 1:", []),
    ],
)
def test_what_a_history_breaks_for_good(rule, timeline, expected):
    assert hopeless_at(rule, timeline) == expected


def test_what_a_history_breaks_for_good_without_windows():
    assert hopeless_at("A then B", "0: A | 9:", "eventually") == []
    assert hopeless_at("A then not B", "0: A | 9: B", "eventually") == [0]


@pytest.mark.parametrize(
    ("rule", "timeline", "expected"),
    [
        # What still occurs now decides hedges and guards of now, and not those of before.
        ("A then not A unless B", "0: A", []),
        ("A then not A unless B", "0: A | 1:", [0]),
        ("A and (not B) then not A", "0: A", []),
        ("A then not A unless B then not B", "0: A", [0]),
        ("A then C within 2 seconds otherwise {not A unless B}", "0: A", []),
        # What a hedge looks for and what it then forbids, or requires, go together.
        ("A then B unless B then not B", "0: A", [0]),
        ("A then B unless B then not A", "0: A", [0]),
        ("A then B unless B then C", "0: A", []),
        ("A then B within [0, 1] seconds unless B then not A", "0: A", []),
        ("A then B within [0, 1] seconds unless B then not A", "0: A B", [0]),
    ],
)
def test_what_else_occurs_now_decides_conditions_that_name_events(rule, timeline, expected):
    assert hopeless_at(rule, timeline) == expected


@pytest.mark.parametrize(
    ("first", "second", "timeline", "expected"),
    [
        # Each could be kept, both cannot.
        ("B", "not B", "0: A", [0]),
        ("B within 2 seconds", "not B within 3 seconds", "0: A", [0]),
        ("B within 3 seconds", "not B within 2 seconds", "0: A", []),
        ("B within 3 seconds", "not B within 2 seconds", "0: A | 4:", [0]),
        ("B within 3 seconds", "not B within 2 seconds", "0: A | 3: B | 4:", []),
        ("B within 3 seconds", "not B within [2, 3] seconds", "0: A | 1:", []),
        ("B within 3 seconds", "not B within [2, 3] seconds", "0: A | 2:", [0]),
        ("B eventually", "not B eventually", "0: A", [0]),
        ("B within 3 seconds", "not C within 3 seconds", "0: A", []),
        ("B within 1 second otherwise C", "not B within 3 seconds", "0: A | 1:", []),
        ("B within 1 second otherwise C", "not B within 3 seconds", "0: A | 2:", [0]),
    ],
)
def test_obligations_of_one_clause_are_kept_together(first, second, timeline, expected):
    rules = ruleset(f"R1 when A then {first}\nR2 when A then {second}")
    obligations = tuple(o for rule in rules.rules for o in rule.default.obligations)
    rule = replace(rules.rules[0], default=replace(rules.rules[0].default, obligations=obligations))
    assert times(violations_so_far(replace(rules, statements=(rule,)), trace(timeline))) == expected


@pytest.mark.parametrize(
    ("relation", "timeline", "expected"),
    [
        ("witness A B", "0: A | 1: A", [0]),
        ("equal A B", "0: B | 1: B", [0]),
        ("mutualExclusive A B", "0: | 1: A B", [1]),
        ("happenBefore A B", "0: | 1: B", [1]),
        ("happenBefore A B", "0: A | 1: B", []),
        ("measure invariant {m}", "0: | 1:", [0, 1]),
        ("causation A {m}", "0: m | 1: m", [0]),
        ("includes A {m}", "0: m A | 1: A", [1]),
        ("forbid A {m}", "0: A | 1: A m", [1]),
        ("when A then {n} until B", "0: A n | 1:", []),
        ("when A then {n} until B", "0: A n | 1: | 2:", [0]),
        ("when A then {n} until B and {m}", "0: A n | 1:", [0]),
        ("when A then {n} until B and {m}", "0: A n | 1: m", []),
        ("when A then {n} until B", "0: A", []),
        ("when A then {n} for 2 seconds", "0: A n | 1:", [0]),
        ("when A then {n} for 2 seconds", "0: A n | 2:", []),
    ],
)
def test_what_a_history_breaks_of_relations(relation, timeline, expected):
    assert relation_hopeless_at(relation, timeline) == expected


def test_what_a_history_breaks_of_constraints():
    rules = parse("ASSUME A OR B OR m\nNEVER C AND m\nWHEN A THEN NOT D\nWHEN B THEN C UNLESS m")
    assert times(violations_so_far(rules, trace("0: | 1: C m | 2:"))) == [0, 1]
    assert times(violations_so_far(rules, trace("0: m | 1: C m"))) == [1]
    assert times(violations_so_far(rules, trace("0: A | 1:"))) == []
