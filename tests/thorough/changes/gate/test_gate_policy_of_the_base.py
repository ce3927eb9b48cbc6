"""What the base decides, and which suppressions are new."""

from __future__ import annotations

import shutil

import pytest

from tests.support.cli import Cli
from tests.support.gate_policies import HOUSEHOLD, NEVER, OWN, ROBOT, changes
from tests.support.gates import CLASH, OLD, gated, policies
from tests.support.repository import Repository

pytestmark = pytest.mark.skipif(shutil.which("git") is None, reason="there is no git on this machine")


def test_the_base_decides_even_if_it_allows_changes(cli: Cli, repository: Repository) -> None:
    repository.put(OWN, "[block]\npolicy-changes = false\n")
    repository.keep(OWN)
    repository.put(OWN, NEVER)
    repository.put("a.sleec", CLASH)
    code, said = gated(cli)
    assert (code, policies(said)) == (1, {"findings", "new-conflicts"})
    assert [one["blocks"] for one in said["policy_changes"]] == [False] * 3


def test_rules_that_move_with_the_selection_are_followed(cli: Cli, repository: Repository) -> None:
    repository.put("old/b.sleec", OLD)
    repository.put(OWN, 'rulesets = ["old"]\n[block]\npolicy-changes = false\nlost-obligations = ["*"]\n')
    repository.commit()
    repository.git("mv", "old", "new")
    repository.put(OWN, (repository.folder / OWN).read_text().replace('"old"', '"new"'))
    assert gated(cli)[0] == 0
    repository.put("new/b.sleec", CLASH)
    code, said = gated(cli)
    assert (code, policies(said)) == (1, {"findings", "new-conflicts"})
    (ruleset,) = said["rulesets"]
    assert (ruleset["path"], ruleset["moved_from"]) == ("new/b.sleec", "old/b.sleec")


def test_code_that_moves_with_its_target_is_followed(cli: Cli, repository: Repository) -> None:
    repository.put("h.sleec", HOUSEHOLD)
    repository.put("robot.py", ROBOT)
    repository.put(OWN, '[[targets]]\ncode = "robot.py"\nrules = "h.sleec"\n[block]\npolicy-changes = false\n')
    repository.commit()
    repository.put("robot.py", None)
    repository.put("src/robot.py", ROBOT)
    repository.put(OWN, (repository.folder / OWN).read_text().replace('"robot.py"', '"src/robot.py"'))
    code, said = gated(cli)
    assert (code, [target["code"] for target in said["targets"]]) == (0, ["src/robot.py"])
    repository.put("src/robot.py", ROBOT.replace("self.refuse_request()", "self.open_curtains()", 1))
    assert gated(cli)[0] == 1
    repository.put("src/robot.py", ROBOT)
    repository.put("robot.py", ROBOT.replace("self.refuse_request()", "self.open_curtains()", 1))
    assert {block["where"] for block in gated(cli)[1]["blocks"]} == {"robot.py"}


def test_a_base_that_lacks_its_files(cli: Cli, repository: Repository) -> None:
    repository.put(OWN, 'baseline = "known.json"\nassertions = ["must.txt"]\n')
    repository.keep(OWN)
    ran = cli("gate", "--base", "main")
    assert (ran.code, "baseline main:known.json does not exist" in ran.err) == (2, True)
    repository.put("known.json", '{"version": 1, "findings": []}')
    ran = cli("gate", "--base", "main")
    assert (ran.code, "file main:must.txt does not exist" in ran.err) == (2, True)
    repository.put("must.txt", "never o\n")
    code, said = gated(cli)
    assert (code, policies(said)) == (1, {"policy-changes"})
    assert changes(said) == [("policy-changes", "must.txt", "1 assertion added: never o")]
    repository.put(OWN, "[block]\nfindinks = 3\n")
    repository.keep(OWN)
    repository.put(OWN, "")
    ran = cli("gate", "--base", "main")
    assert (ran.code, "main:sleec-verify.toml: unknown key `block.findinks`" in ran.err) == (2, True)


def test_files_of_the_command_line(cli: Cli, repository: Repository, tmp_path_factory: pytest.TempPathFactory) -> None:
    """Those in the repository are taken from the base, too; those outside it are nobody's change."""
    repository.put("ci/policy.toml", 'rulesets = ["../a.sleec"]\n')
    repository.put("known.json", '{"version": 1, "findings": []}')
    repository.commit()
    repository.put("ci/policy.toml", 'rulesets = ["../a.sleec"]\n' + NEVER)
    repository.put("a.sleec", CLASH)
    assert cli("gate", "--write-baseline", "--baseline", "known.json").code == 0
    for files in (("--config", "ci/policy.toml"), ("--baseline", str(repository.folder / "known.json"))):
        code, said = gated(cli, *files)
        assert (code, policies(said)) == (1, {"policy-changes", "findings", "new-conflicts"})
    outside = tmp_path_factory.mktemp("outside")
    (outside / "lax.toml").write_text(f'rulesets = ["a.sleec"]\n{NEVER}')
    (outside / "known.json").write_text((repository.folder / "known.json").read_text())
    for files in (("--config", str(outside / "lax.toml")), ("--baseline", str(outside / "known.json"))):
        code, said = gated(cli, *files)
        assert (code, said["policy_changes"]) == (0, []), files
    for option, kind in (("--config", "file"), ("--baseline", "baseline")):
        ran = cli("gate", "--base", "main", option, str(outside / "nothing"))
        assert (ran.code, f"{kind} {outside / 'nothing'} does not exist" in ran.err) == (2, True), ran
    repository.put("ci/policy.toml", None)
    _, said = gated(cli, "--config", "ci/policy.toml")
    assert changes(said) == [("policy-changes", "ci/policy.toml", 'rulesets changes from ["a.sleec"] to ["."]')]


SUPPRESSED = OLD + "# sleec: allow SLEEC202 because soon\nUNLESS NOT c IN WHICH CASE q\n"


@pytest.mark.parametrize(
    ("now", "new"),
    [
        ("// moved\n\n" + SUPPRESSED, []),
        ("RULE z\nWHEN u THEN x\n" + SUPPRESSED, []),
        (SUPPRESSED.replace("q\n", "q  # a comment\n"), ["SLEEC202"]),
        (SUPPRESSED.replace("# sleec: allow SLEEC202 because soon\n", ""), []),
        (SUPPRESSED.replace("SLEEC202", "SLEEC202,  SLEEC501"), ["SLEEC501"]),
        (SUPPRESSED.replace("SLEEC202", "dead-hedge"), ["dead-hedge"]),
        (SUPPRESSED.replace("because soon", "because later"), ["SLEEC202"]),
        (SUPPRESSED.replace("UNLESS NOT c", "UNLESS NOT c AND d"), ["SLEEC202"]),
        (SUPPRESSED.replace("WHEN t", "WHEN t AND d"), []),
        (SUPPRESSED.replace("RULE a", "RULE b"), ["SLEEC202"]),
        (SUPPRESSED + SUPPRESSED.replace("RULE a", "RULE b").replace("WHEN t", "WHEN u"), ["SLEEC202"]),
        (SUPPRESSED + "# sleec: allow SLEEC202 because soon\n", ["SLEEC202"]),
    ],
)
def test_a_suppression_is_known_by_what_it_allows_why_and_where(
    now: str, new: list[str], cli: Cli, repository: Repository
) -> None:
    repository.commit(a_sleec=SUPPRESSED)
    repository.write(a_sleec=now)
    _, said = gated(cli)
    found = [what for policy, where, what in changes(said) if (policy, where) == ("new-suppressions", "a.sleec")]
    assert [what.partition(" suppression of ")[2].partition(":")[0] for what in found] == new


def test_a_suppression_moves_with_its_file(cli: Cli, repository: Repository) -> None:
    repository.commit(a_sleec=SUPPRESSED)
    repository.git("mv", "a.sleec", "b.sleec")
    repository.write(b_sleec=SUPPRESSED + "# moved\n")
    assert gated(cli)[1]["policy_changes"] == []
    repository.write(b_sleec=None, c_sleec=SUPPRESSED.replace("t THEN", "v THEN").replace("RULE a", "RULE c"))
    repository.write(a_sleec=SUPPRESSED)
    assert [where for _, where, _ in changes(gated(cli)[1])] == ["c.sleec"]
