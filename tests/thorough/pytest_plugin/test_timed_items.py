"""Items of rules with time: rules, scenarios, and cases without steps."""

from __future__ import annotations

import pytest

RULES = """
RULE fall WHEN Fell THEN CallNurse WITHIN 5 minutes OTHERWISE CallAmbulance WITHIN 2 minutes
RULE rest WHEN Sleeps THEN NOT Sing WITHIN 1 hour
RULE dust WHEN Dust THEN Vacuum WITHIN 1 day
"""
ROBOT = """
from pathlib import Path
import sleec_runtime
from sleec_runtime.language import parse

def make(clock):
    sleec = sleec_runtime.load("timed.sleec", clock=clock)
    sleec.implement(dict.fromkeys(sleec.ruleset.obligations, lambda: None))
    return sleec

def slow(clock):
    text = Path("timed.sleec").read_text().replace("5 minutes", "10 minutes")
    sleec = sleec_runtime.Sleec(parse(text), clock=clock)
    sleec.implement(dict.fromkeys(sleec.ruleset.obligations, lambda: None))
    return sleec

def mute(clock):
    sleec = sleec_runtime.load("timed.sleec", clock=clock)
    def nothing_rings(): raise OSError("the line is dead")
    sleec.implement({"CallNurse": nothing_rings, "CallAmbulance": nothing_rings, "Vacuum": lambda: None})
    return sleec

def without_clock():
    return make(sleec_runtime.VirtualClock())
"""
SCENARIO = """
[[case]]
name = "the nurse does not come"
steps = [{ at = 0, when = ["Fell"] }]
completions = [{ name = "CallNurse", since = 0, at = "never" }]
obligations = [
  { name = "CallNurse", from = 0, to = "5 minutes" },
  { name = "CallAmbulance", from = 300, to = 420, rule = "fall" },
]
prohibitions = []

[[case]]
name = "without steps"
when = ["Fell", "Sleeps"]
obligations = ["CallNurse"]
prohibitions = ["Sing"]
"""


def test_each_rule_is_tested_without_a_target(run) -> None:
    result = run("-v", "timed.sleec", timed_sleec=RULES)
    result.stdout.fnmatch_lines([f"*timed.sleec::rule[[]{name}] PASSED*" for name in ("fall", "rest", "dust")])
    assert result.ret == pytest.ExitCode.OK


def test_a_rule_that_no_scenario_triggers_is_skipped_with_the_reason(run) -> None:
    rules = "def_start event A event B event X def_end relation_start happenBefore B A happenBefore A B relation_end"
    result = run("-rs", "timed.sleec", timed_sleec=rules + " rule_start R1 when A then X within 5 seconds rule_end")
    result.stdout.fnmatch_lines(["*SKIPPED*no scenario triggers the rule: in no trace*"])


def test_a_target_is_run_against_its_rules(run) -> None:
    assert run("timed.sleec", "--sleec-target", "robot.py:make", timed_sleec=RULES, robot_py=ROBOT).ret == 0
    options = ("--sleec-ruleset", "timed.sleec", "--sleec-target", "robot.py:slow")
    result = run("timed.sleec", *options, timed_sleec=RULES, robot_py=ROBOT)
    result.stdout.fnmatch_lines(["*did not execute CallAmbulance*", "FAILED timed.sleec::rule[[]fall]*"])
    assert result.parseoutcomes()["failed"] == 1
    result = run("timed.sleec", "--sleec-target", "robot.py:without_clock", timed_sleec=RULES, robot_py=ROBOT)
    result.stdout.fnmatch_lines(["*the rules have time, and the factory takes no clock*"])
    result.stdout.no_fnmatch_line("*Traceback*")


def test_cases_with_and_without_steps(run) -> None:
    files = {"timed_sleec": RULES, "timed_cases_toml": SCENARIO, "robot_py": ROBOT}
    run("timed.cases.toml", **files).assert_outcomes(passed=2)
    run("timed.cases.toml", "--sleec-target", "robot.py:make", **files).assert_outcomes(passed=2)
    result = run("timed.cases.toml", "--sleec-target", "robot.py:mute", **files)
    result.assert_outcomes(failed=2)
    result.stdout.fnmatch_lines(["*CallAmbulance*"])
    result = run("timed.cases.toml", "--sleec-cov", **files)
    result.stdout.fnmatch_lines(["*timed.sleec: 2 of 3 clauses active*", "  windows: 4 of 5 met or missed (80.0 %)"])


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('to = "5 minutes"', "to = 301", "*obligation that the case does not state: `CallNurse` from 0 to 300*"),
        ("obligations = [", 'obligations = [{ name = "Vacuum", from = 0 },', "*do not require: `Vacuum`*"),
        ("prohibitions = []", 'prohibitions = [{ name = "Sing", from = 0 }]', "*prohibition that the rules do not*"),
        ('["CallNurse"]', '["CallAmbulance"]', "*obligations of the case:  CallAmbulance*"),
        ('["Sing"]', "[]", "*prohibitions by the rules: Sing*"),
        ('obligations = ["CallNurse"]', "conflict = true", "*the rules do not contradict each other*"),
    ],
)
def test_wrong_expectations_fail(run, old: str, new: str, message: str) -> None:
    assert old in SCENARIO
    result = run("timed.cases.toml", timed_sleec=RULES, timed_cases_toml=SCENARIO.replace(old, new, 1))
    result.stdout.fnmatch_lines([message])
    result.stdout.no_fnmatch_line("*Traceback*")
    result.assert_outcomes(failed=1, passed=1)


def test_a_measure_that_gives_a_length_needs_a_value(run) -> None:
    rules = "MEASURE n: integer\nRULE a WHEN T THEN o WITHIN n minutes\n"
    case = '[[case]]\nsteps = [{ at = 0, when = ["T"] }]\nobligations = [{ name = "o", from = 0, to = 60 }]\n'
    result = run("timed.cases.toml", timed_sleec=rules, timed_cases_toml=case)
    result.stdout.fnmatch_lines(["*n*the length of a window*"])
    result.stdout.no_fnmatch_line("*Traceback*")
    given = case.replace('["T"]', '["T"], given = { n = 1 }')
    run("timed.cases.toml", timed_sleec=rules, timed_cases_toml=given).assert_outcomes(passed=1)


def test_the_output_of_cases_passes(run, pytester: pytest.Pytester) -> None:
    from sleec_verify.cli import run as command

    rules = pytester.path / "timed.sleec"
    rules.write_text(RULES, encoding="utf-8")
    assert command(["cases", str(rules), "-o", str(pytester.path / "timed.cases.toml")]) == 0
    result = run("timed.cases.toml", "--sleec-cov")
    assert result.ret == pytest.ExitCode.OK
    result.stdout.fnmatch_lines(["*3 of 3 clauses active (100.0 %)", "  windows: 5 of 5 met or missed (100.0 %)"])


def test_timed_items_with_xdist(run) -> None:
    pytest.importorskip("xdist")
    files = {"timed_sleec": RULES, "timed_cases_toml": SCENARIO}
    result = run("-n", "2", "-p", "xdist", "timed.sleec", "timed.cases.toml", "--sleec-cov", **files)
    assert result.ret == pytest.ExitCode.OK
    result.stdout.fnmatch_lines(["  windows: 4 of 5 met or missed (80.0 %)"])
