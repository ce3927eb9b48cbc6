"""The definition of a conflict on small rulesets: alternatives, conditions that name events, constant conditions."""

from __future__ import annotations

import re
from itertools import permutations

import pytest

from sleec_runtime.language import parse
from sleec_verify.checks import run_checks
from sleec_verify.query.ruleset_index import RulesetIndex, instant_index
from sleec_verify.results.finding import CheckResult, Unknown
from tests.support.explicit.conflicts import Explicit


def conflict_check(text: str) -> CheckResult:
    (result,) = run_checks(parse(text), ["conflict"])
    assert not isinstance(result.verdict, Unknown), result.verdict.why
    return result


def conflicts(text: str) -> set[frozenset[str]]:
    """The sets of rules that are in conflict."""
    return {frozenset(finding.rules) for finding in conflict_check(text).findings}


def least(sets: set[frozenset[str]]) -> set[frozenset[str]]:
    """The sets that contain no other one."""
    return {rules for rules in sets if not any(fewer < rules for fewer in sets)}


def english(*rules: str) -> str:
    labelled = (f"RULE R{number} {rule}" for number, rule in enumerate((r for r in rules if r[0] == "W"), 1))
    return "\n".join([*(rule for rule in rules if rule[0] != "W"), *labelled]) + "\n"


def dsl(*rules: str) -> str:
    events = "\n".join(f"event {event}" for event in "ABCDXY")
    labelled = "\n".join(f"R{number} when {rule}" for number, rule in enumerate(rules, 1))
    return f"def_start\n{events}\nmeasure a: boolean\ndef_end\nrule_start\n{labelled}\nrule_end\n"


EVENTS = "".join(f"EVENT {event}\n" for event in "ABCDEX")
R1, R2, R3 = "R1", "R2", "R3"


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        (
            english(
                "WHEN smoke THEN sound_alarm WITHIN 10 seconds OTHERWISE call_operator",
                "WHEN smoke AND asleep THEN NOT sound_alarm",
            ),
            set(),
        ),
        (
            english(
                "WHEN smoke THEN sound_alarm WITHIN 10 seconds OTHERWISE call_operator",
                "WHEN smoke AND asleep THEN NOT sound_alarm WITHIN 10 seconds",
                "WHEN night THEN NOT call_operator",
            ),
            {frozenset({R1, R2, R3})},
        ),
        (english("WHEN A THEN B ELSE C", "WHEN A THEN NOT B"), set()),
        (english("WHEN A THEN B OTHERWISE C", "WHEN A THEN NOT B"), set()),
        (english("WHEN A THEN B ELSE C", "WHEN A THEN NOT B", "WHEN A THEN NOT C"), {frozenset({R1, R2, R3})}),
        (english("WHEN A THEN B ELSE C", "WHEN A THEN NOT B", "WHEN D THEN E WITHIN 2 seconds"), set()),
        (english("WHEN A THEN NOT B ELSE C", "WHEN A THEN B"), set()),
        (english("WHEN A THEN B AND X OTHERWISE C", "WHEN A THEN NOT B"), {frozenset({R1, R2})}),
        (dsl("A then B else C", "A then not B"), set()),
        (dsl("A then B otherwise C", "A then not B"), set()),
        (dsl("A then B within 10 seconds otherwise C", "A then not B"), set()),
        (dsl("A then not B else C", "A then B", "A then not C"), {frozenset({R1, R2, R3})}),
    ],
)
def test_an_alternative_has_to_be_impossible_as_well(text: str, expected: set[frozenset[str]]) -> None:
    assert conflicts(text) == expected


@pytest.mark.parametrize(
    ("rules", "expected"),
    [
        # The robot may leave the act out.
        (("WHEN A AND B THEN C", "WHEN A THEN NOT C", "WHEN D THEN NOT B"), set()),
        (("WHEN A AND B THEN C", "WHEN A THEN NOT C", "WHEN D THEN B"), {frozenset({R1, R2, R3})}),
        (("WHEN A AND B THEN C", "WHEN A THEN NOT C", "WHEN A THEN B"), {frozenset({R1, R2, R3})}),
        (("WHEN A THEN C UNLESS B", "WHEN A THEN NOT C", "WHEN D THEN B"), set()),
        (("WHEN A THEN C UNLESS B", "WHEN A THEN NOT C", "WHEN A THEN NOT B"), {frozenset({R1, R2, R3})}),
        # The exception forbids the act that it needs, and the default requires it.
        (("WHEN A THEN B UNLESS B IN WHICH CASE NOT B",), {frozenset({R1})}),
        (("WHEN A THEN C UNLESS B AND c IN WHICH CASE NOT C", "WHEN A THEN B AND C"), {frozenset({R1, R2})}),
        # Exceptions inside an alternative are decided at the trigger.
        (
            (
                "WHEN A THEN C ELSE (D UNLESS B)",
                "WHEN A THEN NOT C AND NOT D",
                "WHEN E THEN B",
            ),
            set(),
        ),
        (
            (
                "WHEN A THEN C ELSE (D UNLESS B)",
                "WHEN A THEN NOT C AND NOT D",
                "WHEN A THEN NOT B",
            ),
            {frozenset({R1, R2, R3})},
        ),
    ],
)
def test_the_response_decides_conditions_that_name_acts(rules: tuple[str, ...], expected: set[frozenset[str]]) -> None:
    assert conflicts(EVENTS + english(*rules)) == expected


def test_the_clause_of_a_rule_that_names_an_act_is_that_of_every_response() -> None:
    (finding,) = conflict_check(
        EVENTS + english("WHEN A THEN C UNLESS B IN WHICH CASE D", "WHEN A THEN B", "WHEN A THEN NOT D")
    ).findings
    assert {(one.rule, one.clause) for one in finding.clauses} == {(R1, 1), (R2, 0), (R3, 0)}
    (finding,) = conflict_check(
        EVENTS + english("WHEN A THEN C UNLESS B IN WHICH CASE D", "WHEN A THEN NOT C AND NOT D", "WHEN E THEN B")
    ).findings
    assert [one.rule for one in finding.clauses] == [R2], "both clauses of R1 are possible"
    assert finding.rules == (R1, R2)


def test_too_many_acts_in_the_conditions_of_one_rule_are_undecided() -> None:
    (result,) = run_checks(
        parse(
            EVENTS + english("WHEN A THEN X UNLESS B AND C AND D AND E", "WHEN A THEN NOT X AND B AND C AND D AND E")
        ),
        ["conflict"],
    )
    assert isinstance(result.verdict, Unknown)
    assert "`R1` name more than 3 responses" in result.verdict.why


@pytest.mark.parametrize("window", ["", " WITHIN 2 seconds"])
@pytest.mark.parametrize("condition", ["t < 25 OR t >= 25", "risk >= low", "NOT (t < 25) OR t < 30"])
def test_a_condition_that_is_always_true_has_a_witness(condition: str, window: str) -> None:
    """Its measure needs a value in the witness, because a comparison without a value is false."""
    text = english(
        "MEASURE t: number",
        "MEASURE risk: low < high",
        f"WHEN A AND ({condition}) THEN X{window}",
        f"WHEN A THEN NOT X{window}",
    )
    assert conflicts(text) == {frozenset({R1, R2})}


@pytest.mark.parametrize(
    "text",
    [
        english("WHEN A THEN B WITHIN 2 seconds"),
        english("WHEN A THEN B ELSE C"),
        english("WHEN A THEN B OTHERWISE C"),
        english("WHEN A THEN X UNLESS c IN WHICH CASE NOT B EVENTUALLY"),
        english("RELATION A PRECEDES B", "WHEN A THEN B"),
    ],
)
def test_the_engine_for_single_instants_takes_no_window_alternative_or_relation(text: str) -> None:
    with pytest.raises(ValueError, match=r"window or an alternative|connects instants"):
        instant_index(RulesetIndex(parse(text)))


@pytest.mark.parametrize(
    ("rules", "relations"),
    [
        # B can never have occurred before A: each B breaks a rule.
        (("A then not A", "B then C", "B then not C"), ("happenBefore B A",)),
        (("A then not A", "B then C within 1 seconds", "D then not C within 2 seconds"), ("happenBefore C A",)),
        (("A then C", "B then not C"), ("happenBefore C A",)),
        (("A then C within 1 seconds", "B then not C within 2 seconds"), ("happenBefore C A", "mutualExclusive A B")),
        (("A then C within 1 seconds", "B then not C within 2 seconds"), ("happenBefore D B",)),
        (("A then not B within 1 seconds", "C then B"), ("happenBefore B A", "happenBefore D C")),
        (("A then not A", "B then not B"), ("happenBefore A B",)),
        (("A then not A", "B then not B"), ("happenBefore A B", "happenBefore B A")),
    ],
)
def test_a_conflict_has_a_lawful_history_that_the_relations_allow(
    rules: tuple[str, ...], relations: tuple[str, ...]
) -> None:
    text = dsl(*rules) + "relation_start\n" + "\n".join(relations) + "\nrelation_end\n"
    every = Explicit(parse(text)).conflicts()
    assert least(every) <= conflicts(text) <= every


def test_an_event_that_must_precede_and_that_never_can_occur_leaves_no_situation() -> None:
    assert conflicts(english("EVENT A", "EVENT C", "NEVER C", "RELATION C PRECEDES A", "WHEN A THEN C")) == set()


@pytest.mark.parametrize("order", list(permutations(range(2))))
@pytest.mark.parametrize("names", list(permutations("BCD")))
def test_a_rule_that_a_response_triggers_again_has_the_clause_that_decides_then(
    order: tuple[int, ...], names: tuple[str, ...]
) -> None:
    """The response to the first event triggers R2, whose prohibition is pending, with the exception that contradicts
    it. R2 is in conflict with itself, so this is no conflict of its own."""
    rules = (
        "R1 when B then C",
        "R2 when C then not D eventually unless (not {a}) then D",
    )
    text = dsl("A then X").split("rule_start")[0] + "rule_start\n" + "\n".join(rules[one] for one in order)
    text = re.sub(r"\b[BCD]\b", lambda name: names["BCD".index(name[0])], text) + "\nrule_end\n"
    (finding,) = conflict_check(text).findings
    assert finding.rules == (R2,)
    assert sorted(one.clause for one in finding.clauses) == [0, 1]


def pairs_of(text: str) -> set[frozenset[tuple[str, int]]]:
    return {frozenset((one.rule, one.clause) for one in finding.clauses) for finding in conflict_check(text).findings}


@pytest.mark.parametrize("order", list(permutations(range(2))))
@pytest.mark.parametrize(
    ("rules", "relation", "expected"),
    [
        # The default is pending, and the response decides whether the exception applies now.
        (
            (
                "R1 when C then not A unless {b1} then B",
                "R2 when C then not B within 2 seconds unless (A or {a}) then B",
            ),
            "",
            [{(R2, 0), (R2, 1)}, {(R1, 1), (R2, 0)}],
        ),
        # The relation excludes A, so the default decides unless a holds.
        (
            ("R1 when B and C then A unless (A or {a}) then not C", "R2 when C then X"),
            "mutualExclusive A B",
            [{(R1, 0)}, {(R1, 1)}],
        ),
    ],
)
def test_each_conflict_of_a_rule_that_names_an_act_is_found_in_any_order(
    rules: tuple[str, ...], relation: str, expected: list[set[tuple[str, int]]], order: tuple[int, ...]
) -> None:
    text = dsl("A then X").split("rule_start")[0].replace("def_end", "measure b1: boolean\ndef_end")
    text += "rule_start\n" + "\n".join(rules[one] for one in order) + "\nrule_end\n"
    text += f"relation_start\n{relation}\nrelation_end\n" if relation else ""
    assert pairs_of(text) == {frozenset(one) for one in expected}
    assert not any("again and again" in finding.message for finding in conflict_check(text).findings)


def test_a_response_that_triggers_a_rule_with_a_pending_demand_has_a_witness() -> None:
    """The exception of R2 decides only once the response of R1 triggers it again."""
    text = english(
        "WHEN B THEN A AND C ELSE D",
        "WHEN A THEN NOT C WITHIN 2 seconds UNLESS a IN WHICH CASE NOT D",
    )
    assert pairs_of(text) == {frozenset({(R1, 0), (R2, 0), (R2, 1)})}


@pytest.mark.parametrize(
    "rules",
    [
        ("ASSUME w >= 0 AND w <= 2", "WHEN A AND B AND w >= 0 THEN NOT B", "WHEN A THEN B"),
        ("READING priority", "WHEN A AND (B OR m) THEN NOT B AND B UNLESS m IN WHICH CASE (NOT B AND B)"),
        ("READING priority", "WHEN A AND (m OR C OR A) THEN C UNLESS m IN WHICH CASE C", "WHEN A THEN NOT C"),
    ],
)
def test_a_rule_that_names_an_act_has_all_its_values_in_the_witness(rules: tuple[str, ...]) -> None:
    """Without them, the evaluator would decide another clause than the solver."""
    assert conflicts(EVENTS + english(*rules))
