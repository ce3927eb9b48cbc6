"""Coverage of rules with time, and the list of rulesets in the report of coverage."""

from __future__ import annotations

import pytest

from tests.support.plugin_texts import ROBOT


def test_a_ruleset_is_listed_once(run, pytester: pytest.Pytester) -> None:
    """Also if a test replaces its rules, and a file of cases reads them otherwise."""
    pytester.makepyfile(
        test_robot="""
        from robot import make
        from sleec_verify.conformance import check_conformance

        def test_conformance():
            check_conformance(make, examples=2)
        """,
        robot=ROBOT,
    )
    pytester.syspathinsert()
    cases = 'reading = "priority"\n[[case]]\nwhen = ["Stop"]\nobligations = ["Halt"]\n'
    result = run("test_robot.py", "house.cases.toml", "--sleec-cov", house_cases_toml=cases)
    result.assert_outcomes(passed=2)
    assert str(result.stdout).count("clauses active") == 1


TIMED = """
RULE fall WHEN Fell THEN CallNurse WITHIN 5 minutes OTHERWISE CallAmbulance WITHIN 2 minutes
RULE rest WHEN Sleeps THEN NOT Vacuum WITHIN 1 hour
RULE dust WHEN Dust THEN Vacuum WITHIN 1 day
"""
TIMED_TESTS = """
import sleec_runtime
from sleec_runtime import Sleec, VirtualClock, load, obligation

def fell(clock):
    sleec = Sleec(load("timed.sleec").ruleset, clock=clock)
    call = obligation("CallNurse", completes=False)(lambda: None)
    sleec.implement({"CallNurse": call, "CallAmbulance": lambda: None, "Vacuum": lambda: None})
    sleec.trigger("Fell")
    return sleec

def test_met():
    fell(VirtualClock()).completed("CallNurse")

def test_missed():
    clock = VirtualClock()
    sleec = fell(clock)
    clock.advance(300)
    sleec.trigger("Sleeps")
    clock.advance(4000)
"""


def test_coverage_counts_windows(run, pytester: pytest.Pytester) -> None:
    pytester.makepyfile(test_timed=TIMED_TESTS)
    result = run("test_timed.py", "-k", "met", "--sleec-cov", timed_sleec=TIMED)
    result.stdout.fnmatch_lines(
        [
            "*timed.sleec: 1 of 3 clauses active (33.3 %)",
            "  never: rest (default)",
            "  never: dust (default)",
            "  windows: 1 of 5 met or missed (20.0 %)",
            "  never: fall (default): CallNurse within 5 minutes missed",
            "  never: fall (default): CallAmbulance within 2 minutes met",
            "  never: rest (default): NOT Vacuum within 1 hour met",
            "  never: dust (default): Vacuum within 1 day met",
        ]
    )
    result = run("test_timed.py", "--sleec-cov", timed_sleec=TIMED)
    result.stdout.fnmatch_lines(
        ["  windows: 4 of 5 met or missed (80.0 %)", "  never: dust (default): Vacuum within 1 day met"]
    )


def test_windows_that_cannot_be_missed_are_no_goals(run, pytester: pytest.Pytester) -> None:
    pytester.makepyfile(test_timed="def test(sleec):\n    sleec.trigger('A')\n")
    rules = "RULE a WHEN A THEN X WITHIN 5 seconds OTHERWISE Y\nRULE b WHEN A THEN X\n"
    result = run("test_timed.py", "--sleec-ruleset", "timed.sleec", "--sleec-cov", timed_sleec=rules)
    result.stdout.fnmatch_lines(
        ["  windows: 1 of 1 met or missed (100.0 %)", "  unreachable: a (default): X within 5 seconds missed"]
    )


def test_window_coverage_with_xdist(run, pytester: pytest.Pytester) -> None:
    pytest.importorskip("xdist")
    pytester.makepyfile(test_timed=TIMED_TESTS)
    result = run("-n", "2", "-p", "xdist", "test_timed.py", "--sleec-cov", timed_sleec=TIMED)
    result.stdout.fnmatch_lines(["  windows: 4 of 5 met or missed (80.0 %)"])
