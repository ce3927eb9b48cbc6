"""`gate` from end to end, in real repositories: every policy passes once and blocks once."""

from __future__ import annotations

import shutil

import pytest

from tests.support import timed_robot
from tests.support.cli import Cli, Ran
from tests.support.gates import BOTH, CASES, CLASH, DEAD, LOST, OLD, TIMED, TIMED_ELSE, config, gated, policies
from tests.support.paths import ROOT
from tests.support.repository import Repository

pytestmark = pytest.mark.skipif(shutil.which("git") is None, reason="git is not installed")


def test_nothing_changed(cli: Cli, repository: Repository) -> None:
    ran = cli("gate", "--base", "main")
    assert ran == Ran(0, "passed: no rulesets examined, 1 unchanged since main\n", "")


@pytest.mark.parametrize(
    ("policy", "new", "blocking", "passing"),
    [
        ("findings", CLASH, 'findings = "error"\nnew-conflicts = false', 'findings = "never"\nnew-conflicts = false'),
        ("findings", DEAD, 'findings = "warning"', 'findings = "error"'),
        ("new-conflicts", CLASH, 'findings = "never"', 'findings = "never"\nnew-conflicts = false'),
        ("lost-obligations", LOST, 'lost-obligations = ["p*"]', 'lost-obligations = ["q*"]'),
        (
            "ruled-out-situations",
            OLD + "ASSUME NOT t OR c\n",
            "ruled-out-situations = true\nfindings = 'never'",
            "findings = 'never'",
        ),
        ("dead-hedges", DEAD, "dead-hedges = true", "dead-hedges = false"),
        ("clause-coverage", LOST, "clause-coverage = 1", "clause-coverage = 0"),
    ],
)
def test_policies_block_and_let_pass(
    cli: Cli, repository: Repository, policy: str, new: str, blocking: str, passing: str
) -> None:
    repository.write(a_sleec=new)
    config(repository, block=blocking)
    code, said = gated(cli)
    assert (code, said["status"]) == (1, "blocked")
    assert policies(said) == {policy}
    config(repository, block=passing)
    code, said = gated(cli)
    assert (code, said["status"], said["blocks"]) == (0, "passed", [])


def test_a_certificate_beside_the_rules_can_be_asked_for(cli: Cli, repository: Repository) -> None:
    repository.write(a_sleec=LOST)
    config(repository, block="certificates = true")
    code, said = gated(cli)
    assert (code, policies(said)) == (1, {"certificates"})
    assert "the certificate a.certificate is missing" in said["blocks"][0]["what"]
    assert cli("certify", "a.sleec", "-o", "a.certificate").code == 0
    assert gated(cli)[0] == 0
    repository.write(a_sleec=LOST + "\n")
    code, said = gated(cli)
    assert (code, policies(said)) == (1, {"certificates"})
    assert "a.certificate is refused: " in said["blocks"][0]["what"]


def test_unknown_is_exit_3_unless_it_may_pass(cli: Cli, repository: Repository) -> None:
    repository.commit(a_sleec=TIMED)
    repository.write(a_sleec=TIMED_ELSE)
    config(repository, block="findings = 'never'")
    code, said = gated(cli)
    assert (code, said["status"]) == (3, "unknown")
    assert "nothing bounds `n`" in said["unknown"][0]["what"]
    config(repository, block="findings = 'never'\nunknown = false")
    assert gated(cli)[0] == 0


def test_a_new_conflict_over_time_blocks(cli: Cli, repository: Repository) -> None:
    calm = "RULE a\nWHEN t THEN o WITHIN 3 minutes\nRULE b\nWHEN u THEN NOT p WITHIN 2 minutes\n"
    repository.commit(a_sleec=calm)
    repository.write(a_sleec=calm.replace("NOT p", "NOT o"))
    config(repository, block="findings = 'never'")
    code, said = gated(cli)
    assert (code, policies(said)) == (1, {"new-conflicts"})
    (block,) = said["blocks"]
    assert block["where"] == "a.sleec"
    assert "`o` is both required and forbidden" in cli("gate", "--base", "main").out
    assert cli("gate", "--base", "main", "--summary", "summary.md").code == 1
    assert "**new conflict: rule" in (repository.folder / "summary.md").read_text(encoding="utf-8")
    config(repository, block="findings = 'never'\nnew-conflicts = false")
    assert gated(cli)[0] == 0


@pytest.mark.parametrize(("cases", "percent"), [(CASES, 50), (BOTH, 100)])
def test_clause_coverage_counts_the_clauses_that_cases_reach(
    cli: Cli, repository: Repository, cases: str, percent: int
) -> None:
    repository.write(a_sleec=OLD + "\n", a_cases_toml=cases)
    config(repository, block=f"clause-coverage = {percent}")
    assert gated(cli)[0] == 0
    config(repository, block=f"clause-coverage = {percent + 0.5}" if percent < 100 else "clause-coverage = 100")
    code, said = gated(cli)
    assert code == (1 if percent < 100 else 0)
    assert said["rulesets"][0]["coverage"]["reached"] == percent // 50


def test_coverage_of_rules_with_times_counts_windows(cli: Cli, repository: Repository) -> None:
    rules = "RULE a\nWHEN t THEN o WITHIN 5 minutes OTHERWISE p WITHIN 2 minutes\n"
    met = """
    [[case]]
    name = "met"
    steps = [{ at = 0, when = ["t"] }]
    obligations = [{ name = "o", from = 0, to = 300 }]
    """
    missed = """
    [[case]]
    name = "missed"
    steps = [{ at = 0, when = ["t"] }]
    completions = [{ name = "o", since = 0, at = "never" }]
    obligations = [{ name = "o", from = 0, to = 300 }, { name = "p", from = 300, to = 420 }]
    """
    repository.write(a_sleec=rules, a_cases_toml=met)
    config(repository, block="clause-coverage = 100")
    code, said = gated(cli)
    assert code == 1
    assert said["rulesets"][0]["coverage"] == {
        "reached": 1,
        "clauses": 1,
        "missed": ["a (default): o within 5 minutes missed", "a (default): p within 2 minutes met"],
        "windows_reached": 1,
        "windows": 3,
    }
    assert "the cases cover 1 of 1 clauses and 1 of 3 windows" in said["blocks"][0]["what"]
    repository.write(a_cases_toml=met + missed)
    assert gated(cli)[0] == 0


def test_cases_that_are_none(cli: Cli, repository: Repository) -> None:
    repository.write(a_sleec=LOST, a_cases_toml="[[case]]\nwehn = 1\n")
    config(repository, block="clause-coverage = 50")
    ran = cli("gate", "--base", "main")
    assert ran.code == 2
    assert "did you mean `when`?" in ran.err


def test_assertions(cli: Cli, repository: Repository) -> None:
    repository.put("must.txt", "never p when not c\n")
    config(repository, 'assertions = ["must.txt", "always o when t and not c"]')
    repository.keep("must.txt")
    assert gated(cli)[0] == 0
    code, said = gated(cli, "--assert", "never p")
    assert code == 1
    assert policies(said) == {"assertions"}
    ran = cli("gate", "--base", "main", "--assert", "never pp")
    assert ran.code == 2
    assert "`pp` is not in the rules" in ran.err


def test_the_code_of_targets(cli: Cli, repository: Repository) -> None:
    root = ROOT
    robot = (root / "examples" / "household_robot.py").read_text(encoding="utf-8")
    repository.put("rules/household.sleec", (root / "rulesets" / "household.sleec").read_text(encoding="utf-8"))
    repository.put("robot.py", robot)
    repository.commit()
    target = '[[tool.sleec-verify.targets]]\ncode = "robot.py"\nrules = "rules/household.sleec"'
    config(repository, target)
    assert gated(cli)[0] == 0
    assert "self.refuse_request()" in robot
    repository.put("robot.py", robot.replace("self.refuse_request()", "self.open_curtains()", 1))
    code, said = gated(cli)
    assert code == 1
    assert {block["where"] for block in said["blocks"]} == {"robot.py"}
    repository.put("robot.py", None)
    ran = cli("gate", "--base", "main")
    assert ran.code == 2
    assert "robot.py" in ran.err


def test_the_code_of_targets_with_time(cli: Cli, repository: Repository) -> None:
    repository.put("nurse.sleec", timed_robot.RULES)
    repository.put("robot.py", timed_robot.ROBOT)
    repository.commit()
    config(repository, '[[tool.sleec-verify.targets]]\ncode = "robot.py"\nrules = "nurse.sleec"')
    code, said = gated(cli)
    assert (code, said["targets"][0]["verdict"]) == (0, "proved")
    repository.put("robot.py", timed_robot.ROBOT.replace("self.call_nurse()", "self.call_ambulance()"))
    code, said = gated(cli)
    assert (code, said["targets"][0]["verdict"]) == (1, "refuted")
    repository.put("robot.py", timed_robot.ROBOT.replace(timed_robot.COMPLETED, "sleec.pending()[0].completed()"))
    code, said = gated(cli)
    assert (code, said["targets"][0]["verdict"]) == (3, "unknown")
