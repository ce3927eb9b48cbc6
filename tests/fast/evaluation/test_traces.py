"""The evaluator of traces: rules, relations, constraints and claims."""

from __future__ import annotations

import pytest

from sleec_runtime.errors import WrongType
from sleec_runtime.evaluation.trace import Instant, Trace
from sleec_runtime.evaluation.trace_violations import claim_holds, violations, violations_so_far
from sleec_runtime.language import parse
from sleec_runtime.model import Rule, claims
from tests.support.short_traces import ruleset, times, trace


def broken_at(rules, timeline, untimed="at"):
    return times(violations(ruleset(f"R1 when {rules}"), trace(timeline), untimed))


def relation_broken_at(relation, timeline):
    return times(violations(ruleset(relations=relation), trace(timeline)))


@pytest.mark.parametrize("times_given", [(-1,), (0, 0), (3, 2), (True,), (0.5,)])
def test_times_are_whole_and_increase(times_given):
    with pytest.raises(WrongType, match="the time of an instant is"):
        Trace(tuple(map(Instant, times_given)))


def test_nothing_breaks_nothing():
    rules = ruleset("R1 when A then B", "happenBefore A B", "c1 exists A")
    assert violations(rules, Trace(())) == violations_so_far(rules, Trace(())) == ()
    assert not claim_holds(claims(rules, "concern")[0], rules, Trace(()))


def test_what_is_broken_is_told_by_time_and_then_by_the_order_of_the_text():
    rules = ruleset("R1 when A then B\nR2 when A then C", "measure invariant {m}")
    first, second = rules.rules
    relation = rules.statements[-1]
    found = violations(rules, trace("1: A m | 2: | 4: A B m"))
    assert found == ((first, 1), (second, 1), (relation, 2), (second, 4))
    assert found[0].statement is first
    assert isinstance(first, Rule)


@pytest.mark.parametrize(
    ("rule", "timeline", "expected"),
    [
        # When a rule speaks.
        ("A then B", "0: B | 3:", []),
        ("A then B", "0: A B | 3: A", [3]),
        ("A and {m} then B", "0: A | 1: A m | 2: A B m", [1]),
        ("A and ({risk} >= middle) then B", "0: A risk=low | 1: A risk=high", [1]),
        # An event may trigger and be due at once.
        ("A then A", "0: A", []),
        ("A then not A", "0: A", [0]),
        # At the instant.
        ("A then B", "0: A | 1: B", [0]),
        ("A then not B", "0: A | 1: B", []),
        ("A then not B", "0: A B", [0]),
        # Windows, ends included.
        ("A then B within 2 seconds", "1: A B", []),
        ("A then B within 2 seconds", "1: A | 3: B", []),
        ("A then B within 2 seconds", "1: A | 4: B", [1]),
        ("A then B within 2 seconds", "0: B | 1: A", [1]),
        ("A then B within [1, 2] seconds", "1: A B | 4: B", [1]),
        ("A then B within [1, 2] seconds", "1: A | 2: B", []),
        ("A then B within 1 minute", "0: A | 60: B", []),
        ("A then not B within 2 seconds", "1: A | 3: B", [1]),
        ("A then not B within 2 seconds", "0: B | 1: A | 4: B", []),
        ("A then not B within [1, 2] seconds", "1: A B | 4: B", []),
        ("A then B eventually", "0: B | 1: A", [1]),
        ("A then B eventually", "0: B | 1: A | 99: B", []),
        ("A then not B eventually", "1: A | 99: B", [1]),
        # A measure says how long: its value at the trigger.
        ("A then B within {x} seconds", "0: A x=2 | 2: B x=9", []),
        ("A then B within {x} seconds", "0: A x=1 | 2: B x=9", [0]),
        ("A then B within {x} minutes", "0: A x=1 | 60: B", []),
        ("A then B within {x} seconds", "1: A B x=-1", [1]),
        ("A then B within (2 * {x} - 1) seconds", "0: A x=2 | 3: B x=9", []),
        ("A then B within (2 * {x} - 1) seconds", "0: A x=2 | 4: B x=9", [0]),
        ("A then B within ({x} * {x} - 1) seconds", "0: A x=2 | 3: B x=9", []),
        # One after the other.
        ("A then B within 2 seconds otherwise C", "0: A | 1: B", []),
        ("A then B within 2 seconds otherwise C", "0: A | 2: C", []),
        ("A then B within 2 seconds otherwise C", "0: A | 1: C", [0]),
        ("A then B within 2 seconds otherwise C within 1 second", "0: A | 3: C", []),
        ("A then B within 2 seconds otherwise C within 1 second", "0: A | 4: C", [0]),
        ("A then B within [1, 2] seconds otherwise C", "0: A B | 2: C", []),
        ("A then B within 1 second otherwise C within 1 second otherwise A", "0: A | 2: A B | 3: B", []),
        ("A then B within 1 second otherwise C within 1 second otherwise A", "0: A | 1: | 3: C", [0]),
        ("A then not B within 2 seconds otherwise C", "0: A | 1: B | 2: C", []),
        ("A then not B within 2 seconds otherwise C", "0: A | 1: B C", [0]),
        ("A then B within {x} seconds otherwise C", "0: A x=3 | 3: C x=1", []),
        # Without a window, `otherwise` is `else`.
        ("A then B otherwise C", "0: A C", []),
        ("A then B otherwise C", "0: A | 1: C", [0]),
        ("A then B eventually otherwise C", "0: A C", []),
        ("A then B eventually otherwise C within 1 second", "0: A | 2: C", [0]),
        ("A then B within 2 seconds else C", "0: A C", []),
        ("A then B within 2 seconds else C", "0: A | 2: C", [0]),
        ("A then B within 2 seconds else C within 1 second", "0: A | 1: C", []),
        # Hedges, by priority, and an empty one.
        ("A then B unless {m} then C unless {n}", "0: A B | 1: A C m | 2: A m n | 3: A B m", [3]),
        # Hedges of their own: decided at the trigger, for alternatives too.
        ("A then B unless {m} then {C unless {n} then not C}", "0: A C m | 1: A C m n | 2: A m n", [1]),
        ("A then B within 2 seconds otherwise {C unless {m} then B}", "0: A m | 2: C", [0]),
        ("A then B within 2 seconds otherwise {C unless {m} then B}", "0: A | 2: C m", []),
        ("A then B within 2 seconds otherwise {C unless {m}}", "0: A m", []),
        ("A then B else {not C unless {m} then C}", "0: A m | 1: A C m | 2: A | 3: A C", [0, 3]),
    ],
)
def test_rules(rule, timeline, expected):
    assert broken_at(rule, timeline) == expected


@pytest.mark.parametrize(
    ("rule", "timeline", "expected"),
    [
        ("A then B", "0: B | 1: A | 9: B", []),
        ("A then B", "0: B | 1: A", [1]),
        ("A then not B", "0: B | 1: A", []),
        ("A then not B", "0: A | 9: B", [0]),
        ("A then B within 2 seconds otherwise C", "0: A | 9: C", []),
        ("A then B within 2 seconds otherwise C", "0: A | 1: C", [0]),
        ("A then B otherwise C within 1 second", "0: A | 1: C", []),
        ("A then B within 2 seconds", "0: A | 9: B", [0]),
    ],
)
def test_rules_that_are_due_some_time(rule, timeline, expected):
    assert broken_at(rule, timeline, "eventually") == expected


def test_the_reading_decides():
    text = "WHEN A THEN B UNLESS m IN WHICH CASE C UNLESS n IN WHICH CASE (NOT B AND NOT C)"
    assert times(violations(parse(text).read_as("cascade"), trace("0: A B n"))) == []
    assert times(violations(parse(text).read_as("priority"), trace("0: A B n"))) == [0]


def test_all_obligations_of_a_clause_are_due():
    rules = parse("WHEN A THEN (B AND NOT C)")
    assert times(violations(rules, trace("0: A B | 1: A | 2: A B C"))) == [1, 2]


def test_a_window_needs_the_value_of_its_measure():
    with pytest.raises(WrongType, match="x is the length of a window"):
        violations(ruleset("R1 when A then B within {x} seconds"), Trace((Instant(0, frozenset("A")),)))


@pytest.mark.parametrize(
    ("relation", "timeline", "expected"),
    [
        ("witness A B", "0: A B | 1: B | 2: A", [2]),
        ("equal A B", "0: A B | 1: B | 2: A | 3:", [1, 2]),
        ("mutualExclusive A B", "0: A B | 1: B | 2: A", [0]),
        ("happenBefore A B", "0: A B | 1: B", [0]),
        ("happenBefore A B", "0: A | 1: B | 2: B", []),
        ("measure imply {m} {n}", "0: m n | 1: m | 2: n | 3:", [1]),
        ("measure iff {m} {n}", "0: m n | 1: m | 2: n | 3:", [1, 2]),
        ("measure mutualExclusive {m} {n}", "0: m n | 1: m | 2: n | 3:", [0]),
        ("measure opposite {m} {n}", "0: m n | 1: m | 2: n | 3:", [0]),
        ("measure invariant ({x} > 1)", "0: x=1 | 1: x=2", [0]),
        ("causation A {m}", "0: A m | 1: m | 2: A", [1]),
        ("includes A {m}", "0: A m | 1: m | 2: A", [2]),
        ("forbid A {m}", "0: A m | 1: m | 2: A", [0]),
        ("when A and {m} then {n} until B", "0: A | 1: A m n | 2: n | 3: B", []),
        ("when A and {m} then {n} until B", "1: A m n | 2: | 3: B", [1]),
        ("when A then {n} until B", "0: B | 1: A n | 2: n", []),
        ("when A then {n} until B", "0: A B | 1:", []),
        ("when A then {n} until B and {m}", "0: A n | 1: B n | 2: B m | 3:", []),
        ("when A then {n} until B and {m}", "0: A n | 1: B | 2: B m", [0]),
        ("when A then {n} for 2 seconds", "0: A n | 1: n | 2:", []),
        ("when A then {n} for 2 seconds", "0: A n | 1: | 2:", [0]),
        ("when A and {m} then {n} for {x} seconds", "0: A | 1: A m n x=1 | 2: A m n x=2 | 3: n x=9 | 4:", []),
    ],
)
def test_relations(relation, timeline, expected):
    assert relation_broken_at(relation, timeline) == expected


@pytest.mark.parametrize(
    ("constraint", "expected"),
    [
        ("EXCLUSIVE A, B, C", [2, 3]),
        ("NEVER C AND NOT m OR A AND m", [1, 3]),
        ("ASSUME m OR NOT B", [2, 3]),
        ("ASSUME NOT (A AND m)", [1]),
    ],
)
def test_constraints(constraint, expected):
    rules = parse(f"{constraint}\nWHEN A THEN NOT D\nWHEN B THEN NOT D\nWHEN D THEN (A AND B AND C)\nUNLESS m")
    assert times(violations(rules, trace("0: | 1: A m | 2: A B | 3: B C"))) == expected


@pytest.mark.parametrize(
    ("claim", "timeline", "expected"),
    [
        ("exists A", "0: B | 1: A", True),
        ("exists A", "0: B", False),
        ("exists A and {m}", "0: A | 1: m", False),
        ("exists A and {m}", "0: A | 1: A m", True),
        ("exists A while B within 2 seconds", "0: A | 3: B", False),
        ("exists A while B within 2 seconds", "0: A | 2: A | 3: B", True),
        ("exists A while B while not C", "0: A B C | 1: A | 2: A C", False),
        ("exists A while B while not C", "0: A B C | 1: A B", True),
        ("when A and {m} then not B within 2 seconds", "0: A m | 1: B", False),
        ("when A and {m} then not B within 2 seconds", "0: A m | 3: B", True),
        ("when A then {B unless {m} then C}", "0: A m B | 1: A C", False),
        ("when A then {B unless {m} then C}", "0: A m C", True),
        # Anywhere, not at the same instant.
        ("exists A meanwhile (exists B and {m})", "0: A | 3: B m", True),
        ("exists A meanwhile (exists B and {m})", "0: A B", False),
        ("exists A meanwhile (exists B and {m})", "0: B m", False),
    ],
)
def test_claims(claim, timeline, expected):
    rules = ruleset("R1 when A then B", concerns=f"c1 {claim}")
    assert claim_holds(claims(rules, "concern")[0], rules, trace(timeline)) is expected


def test_claims_that_are_due_some_time():
    rules = ruleset("R1 when A then B", concerns="c1 when A then B")
    concern = claims(rules, "concern")[0]
    assert not claim_holds(concern, rules, trace("0: A | 1: B"))
    assert claim_holds(concern, rules, trace("0: A | 1: B"), "eventually")
