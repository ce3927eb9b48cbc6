"""The replay confirms witnesses of rules whose conditions are true for all values of a measure."""

from __future__ import annotations

import pytest

from sleec_runtime.language import parse
from sleec_verify.checks import run_checks
from sleec_verify.results.finding import Finding, Refuted

MEASURES = "MEASURE t: number\nMEASURE risk: low < mid < high\n"
WINDOWS = "RULE night WHEN night falls THEN NOT ring WITHIN 8 minutes\n"


def only(text: str, check: str, steps: int | None = None) -> Finding:
    (result,) = run_checks(parse(text), [check] if steps is None else [], realizable=steps)
    assert isinstance(result.verdict, Refuted), result.verdict
    (finding,) = result.findings
    return finding


@pytest.mark.parametrize(
    ("condition", "measure"), [("t < 25 OR t >= 25", "t"), ("risk >= low", "risk"), ("risk <= high", "risk")]
)
@pytest.mark.parametrize("more", ["", "ASSUME risk > low OR dark\n"])
def test_a_comparison_that_is_always_true_has_a_value(condition: str, measure: str, more: str) -> None:
    guarded = f"{MEASURES}{more}{WINDOWS}RULE smoke WHEN smoke rises AND ({condition}) THEN ring WITHIN 2 minutes\n"
    witness = only(guarded, "conflict").witness
    assert witness is not None
    assert measure in witness.conditions
    hedged = f"{MEASURES}{more}{WINDOWS}RULE smoke WHEN smoke rises THEN wait UNLESS {condition} IN WHICH CASE ring\n"
    assert only(hedged, "conflict").clauses == (("night", 0), ("smoke", 1))


@pytest.mark.parametrize("steps", [1, 3])
def test_what_a_strategy_does_not_mention_is_not_replayed(steps: int) -> None:
    text = f"ASSUME it is a ward\n{WINDOWS}RULE smoke WHEN smoke rises THEN ring WITHIN 2 minutes\n"
    assert only(text, "realizability", steps).rules == ("night", "smoke")
