"""The pytest plugin, in a folder of its own each time."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from sleec_runtime.language import parse
from sleec_verify.checks import checks_for
from tests.support.plugin_texts import RULES

ITEMS = len(checks_for(parse(RULES))) + 2
"""An item a check, and one a rule."""

CONFLICT = """
RULE a WHEN T THEN o
RULE b WHEN T THEN NOT o
"""
CASES = """
[[case]]
name = "undressed"
when = ["Request"]
given = { Undressed = true }
obligations = ["Explain", "Refuse"]
prohibitions = []

[[case]]
when = "Request, Stop"
given = "Undressed, Age=11.5"
obligations = ["Warn", "Open", "Halt"]
"""


def test_a_ruleset_is_an_item_a_check_and_a_rule(run) -> None:
    result = run("-v", "house.sleec")
    result.stdout.fnmatch_lines(["*house.sleec::check[[]conflict] PASSED*", "*house.sleec::rule[[]curtains] PASSED*"])
    assert result.ret == pytest.ExitCode.OK


def test_findings_fail_by_their_level(run) -> None:
    result = run("clash.sleec", clash_sleec=CONFLICT)
    result.stdout.fnmatch_lines(["*clash.sleec:*error[[]SLEEC101]*", "*situation: When `T` occurs*"])
    result.stdout.no_fnmatch_line("*Traceback*")
    assert result.ret == pytest.ExitCode.TESTS_FAILED
    assert run("house.sleec").ret == pytest.ExitCode.OK
    strict = run("house.sleec", "-o", "sleec_fail_level=warning")
    strict.stdout.fnmatch_lines(["FAILED house.sleec::check[[]reading]*"])


def test_a_target_is_run_against_its_rules(run) -> None:
    assert run("house.sleec", "--sleec-target", "robot.py:make").ret == pytest.ExitCode.OK
    result = run("house.sleec", "--sleec-target", "robot.py:careless")
    result.stdout.fnmatch_lines(
        ["*did not execute Explain*", "*by rule curtains, clause 1, layer curtains.hc1: Refuse AND Explain"]
    )
    result.assert_outcomes(failed=1, passed=ITEMS - 1)


def test_a_target_is_for_its_own_ruleset_only(run) -> None:
    result = run("other.sleec", "--sleec-target", "robot.py:careless", other_sleec=RULES)
    assert result.ret == pytest.ExitCode.OK
    result = run("other.sleec", "--sleec-target", "robot.py:careless", "--sleec-ruleset", "other.sleec")
    assert result.ret == pytest.ExitCode.TESTS_FAILED


@pytest.mark.parametrize(
    ("target", "message"),
    [
        ("robot", "*the target 'robot' is invalid*"),
        ("robot.py:nothing", "*is a int, not a function*"),
        ("robot.py:none", "*the factory returned nothing, which is not a Sleec*"),
        ("robot.py:broken", "*raised RuntimeError: no arm*"),
        ("robot.py:absent", "*cannot be imported: AttributeError*"),
        ("there_is_none:make", "*cannot be imported: ModuleNotFoundError*"),
        ("missing.py:make", "*file *missing.py does not exist*"),
    ],
)
def test_a_bad_target_is_an_error_of_collection(run, target: str, message: str) -> None:
    result = run("house.sleec", "--sleec-target", target)
    result.stdout.fnmatch_lines([message])
    result.stdout.no_fnmatch_line("*Traceback*")
    assert result.ret == pytest.ExitCode.INTERRUPTED


def test_what_is_no_ruleset_is_an_error_of_collection(run) -> None:
    result = run("bad.sleec", bad_sleec="RULE x WHEN\n")
    result.stdout.fnmatch_lines(["*bad.sleec:1:*"])
    result.stdout.no_fnmatch_line("*Traceback*")
    assert result.ret == pytest.ExitCode.INTERRUPTED


def test_cases_beside_a_ruleset(run) -> None:
    run("house.cases.toml", house_cases_toml=CASES).assert_outcomes(passed=2)
    wrong = CASES.replace('["Explain", "Refuse"]', '["Open"]')
    result = run("house.cases.toml", house_cases_toml=wrong)
    result.stdout.fnmatch_lines(["*obligations of the case:  Open", "*obligations by the rules: Refuse, Explain"])
    result = run("house.cases.toml", "--sleec-target", "robot.py:careless", house_cases_toml=CASES)
    result.stdout.fnmatch_lines(["*did not execute Explain*"])


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("[[case]]", "[[cases]]", "*unknown key 'cases' (did you mean `case`?)*"),
        ("prohibitions", "prohibition", "*unknown key 'prohibition' (did you mean `prohibitions`?)*"),
        ("[[case]]", "[[case", "*is not TOML*"),
        ("Undressed = true", "Undresed = true", "*case 1 (undressed): *Undresed*did you mean `Undressed`?*"),
        ("Undressed = true", "Undressed = 1", "*the condition `Undressed` must be true or false*"),
        ("Undressed = true", "Age = true", "*`Age` must be a number*"),
        ("Undressed = true", "Undressed = []", "*give true, false, a number*"),
        ('["Request"]', '["Reqest"]', "*no trigger is called `Reqest`*did you mean `Request`?*"),
        ('["Request"]', "3", "*when is 3*"),
        ('"Refuse"]', '"Refuze"]', "*no obligation is called `Refuze`*did you mean `Refuse`?*"),
        ('obligations = ["Explain", "Refuse"]', "", "*does not say what is required*"),
        ('name = "undressed"', "name = 3", "*name is 3, not a text*"),
        ('name = "undressed"', 'domain = "ward"', "*no domain is called `ward`*"),
        ("\n[[case]]", '\nreading = "both"\n[[case]]', "*the reading is 'both'*"),
        ("\n[[case]]", '\nruleset = "none.sleec"\n[[case]]', "*none.sleec*"),
    ],
)
def test_bad_cases_are_an_error_of_collection(run, old: str, new: str, message: str) -> None:
    result = run("house.cases.toml", house_cases_toml=CASES.replace(old, new, 1))
    result.stdout.fnmatch_lines([message])
    result.stdout.no_fnmatch_line("*Traceback*")
    assert result.ret == pytest.ExitCode.INTERRUPTED


TESTS = """
from sleec_runtime import recording

def test_open(sleec):
    with recording() as seen:
        sleec.trigger("Request")
    assert seen.executed == ["Open"]

def test_refuse(sleec, sleec_ruleset):
    sleec.update({"Undressed": True})
    assert sleec.trigger("Request").obligations == ("Refuse", "Explain")
    assert len(sleec_ruleset.rules) == 2
"""


def test_fixtures_and_coverage(run, pytester: pytest.Pytester) -> None:
    pytester.makepyfile(test_house=TESTS)
    result = run("test_house.py", "--sleec-ruleset", "house.sleec", "--sleec-cov-mcdc")
    result.assert_outcomes(passed=2)
    result.stdout.fnmatch_lines(
        [
            "*house.sleec: 2 of 4 clauses active (50.0 %)",
            "  never: curtains.hc2",
            "  never: stop (default)",
            "  MC/DC: 1 of 4 conditions decided (25.0 %)",
            "  never decides: Distressed in curtains",
        ]
    )
    result = run("test_house.py", "--sleec-ruleset", "house.sleec", "--sleec-cov-fail-under", "60")
    result.stdout.fnmatch_lines(["FAIL: 50.0 % of all goals is less than 60 %"])
    assert result.ret == pytest.ExitCode.TESTS_FAILED
    result = run("test_house.py", "--sleec-ruleset", "house.sleec", "-o", "sleec_cov_fail_under=50")
    assert result.ret == pytest.ExitCode.OK


def test_a_target_that_names_its_rules_otherwise_is_covered_all_the_same(run) -> None:
    options = ("--sleec-ruleset", "house.sleec", "--sleec-target", "robot.py:make", "--sleec-cov")
    result = run("house.cases.toml", *options, house_cases_toml=CASES)
    result.stdout.fnmatch_lines(["*house.sleec: 3 of 4 clauses active (75.0 %)"])


def test_going_through_all_contexts_covers_nothing(run) -> None:
    run("house.sleec", "--sleec-cov").stdout.fnmatch_lines(["no ruleset was used"])
    run("house.sleec", "--sleec-cov", "--sleec-ruleset", "house.sleec").stdout.fnmatch_lines(
        ["*0 of 4 clauses active*"]
    )


def test_an_unreachable_clause_is_no_goal(run, pytester: pytest.Pytester) -> None:
    pytester.makepyfile(test_dead="def test(sleec):\n    sleec.trigger('T')\n")
    dead = "RULE r WHEN T THEN o UNLESS c AND NOT c IN WHICH CASE p\n"
    result = run("test_dead.py", "--sleec-ruleset", "dead.sleec", "--sleec-cov-fail-under", "100", dead_sleec=dead)
    result.stdout.fnmatch_lines(["*1 of 1 clauses active (100.0 %)", "  unreachable: r.hc1"])
    assert result.ret == pytest.ExitCode.OK


def test_a_condition_that_can_never_decide_is_no_goal(run, pytester: pytest.Pytester) -> None:
    pytester.makepyfile(
        test_ages="""
        def test(sleec):
            for age in (2, 3):
                sleec.update({"Age": age})
                sleec.trigger("T")
        """
    )
    ages = "MEASURE Age: number\nRULE r WHEN T THEN o UNLESS Age < 3 IN WHICH CASE p UNLESS Age < 5 IN WHICH CASE q\n"
    options = ("--sleec-ruleset", "ages.sleec", "--sleec-cov-mcdc", "--sleec-cov-fail-under", "100")
    result = run("test_ages.py", *options, ages_sleec=ages)
    result.stdout.fnmatch_lines(["  MC/DC: 1 of 1 conditions decided (100.0 %)", "  cannot decide: Age < 5 in r"])
    assert result.ret == pytest.ExitCode.OK


WORKER = """
def pytest_configure(config):
    config.workeroutput = {}

def pytest_unconfigure(config):
    with open("sent.txt", "a") as file:
        print(repr(config.workeroutput), file=file)
"""
STARTER = """
from types import SimpleNamespace

def pytest_sessionstart(session):
    config = session.config
    for line in open("sent.txt"):
        config.hook.pytest_testnodedown(node=SimpleNamespace(config=config, workeroutput=eval(line)), error=None)
    config.hook.pytest_testnodedown(node=SimpleNamespace(config=config), error="crashed")
"""


def test_coverage_is_of_all_processes_together(run, pytester: pytest.Pytester) -> None:
    """As pytest-xdist does it, with its processes one after the other."""
    pytester.makepyfile(test_house=TESTS)
    options = ("test_house.py", "--sleec-ruleset", "house.sleec", "--sleec-cov-mcdc", "--sleec-cov-fail-under", "40")
    for part in ("open", "refuse"):
        result = run(*options, "-k", part, conftest_py=WORKER)
        assert "clause coverage" not in result.stdout.str()  # nor is it measured against the bound
        assert result.ret == pytest.ExitCode.OK
    result = run(*options, "-k", "none of them", conftest_py=STARTER)
    result.stdout.fnmatch_lines(["*house.sleec: 2 of 4 clauses active (50.0 %)", "  MC/DC: 1 of 4 conditions*"])
    assert "FAIL" in result.stdout.str()  # 3 of 8 goals


def test_coverage_with_xdist(run, pytester: pytest.Pytester) -> None:
    pytest.importorskip("xdist")
    pytester.makepyfile(test_house=TESTS)
    options = ("--sleec-ruleset", "house.sleec", "--sleec-cov-fail-under", "50")
    result = run("-n", "2", "-p", "xdist", "test_house.py", *options)
    result.stdout.fnmatch_lines(["*house.sleec: 2 of 4 clauses active (50.0 %)"])
    assert result.ret == pytest.ExitCode.OK


def test_fixtures_say_what_is_missing(run, pytester: pytest.Pytester) -> None:
    pytester.makepyfile(test_house=TESTS)
    result = run("test_house.py")
    result.stdout.fnmatch_lines(["*no ruleset: use --sleec-ruleset FILE*"])
    result = run("test_house.py", "--sleec-target", "robot.py:broken")
    result.stdout.fnmatch_lines(["*no arm*"])


def test_cases_of_other_tools_are_left_alone(run) -> None:
    for text in ("rows = 3\n", "no toml at all [", "rows = " + "[" * 10_000, "[[case]]\nwhen = 'T'\n"):
        result = run(".", other_cases_toml=text)
        result.assert_outcomes(passed=ITEMS)
        assert "other.cases.toml" not in result.stdout.str()
    elsewhere = 'ruleset = "house.sleec"\n' + CASES
    large = elsewhere + "#" * 16 * 1024 * 1024
    run(".", other_cases_toml=large).assert_outcomes(passed=ITEMS)
    run(".", other_cases_toml=elsewhere).assert_outcomes(passed=ITEMS + 2)


def test_a_ruleset_that_is_not_there_is_a_usage_error(run, pytester: pytest.Pytester) -> None:
    pytester.makepyfile(test_any="def test(): pass")
    for arguments in (["--sleec-ruleset", "nope.sleec"], ["-o", "sleec_ruleset=nope.sleec"]):
        result = run("test_any.py", *arguments)
        result.stderr.fnmatch_lines(["*file *nope.sleec does not exist*"])
        assert result.ret == pytest.ExitCode.USAGE_ERROR


@pytest.mark.parametrize("percent", ["nan", "-5", "150", "inf", "many"])
def test_a_threshold_is_a_percentage(run, pytester: pytest.Pytester, percent: str) -> None:
    pytester.makepyfile(test_any="def test(): pass")
    for arguments in ([f"--sleec-cov-fail-under={percent}"], ["-o", f"sleec_cov_fail_under={percent}"]):
        result = run("test_any.py", *arguments)
        result.stderr.fnmatch_lines([f"*sleec_cov_fail_under is '{percent}', not a number from 0 to 100*"])
        assert result.ret == pytest.ExitCode.USAGE_ERROR


def test_a_threshold_is_not_met_by_using_no_rules(run, pytester: pytest.Pytester) -> None:
    pytester.makepyfile(test_any="def test(): pass")
    result = run("test_any.py", "--sleec-cov-fail-under", "50")
    result.stdout.fnmatch_lines(["no ruleset was used", "FAIL: 50 % of all goals are required, but there are no goals"])
    assert result.ret == pytest.ExitCode.TESTS_FAILED


def test_a_project_without_rules_pays_nothing(tmp_path: Path) -> None:
    code = (
        "import sys, pytest\n"
        "pytest.main(['-p', 'no:cacheprovider', '-p', 'sleec_verify.pytest_plugin', '-q', '--co', '--rootdir', "
        "sys.argv[1], sys.argv[1]])\n"
        "print(*[m for m in sys.modules if m.startswith(('sleec_runtime', 'sleec_verify.', 'pysat', 'contextpy3'))])"
    )
    environment = {"PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1", "PYTHONPATH": ".", "PATH": ""}
    done = subprocess.run([sys.executable, "-c", code, str(tmp_path)], capture_output=True, text=True, env=environment)
    # Of the packages only what an import of their names brings: the modules in them are imported where they are used.
    assert done.stdout.split("\n")[-2] == "sleec_runtime sleec_verify.pytest_plugin", done.stderr
