"""Rules and exceptions that relations and constraints exclude are dead, whatever else the text has."""

from __future__ import annotations

import pytest

from sleec_runtime.language import parse
from sleec_verify.checks import run_checks
from sleec_verify.results.finding import Finding

UNRELATED = ("", "RELATION Enter PRECEDES Leave\n", "ASSUME Summer OR NOT Summer\n")

DSL = """def_start event A event B event D measure p: boolean measure q: boolean def_end
rule_start {} rule_end relation_start {} relation_end"""


def found(text: str, check: str) -> tuple[Finding, ...]:
    (result,) = run_checks(parse(text), [check])
    return result.findings


@pytest.mark.parametrize("more", UNRELATED)
@pytest.mark.parametrize(
    "law",
    [
        "EXCLUSIVE Rings, Sleeps",
        "RELATION Rings EXCLUDES Sleeps",
        "ASSUME NOT (Rings AND Sleeps)",
    ],
)
def test_a_law_between_events_makes_rules_and_exceptions_dead(law: str, more: str) -> None:
    text = (
        f"{more}{law}\nRULE door\nWHEN Rings THEN Open WITHIN 1 minute UNLESS Sleeps IN WHICH CASE Wait\n"
        "RULE rest\nWHEN Sleeps AND Rings THEN Wait WITHIN 1 minute\n"
    )
    assert [finding.clauses for finding in found(text, "dead-hedge")] == [(("door", 1),)]
    assert [finding.rules for finding in found(text, "dead-rule")] == [("rest",)]
    assert found(text, "vacuous-conflict") == ()


@pytest.mark.parametrize(
    "relation", ["measure invariant (not {p})", "measure imply {p} (not {p})", "forbid A {p}", "includes A (not {p})"]
)
@pytest.mark.parametrize("response", ["B", "B within 2 seconds"])
def test_a_relation_of_measures_makes_a_rule_dead(relation: str, response: str) -> None:
    text = DSL.format(f"R1 when A and {{p}} then {response} R2 when A then B unless {{p}} then D", relation)
    assert [finding.rules for finding in found(text, "dead-rule")] == [("R1",)]
    assert [finding.clauses for finding in found(text, "dead-hedge")] == [(("R2", 1),)]
    assert found(text, "vacuous-conflict") == ()


def test_a_dead_rule_names_the_relations() -> None:
    text = DSL.format("R1 when A and {p} then B within 1 seconds", "forbid A {q} measure imply {p} {q}")
    (finding,) = found(text, "dead-rule")
    assert finding.note == "the relation in line 2 excludes it"


def test_a_rule_that_other_rules_exclude_is_not_dead() -> None:
    text = DSL.format("R1 when A then B within 1 seconds R2 when A then not B within 1 seconds", "mutualExclusive A D")
    assert found(text, "dead-rule") == ()
    assert {finding.rules[0] for finding in found(text, "vacuous-conflict")} == {"R1", "R2"}


@pytest.mark.parametrize(
    ("text", "causes"),
    [
        ("WHEN t THEN o UNLESS x > 5 IN WHICH CASE p UNLESS x > 3 IN WHICH CASE q", "the exception `UNLESS x > 3`"),
        ("WHEN t THEN o UNLESS a IN WHICH CASE p UNLESS NOT a IN WHICH CASE q", "the exception `UNLESS a`"),
        (
            "ASSUME day OR NOT night\nASSUME wet\nASSUME NOT (night AND day)\nWHEN t THEN o UNLESS night",
            "the ASSUME in line 1 and the ASSUME in line 3",
        ),
        ("RELATION ALWAYS NOT night\nWHEN t THEN o UNLESS night IN WHICH CASE p", "the relation in line 1"),
    ],
)
def test_a_dead_exception_names_what_prevents_it(text: str, causes: str) -> None:
    (finding,) = found(text, "dead-hedge")
    assert finding.message.endswith(f" never applies because of {causes}")
    assert finding.help == f"correct its condition or {causes}, or remove it"
