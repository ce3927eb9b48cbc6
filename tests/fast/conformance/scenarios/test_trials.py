"""The test of rules with time: what it needs, and what it says about relations and other constructs."""

from __future__ import annotations

import pytest

from sleec_runtime import Sleec
from sleec_runtime.dispatch.recording import recorded
from sleec_runtime.language import parse
from sleec_verify.conformance import Nonconformance, check_conformance
from sleec_verify.conformance.scenarios.trials import NeedsClock

MIXED = parse("""
def_start
  event Call
  event Night
  event Speak
  event Ring
  event Wave
  measure asleep: boolean
  measure dark: boolean
def_end
rule_start
  R1 when Call then Speak within 5 seconds unless {asleep} then Wave
  R2 when Night then not Ring within 1 minutes
rule_end
relation_start
  measure imply {asleep} {dark}
  mutualExclusive Speak Wave
relation_end
""")


def made(clock, rules=MIXED, code=None) -> Sleec:
    sleec = Sleec(rules, clock=clock, on_error=lambda failure: None)
    sleec.implement({name: lambda: None for name in sorted(rules.obligations)})
    if code is not None:
        sleec.implement(code)
    return sleec


def test_the_factory_takes_the_clock() -> None:
    with pytest.raises(NeedsClock, match="the rules have time, and the factory takes no clock"):
        check_conformance(lambda: made(None), parts=["scenarios"])


def test_relations_of_the_environment_restrict_scenarios_and_others_are_requirements() -> None:
    check_conformance(lambda clock: made(clock), parts=["each-rule"])
    with pytest.raises(Nonconformance) as caught:
        # Speak and Wave in one second: the runtime does not enforce the relation.
        check_conformance(
            lambda clock: made(clock, code={"Wave": lambda: recorded("Speak", lambda: None)()}),
            parts=["each-rule"],
        )
    assert "asleep is true" in str(caught.value)
    assert "dark is true" in str(caught.value)


def test_the_report_is_the_smallest_scenario() -> None:
    def make(clock) -> Sleec:
        sleec = made(clock, parse("RULE ask WHEN Ask THEN Answer WITHIN 5 seconds OTHERWISE Sorry"))
        sleec.implement({"Answer": lambda: recorded("Sorry", lambda: None)()})
        return sleec

    with pytest.raises(Nonconformance) as caught:
        check_conformance(make, parts=["scenarios"], examples=20)
    assert str(caught.value).splitlines()[:3] == [
        "executed Sorry at 0 s, although not required: it is due only if Answer is not met by 5 s",
        "  scenario:",
        "    0 s: `Ask` occurs",
    ]
