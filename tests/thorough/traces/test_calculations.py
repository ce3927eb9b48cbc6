"""Rules with time, relations and claims that calculate."""

from __future__ import annotations

from sleec_runtime.evaluation.trace import Instant, Trace
from sleec_runtime.evaluation.trace_violations import violations
from sleec_verify.results.finding import Proved, Refuted
from tests.support.calculations import BOTH, results, ruleset_of


def test_a_conflict_shows_values_that_are_calculated_with():
    verdict = results(*BOTH)["conflict"]
    assert isinstance(verdict, Refuted)
    for finding in verdict.findings:
        assert finding.witness is not None
        x, y = (int(finding.witness.conditions[name]) for name in "xy")
        assert x + y > 3
        assert x * y < 0


def test_what_arithmetic_rules_out_is_no_conflict():
    verdicts = results(
        "R1 when A and (({x} + {y}) > 5) then B",
        "R2 when A and (({x} < 2) and ({y} < 2)) then not B",
        "R3 when A and (({x} * {x}) < 0) then B",
    )
    assert isinstance(verdicts["conflict"], Proved)
    assert [f.rules for f in verdicts["dead-rule"].findings] == [("R3",)]
    assert isinstance(verdicts["reading"], Proved)


def test_windows_and_calculations_together():
    rules = (
        "R1 when A and (({x} + {y}) > K) then B within 3 seconds",
        "R2 when C and (({x} * {y}) > K) then not B within 9 seconds",
        "R3 when A and ({x} > 5 and {y} > {x}) then B within 3 seconds",
    )
    verdicts = results(*rules)
    assert [f.rules for f in verdicts["redundant-rule"].findings] == [("R3", "R1")]
    (finding, *_) = verdicts["conflict"].findings
    instants = [Instant(m.time, frozenset(m.events), dict(m.conditions)) for m in finding.timeline.moments]
    # Done or not, one of the two is broken.
    ruleset = ruleset_of(*rules)
    assert violations(ruleset, Trace(tuple(instants)))
    assert violations(
        ruleset, Trace((*instants[:-1], Instant(instants[-1].time, frozenset("ABC"), instants[-1].conditions)))
    )


def test_relations_concerns_and_purposes_calculate():
    more = """concern_start
  c1 exists A and (({x} - {y} - {z}) > 2) while B
  c2 exists A and (({x} - {y} - {z}) > 7) while B
concern_end
purpose_start
  p1 exists B and (({x} * {y}) > 9)
  p2 exists B and (({x} * {y}) > 8)
purpose_end
relation_start
  measure invariant (({x} >= 0) and (({x} <= 3) and (({y} >= 0) and (({y} <= 3) and ({z} > {x} - {y} - 5)))))
relation_end"""
    verdicts = results("R1 when A then B", more=more)
    assert [f.rules for f in verdicts["purpose"].findings] == [("p1",)] or "p1" in str(verdicts["purpose"])
    assert "p2" not in str(verdicts["purpose"])
    concerns = str(verdicts["concern"])
    assert "c1" in concerns
    assert "c2" not in concerns


def test_a_hedge_that_calculates_nothing_new_is_found():
    verdicts = results("R1 when A and ({x} > 3 and {y} > 3) then B unless (({x} + {y}) < 5) then C")
    assert [f.rules for f in verdicts["dead-hedge"].findings] == [("R1",)]
    verdicts = results("R1 when A and ((({x} * {x}) >= 0) or {y} > 3) then B")
    assert "always true" in str(verdicts["constant-condition"])
