"""The change under review does not decide its own verdict: what decides is read from the base, and what the change does
to it is listed, and blocks unless the base allows it."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from sleec_verify.changes.gate.keys import _POLICIES, _SETTINGS
from sleec_verify.report import FORMATS
from tests.support.cli import Cli
from tests.support.paths import ROOT
from tests.support.repository import Repository
from tests.thorough.changes.gate.test_gate import CLASH, DEAD, LOST, OLD, TIMED, TIMED_ELSE, gated, policies

pytestmark = pytest.mark.skipif(shutil.which("git") is None, reason="there is no git on this machine")
ROBOT = (ROOT / "examples" / "household_robot.py").read_text(encoding="utf-8")
HOUSEHOLD = (ROOT / "rulesets" / "household.sleec").read_text(encoding="utf-8")
OWN = "sleec-verify.toml"
NEVER = '[block]\nfindings = "never"\nnew-conflicts = false\n'


@pytest.fixture
def repository(tmp_path: Path) -> Repository:
    made = Repository(tmp_path)
    made.commit(a_sleec=OLD)
    return made


def changes(said: dict[str, Any]) -> list[tuple[str, str, str]]:
    return [(one["policy"], one["where"], one["what"]) for one in said["policy_changes"]]


# Attacks --------------------------------------------------------------------------------------------------


Attack = Callable[[Repository, Cli], None]


def put(**files: str | None) -> Attack:
    return lambda repository, cli: repository.write(a_sleec=CLASH, **files)


def an_own_baseline(repository: Repository, cli: Cli) -> None:
    repository.put(OWN, 'baseline = "known.json"\n')
    repository.put("a.sleec", CLASH)
    assert cli("gate", "--write-baseline").code == 0


def more_in_the_baseline(repository: Repository, cli: Cli) -> None:
    repository.put(OWN, 'baseline = "known.json"\n')
    assert cli("gate", "--write-baseline").code == 0
    repository.keep(OWN, "known.json")
    an_own_baseline(repository, cli)


def a_linked_configuration(repository: Repository, cli: Cli) -> None:
    repository.put("lax.toml", NEVER)
    repository.put(OWN, "[block]\n")
    repository.keep("lax.toml", OWN)
    (repository.folder / OWN).unlink()
    (repository.folder / OWN).symlink_to("lax.toml")
    repository.put("a.sleec", CLASH)


def a_removed_configuration(repository: Repository, cli: Cli) -> None:
    repository.put(OWN, '[block]\nlost-obligations = ["p"]\n')
    repository.keep(OWN)
    repository.put(OWN, None)
    repository.put("a.sleec", LOST)


def another_selection(repository: Repository, cli: Cli) -> None:
    repository.put("good/b.sleec", OLD)
    repository.keep("good/b.sleec")
    repository.put(OWN, 'rulesets = ["good"]\n')
    repository.put("a.sleec", CLASH)


def assertions_taken_away(repository: Repository, cli: Cli) -> None:
    repository.put("must.txt", "always p when t and c\n")
    repository.put(OWN, 'assertions = ["must.txt"]\n')
    repository.keep("must.txt", OWN)
    repository.put("must.txt", "always o when t\n")
    repository.put("a.sleec", LOST)


def an_assertion_file_that_is_gone(repository: Repository, cli: Cli) -> None:
    assertions_taken_away(repository, cli)
    repository.put("must.txt", None)


def targets_taken_away(repository: Repository, cli: Cli) -> None:
    repository.put("h.sleec", HOUSEHOLD)
    repository.put("robot.py", ROBOT)
    repository.put(OWN, '[[targets]]\ncode = "robot.py"\nrules = "h.sleec"\n')
    repository.keep("h.sleec", "robot.py", OWN)
    repository.put("robot.py", ROBOT.replace("self.refuse_request()", "self.open_curtains()", 1))
    repository.put(OWN, "")


def other_rules_for_the_target(repository: Repository, cli: Cli) -> None:
    targets_taken_away(repository, cli)
    repository.put(OWN, '[[targets]]\ncode = "robot.py"\nrules = "a.sleec"\n')


def a_policy_for_what_is_unknown(repository: Repository, cli: Cli) -> None:
    repository.commit(a_sleec=TIMED)
    repository.put(OWN, "[block]\nunknown = false\n")
    repository.put("a.sleec", TIMED_ELSE)


def a_suppression(repository: Repository, cli: Cli) -> None:
    repository.put("a.sleec", CLASH.replace("RULE b", "// sleec: allow SLEEC101 because fine\nRULE b"))


def a_suppression_of_a_check(repository: Repository, cli: Cli) -> None:
    repository.put("a.sleec", CLASH.replace("NOT o", "NOT o  # sleec: allow conflict because fine"))


def one_more_code(repository: Repository, cli: Cli) -> None:
    repository.put("a.sleec", OLD.replace("RULE", "# sleec: allow SLEEC401 because fine\nRULE"))
    repository.keep("a.sleec")
    repository.put("a.sleec", CLASH.replace("RULE a", "# sleec: allow SLEEC401, SLEEC101 because fine\nRULE a"))


ATTACKS: dict[str, tuple[Attack, str, str]] = {
    "a first configuration": (put(**{"sleec-verify_toml": NEVER}), "findings", "policy-changes"),
    "a table of pyproject": (
        put(pyproject_toml='[tool.sleec-verify.block]\nfindings = "never"\nnew-conflicts = false\n'),
        "findings",
        "policy-changes",
    ),
    "nothing selected": (put(**{"sleec-verify_toml": 'rulesets = ["nothing"]\n'}), "findings", "policy-changes"),
    "another selection": (another_selection, "findings", "policy-changes"),
    "an own baseline": (an_own_baseline, "findings", "policy-changes"),
    "more in the baseline": (more_in_the_baseline, "findings", "policy-changes"),
    "a linked configuration": (a_linked_configuration, "findings", "policy-changes"),
    "a removed configuration": (a_removed_configuration, "lost-obligations", "policy-changes"),
    "assertions taken away": (assertions_taken_away, "assertions", "policy-changes"),
    "an assertion file that is gone": (an_assertion_file_that_is_gone, "assertions", "policy-changes"),
    "targets taken away": (targets_taken_away, "findings", "policy-changes"),
    "other rules for the target": (other_rules_for_the_target, "findings", "policy-changes"),
    "a policy for what is unknown": (a_policy_for_what_is_unknown, "unknown", "policy-changes"),
    "a suppression": (a_suppression, "findings", "new-suppressions"),
    "a suppression of a check": (a_suppression_of_a_check, "findings", "new-suppressions"),
    "one more code": (one_more_code, "findings", "new-suppressions"),
}


@pytest.mark.parametrize("committed", [True, False], ids=["committed", "not committed"])
@pytest.mark.parametrize("name", ATTACKS)
def test_a_change_cannot_let_itself_pass(name: str, committed: bool, cli: Cli, repository: Repository) -> None:
    attack, reason, policy = ATTACKS[name]
    repository.git("branch", "before")
    attack(repository, cli)
    base = "main"
    if committed:
        repository.git("branch", "-f", "before")
        repository.commit()
        base = "before"
    code, said = gated(cli, base=base)
    assert (code, said["status"]) == (1, "blocked")
    assert {policy} == {one["policy"] for one in said["policy_changes"]}
    assert all(one["blocks"] for one in said["policy_changes"])
    # The change is judged by the base all the same.
    assert reason in policies(said) | ({"unknown"} if said["unknown"] else set())


def test_a_branch_from_before_the_policy_is_judged_by_it(cli: Cli, repository: Repository) -> None:
    repository.put(OWN, NEVER)
    repository.keep(OWN)
    repository.git("checkout", "-q", "-b", "feature")
    repository.commit(a_sleec=CLASH)
    repository.git("checkout", "-q", "main")
    repository.put(OWN, '[block]\nfindings = "error"\n')
    repository.keep(OWN)
    repository.git("checkout", "-q", "feature")
    code, said = gated(cli)
    assert (code, policies(said), said["policy_changes"]) == (1, {"findings", "new-conflicts"}, [])


def test_a_link_in_the_place_of_a_folder_hides_nothing(cli: Cli, repository: Repository) -> None:
    repository.put("rules/b.sleec", OLD)
    repository.put("good/b.sleec", OLD)
    repository.put(OWN, '[block]\nlost-obligations = ["p"]\n')
    repository.commit()
    (repository.folder / "rules").rename(repository.folder / "hidden")
    repository.put("hidden/b.sleec", LOST)
    (repository.folder / "rules").symlink_to("good")
    for paths in ((), ("rules",)):
        code, said = gated(cli, *paths)
        assert (code, policies(said)) == (1, {"lost-obligations"})


def test_the_nearest_configuration_is_that_of_the_base(
    cli: Cli, repository: Repository, monkeypatch: pytest.MonkeyPatch
) -> None:
    repository.put("sub/deep/b.sleec", OLD)
    repository.put("sub/pyproject.toml", "[tool.other]\n")
    repository.put(OWN, 'rulesets = ["sub"]\n[block]\nlost-obligations = ["p"]\n')
    repository.commit()
    repository.put("sub/deep/sleec-verify.toml", NEVER)
    repository.put("sub/deep/b.sleec", LOST)
    monkeypatch.chdir(repository.folder / "sub" / "deep")
    code, said = gated(cli)
    assert (code, policies(said)) == (1, {"policy-changes", "lost-obligations"})
    assert {where for _, where, _ in changes(said)} == {"sub/deep/sleec-verify.toml"}


# What is listed -------------------------------------------------------------------------------------------


KEYS: dict[str, tuple[str, str, str]] = {
    "rulesets": ('rulesets = ["."]', 'rulesets = ["a.sleec"]', 'rulesets changes from ["."] to ["a.sleec"]'),
    "base": ('base = "main"', 'base = "HEAD"', 'base changes from "main" to "HEAD"'),
    "baseline": ("", 'baseline = "known.json"', 'baseline changes from unset to "known.json"'),
    "assertions": (
        'assertions = ["never p when not c"]',
        "assertions = []",
        'assertions changes from ["never p when not c"] to []',
    ),
    "targets": (
        '[[targets]]\ncode = "robot.py"\nrules = "h.sleec"',
        '[[targets]]\ncode = "robot.py"\nrules = "h.sleec"\ndomain = "home"',
        'targets changes from [["robot.py", "h.sleec", null]] to [["robot.py", "h.sleec", "home"]]',
    ),
    "findings": ('findings = "note"', 'findings = "never"', 'block.findings changes from "note" to "never"'),
    "new-conflicts": ("", "new-conflicts = false", "block.new-conflicts changes from true to false"),
    "lost-obligations": (
        'lost-obligations = ["x"]',
        'lost-obligations = ["y"]',
        'block.lost-obligations changes from ["x"] to ["y"]',
    ),
    "ruled-out-situations": (
        "ruled-out-situations = true",
        "",
        "block.ruled-out-situations changes from true to false",
    ),
    "dead-hedges": ("", "dead-hedges = true", "block.dead-hedges changes from false to true"),
    "unknown": ("unknown = true", "unknown = false", "block.unknown changes from true to false"),
    "unused-suppressions": (
        "unused-suppressions = true",
        "unused-suppressions = false",
        "block.unused-suppressions changes from true to false",
    ),
    "clause-coverage": ("clause-coverage = 50", "", "block.clause-coverage changes from 50.0 to unset"),
    "certificates": ("certificates = true", "", "block.certificates changes from true to false"),
    "require-proved": ("require-proved = true", "", "block.require-proved changes from true to false"),
    "require-tied": ("require-tied = true", "", "block.require-tied changes from true to false"),
    "policy-changes": ("", "policy-changes = false", "block.policy-changes changes from true to false"),
    "new-suppressions": ("", "new-suppressions = false", "block.new-suppressions changes from true to false"),
}


def test_every_key_is_tried() -> None:
    assert KEYS.keys() == {*_SETTINGS, *_POLICIES} - {"block"}


@pytest.mark.parametrize("file", [OWN, "pyproject.toml"])
@pytest.mark.parametrize("key", KEYS)
def test_a_change_of_a_key_is_listed(key: str, file: str, cli: Cli, repository: Repository) -> None:
    before, after, what = KEYS[key]
    repository.put("known.json", '{"version": 1, "findings": []}')
    repository.put("h.sleec", "DOMAIN home\n" + HOUSEHOLD)
    repository.put("robot.py", ROBOT)
    repository.keep("known.json", "h.sleec", "robot.py")
    table = "tool.sleec-verify" if file == "pyproject.toml" else ""
    parts = [part for part in (table, "block" if key in _POLICIES else "") if part]
    head = f"[{'.'.join(parts)}]\n" if parts else ""
    before, after = (text.replace("[[targets]]", f"[[{table}.targets]]") if table else text for text in (before, after))
    repository.put(file, head + before)
    repository.keep(file)
    repository.put(file, f"# a comment\n{head}{after}\n")
    code, said = gated(cli)
    assert changes(said) == [("policy-changes", file, what)]
    assert code == 1
    assert said["blocks"][0]["policy"] == "policy-changes"


@pytest.mark.parametrize(
    ("before", "after"),
    [
        ('rulesets = ["."]\n', "# all of them\n[block]\n"),
        ('rulesets = ["sub/../a.sleec"]\n', 'rulesets = "./a.sleec"\n'),
        ('assertions = ["./must.txt"]\n', 'assertions = ["must.txt"]\n'),
        ("[block]\nclause-coverage = 0\n", "[block]\nclause-coverage = 0.0\n"),
    ],
)
def test_what_means_the_same_is_no_change(before: str, after: str, cli: Cli, repository: Repository) -> None:
    repository.put("must.txt", "never p when not c  # safety\n\n")
    repository.put(OWN, before)
    repository.keep(OWN, "must.txt")
    repository.put("must.txt", "# at home\nnever  p when not c\n")
    repository.put(OWN, after)
    assert (gated(cli)[0], gated(cli)[1]["policy_changes"]) == (0, [])
    repository.git("rm", "-q", "--cached", OWN)
    (repository.folder / OWN).unlink()
    table = f"[tool.sleec-verify]\n{after}".replace("[block]", "[tool.sleec-verify.block]")
    repository.put("pyproject.toml", table)
    assert (gated(cli)[0], gated(cli)[1]["policy_changes"]) == (0, [])


def test_changes_of_files_are_counted_and_listed(cli: Cli, repository: Repository) -> None:
    repository.put("must.txt", "never p when not c\nnever o when c\n")
    repository.put(OWN, 'baseline = "known.json"\nassertions = ["must.txt"]\n[block]\nfindings = "note"\n')
    repository.put("a.sleec", DEAD)
    assert cli("gate", "--write-baseline").code == 0
    repository.commit()
    repository.put("must.txt", "".join(f"never p when not c and {i} < {i + 1}\n" for i in range(7)) + "never o when c")
    repository.put("a.sleec", CLASH)
    assert cli("gate", "--write-baseline").code == 0
    repository.put("a.sleec", DEAD)
    _, said = gated(cli)
    assert changes(said) == [
        (
            "policy-changes",
            "known.json",
            (
                "1 finding added: SLEEC101 of a and b in a.sleec; "
                "3 findings removed: SLEEC202 of a in a.sleec, SLEEC302 of a in a.sleec, SLEEC401 of a in a.sleec"
            ),
        ),
        (
            "policy-changes",
            "must.txt",
            "7 assertions added: "
            + ", ".join(f"never p when not c and {i} < {i + 1}" for i in range(5))
            + ", …; 1 assertion removed: never p when not c",
        ),
    ]


def everything_at_once(repository: Repository, cli: Cli, *policy: str) -> None:
    """A change of each kind, of which nothing else blocks."""
    repository.put("must.txt", "never p when not c\n")
    repository.put(OWN, "\n".join(['baseline = "known.json"', 'assertions = ["must.txt"]', "[block]", *policy]))
    assert cli("gate", "--write-baseline").code == 0
    repository.commit()
    repository.put(OWN, (repository.folder / OWN).read_text() + '\nfindings = "never"\n')
    repository.put("must.txt", "never p\n")
    repository.put(
        "a.sleec", DEAD.replace("UNLESS NOT c", "# sleec: allow dead-hedge because @all `x` | y\nUNLESS NOT c")
    )
    assert cli("gate", "--write-baseline").code == 0


LISTED = (
    (OWN, 'block.findings changes from "error" to "never"'),
    ("known.json", "2 findings added: SLEEC302 of a in a.sleec"),
    ("must.txt", "1 assertion added: never p; 1 assertion removed: never p when not c"),
    ("a.sleec", "line 4 has a new suppression of dead-hedge: @all"),
)


QUOTES = {"json": '\\"', "sarif": '\\"', "gitlab": '\\"', "junit": "&quot;"}
"""How a format writes a quotation mark."""


@pytest.mark.parametrize("form", FORMATS)
@pytest.mark.parametrize("blocking", [True, False], ids=["blocks", "allowed"])
def test_every_format_lists_the_changes(form: str, blocking: bool, cli: Cli, repository: Repository) -> None:
    everything_at_once(repository, cli, *(() if blocking else ("policy-changes = false", "new-suppressions = false")))
    ran = cli("gate", "--base", "main", "--format", form, "--summary", "out.md")
    assert (ran.code, ran.err) == (1 if blocking else 0, ""), ran
    for where, what in LISTED:
        assert what.replace('"', QUOTES.get(form, '"')) in ran.out
        assert where in ran.out
    summary = (repository.folder / "out.md").read_text(encoding="utf-8")
    title = "### What blocks" if blocking else "### What changes in the policy"
    for where, what in LISTED:
        assert f"`{where}`: {what}".replace("@", "@\u200b") in summary.partition(title)[2]
    if form in ("full", "concise", "github"):
        verdict = ran.out.splitlines()[-1]
        assert verdict.endswith("4 reasons to block" if blocking else "4 changes of the policy")
        assert "1 ruleset examined" in verdict
    if form in ("concise", "github"):
        assert "\n1 ruleset: " in "\n" + ran.out


@pytest.mark.parametrize(
    ("policy", "blocked"),
    [("policy-changes = false", {"new-suppressions"}), ("new-suppressions = false", {"policy-changes"})],
)
def test_each_policy_allows_its_own(policy: str, blocked: set[str], cli: Cli, repository: Repository) -> None:
    everything_at_once(repository, cli, policy)
    code, said = gated(cli)
    assert (code, policies(said)) == (1, blocked)
    assert {one["policy"] for one in said["policy_changes"] if one["blocks"]} == blocked
    assert len(said["policy_changes"]) == 4


# What the base decides ------------------------------------------------------------------------------------


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
    assert (ran.code, "there is no baseline main:known.json" in ran.err) == (2, True)
    repository.put("known.json", '{"version": 1, "findings": []}')
    ran = cli("gate", "--base", "main")
    assert (ran.code, "there is no file main:must.txt" in ran.err) == (2, True)
    repository.put("must.txt", "never o\n")
    code, said = gated(cli)
    assert (code, policies(said)) == (1, {"policy-changes"})
    assert changes(said) == [("policy-changes", "must.txt", "1 assertion added: never o")]
    repository.put(OWN, "[block]\nfindinks = 3\n")
    repository.keep(OWN)
    repository.put(OWN, "")
    ran = cli("gate", "--base", "main")
    assert (ran.code, "main:sleec-verify.toml: has an unknown key block.findinks" in ran.err) == (2, True)


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
    for option, message in (("--config", "there is no file"), ("--baseline", "there is no baseline")):
        ran = cli("gate", "--base", "main", option, str(outside / "nothing"))
        assert (ran.code, f"{message} {outside / 'nothing'}" in ran.err) == (2, True), ran
    repository.put("ci/policy.toml", None)
    _, said = gated(cli, "--config", "ci/policy.toml")
    assert changes(said) == [("policy-changes", "ci/policy.toml", 'rulesets changes from ["a.sleec"] to ["."]')]


# Suppressions ---------------------------------------------------------------------------------------------


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


# Paths ----------------------------------------------------------------------------------------------------


PATH_KEYS = {
    "rulesets": 'rulesets = ["{}"]',
    "baseline": 'baseline = "{}"',
    "assertions": 'assertions = ["{}"]',
    "rules": '[[targets]]\ncode = "robot.py"\nrules = "{}"',
    "code": '[[targets]]\ncode = "{}"\nrules = "a.sleec"',
}
SECRET = "hunter2 is the password\n"


@pytest.fixture
def outside(tmp_path_factory: pytest.TempPathFactory) -> Path:
    made = tmp_path_factory.mktemp("outside")
    (made / "secret").write_text(SECRET)
    return made


@pytest.mark.parametrize("side", ["base", "change"])
@pytest.mark.parametrize(
    "path", ["/etc/passwd", "../outside0/secret", "..", "sub/../../outside0/secret", "{folder}/a.sleec"]
)
@pytest.mark.parametrize("key", PATH_KEYS)
def test_paths_of_the_settings_stay_inside(
    key: str, path: str, side: str, cli: Cli, repository: Repository, outside: Path
) -> None:
    repository.put("robot.py", ROBOT)
    repository.keep("robot.py")
    path = path.format(folder=repository.folder)
    repository.put(OWN, PATH_KEYS[key].format(path))
    if side == "base":
        repository.keep(OWN)
        repository.put(OWN, "")
    for command in (("gate", "--base", "main"), ("gate", "--write-baseline", "--baseline", "known.json")):
        ran = cli(*command)
        if side == "base" and "--write-baseline" in command:
            continue
        assert (ran.code, ran.out) == (2, "")
        assert "is '" in ran.err or "is ['" in ran.err
        assert "it is a path inside the repository, from the folder of the configuration" in ran.err
        assert "hunter2" not in ran.err
        assert "root:" not in ran.err


@pytest.mark.parametrize("target", ["outside", "git"])
@pytest.mark.parametrize("side", ["base", "change"])
@pytest.mark.parametrize("key", PATH_KEYS)
def test_links_of_the_settings_stay_inside(
    key: str, side: str, target: str, cli: Cli, repository: Repository, outside: Path
) -> None:
    """A link of the base is as little followed as one that the change puts in the place of a file."""
    repository.put("robot.py", ROBOT)
    repository.put(".git/description", SECRET)
    repository.put("link", '{"version": 1, "findings": []}' if key == "baseline" else "never x when y\n")
    repository.put("a.sleec", "RULE a\nWHEN y THEN x\n")
    repository.put(OWN, PATH_KEYS[key].format("link"))
    repository.keep("robot.py", "link", "a.sleec", OWN)
    (repository.folder / "link").unlink()
    (repository.folder / "link").symlink_to(
        outside / "secret" if target == "outside" else repository.folder / ".git" / "description"
    )
    if side == "base":
        repository.keep("link")
    ran = cli("gate", "--base", "main", "--all")
    assert "hunter2" not in ran.out + ran.err
    if key == "rulesets" and side == "change":
        assert "note: the link link is skipped" in ran.err
    else:
        assert ran.code == 2
        assert "link" in ran.err


@pytest.mark.parametrize(("key", "name"), [("rulesets", "-"), ("rules", "-"), ("code", "-"), ("code", "sleec_runtime")])
def test_names_mean_files_of_the_repository(
    key: str, name: str, cli: Cli, repository: Repository, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Not standard input, and not a module of Python."""
    monkeypatch.setattr("sys.stdin", None)
    repository.put("robot.py", ROBOT)
    repository.put(OWN, PATH_KEYS[key].format(name))
    repository.keep("robot.py", OWN)
    ran = cli("gate", "--base", "main")
    assert ran.code == 2
    assert "standard input" not in ran.err
    assert "there is no file or folder" in ran.err if key == "code" else f"{name}" in ran.err
    repository.put(name, "nonsense" if key != "code" else "def")
    ran = cli("gate", "--base", "main")
    assert ran.code == 2
    assert f"./{name}:1:" in ran.err or f"{name}:1:" in ran.err


def test_lines_of_other_files_are_not_printed(cli: Cli, repository: Repository) -> None:
    """A target that the change adds may name what others have put beside the rules, such as credentials."""
    repository.put("robot.py", ROBOT)
    repository.put(".env", SECRET)
    repository.keep("robot.py")
    repository.put(OWN, PATH_KEYS["rules"].format(".env"))
    ran = cli("gate", "--base", "main", "--all")
    assert ran.code == 1
    assert "targets changes from" in ran.out
    assert "hunter2" not in ran.out + ran.err


ANY = st.fixed_dictionaries(
    {},
    optional={
        "rulesets": st.sampled_from(['["nothing"]', '["good"]', '["a.sleec"]', '["good/b.sleec", "."]']),
        "baseline": st.just('"known.json"'),
        "assertions": st.sampled_from(["[]", '["never x when y"]', '["good/must.txt"]']),
        "base": st.sampled_from(['"HEAD"', '"main"']),
    },
)
ANY_POLICY = st.fixed_dictionaries(
    {},
    optional={
        "findings": st.sampled_from(['"never"', '"error"', '"note"']),
        "lost-obligations": st.sampled_from(["[]", '["*"]']),
        **dict.fromkeys(
            ("new-conflicts", "unknown", "dead-hedges", "policy-changes", "new-suppressions", "unused-suppressions"),
            st.sampled_from(["true", "false"]),
        ),
    },
)


@settings(max_examples=15, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(lines=ANY, block=ANY_POLICY, table=st.booleans())
def test_no_configuration_of_a_change_takes_a_reason_away(
    lines: dict[str, str], block: dict[str, str], table: bool, cli: Cli, repository: Repository
) -> None:
    if not (repository.folder / "good").exists():
        repository.put("good/b.sleec", OLD)
        repository.put("good/must.txt", "always o when t")
        repository.put(OWN, 'assertions = ["never q"]\n[block]\nfindings = "warning"\n')
        repository.commit()
        repository.put("known.json", '{"version": 1, "findings": []}')
        repository.put("a.sleec", CLASH + "UNLESS c IN WHICH CASE q\n")
    repository.git("checkout", "-q", "--", OWN)
    reasons = gated(cli)[1]["blocks"]
    assert len(reasons) >= 3
    head = "[tool.sleec-verify]\n" if table else ""
    text = head + "".join(f"{key} = {value}\n" for key, value in lines.items())
    text += f"[{'tool.sleec-verify.' if table else ''}block]\n"
    text += "".join(f"{key} = {value}\n" for key, value in block.items())
    if table:
        repository.put(OWN, None)
    repository.put("pyproject.toml" if table else OWN, text)
    code, said = gated(cli)
    assert code == 1
    assert [block for block in said["blocks"] if block["policy"] != "policy-changes"] == reasons
    assert said["policy_changes"]
    if table:
        repository.put("pyproject.toml", None)


@pytest.mark.parametrize("key", PATH_KEYS)
def test_patterns_are_names(key: str, cli: Cli, repository: Repository) -> None:
    repository.put("robot.py", ROBOT)
    repository.put(OWN, PATH_KEYS[key].format("*"))
    repository.keep("robot.py", OWN)
    ran = cli("gate", "--base", "main")
    assert ran.code == 2
    assert "*" in ran.err


@pytest.mark.parametrize("target", ["lax.toml", "sub/../lax.toml", "/etc/passwd", "../lax.toml", OWN, "sub"])
def test_a_configuration_may_be_a_link_inside_the_repository(target: str, cli: Cli, repository: Repository) -> None:
    repository.put("lax.toml", NEVER)
    repository.put("sub/b.sleec", OLD)
    (repository.folder / OWN).symlink_to(target)
    repository.commit()
    repository.write(a_sleec=CLASH)
    ran = cli("gate", "--base", "main")
    if target.endswith("lax.toml") and not target.startswith(".."):
        assert ran.code == 0
        (repository.folder / OWN).unlink()
        (repository.folder / OWN).symlink_to("sub/b.sleec")
        assert "is no TOML" in cli("gate", "--base", "main").err
        repository.put("strict.toml", '[block]\nfindings = "error"\n')
        (repository.folder / OWN).unlink()
        (repository.folder / OWN).symlink_to("strict.toml")
        code, said = gated(cli)
        assert (code, policies(said)) == (1, {"policy-changes"})
    elif target == "sub":
        assert gated(cli)[1]["policy_changes"] == []
    else:
        why = "cannot be read" if target == OWN else "leads out of the repository"
        assert (ran.code, f"{OWN} {why}" in ran.err) == (2, True)
    (repository.folder / OWN).unlink()
    repository.put(OWN, "")
    ran = cli("gate", "--base", "main")
    assert (f"main:{OWN} leads out of the repository" in ran.err) == (target in ("/etc/passwd", "../lax.toml", OWN))


@pytest.mark.parametrize("side", ["base", "change"])
def test_settings_that_are_too_large(side: str, cli: Cli, repository: Repository) -> None:
    repository.put(OWN, "# large\n" * 100 if side == "base" else "")
    repository.keep(OWN)
    repository.put(OWN, "# large\n" * 100 if side == "change" else "")
    ran = cli("gate", "--base", "main", "--max-size", "200")
    name = f"main:{OWN}" if side == "base" else OWN
    assert (ran.code, f"error: {name} cannot be read: it is larger than 200 bytes" in ran.err) == (2, True)


def test_files_that_cannot_be_read(cli: Cli, repository: Repository, outside: Path) -> None:
    for option in ("--config", "--baseline"):
        ran = cli("gate", "--base", "main", option, str(outside))
        assert (ran.code, f"{outside} cannot be read: " in ran.err) == (2, True)
    ran = cli("gate", "--write-baseline", "--baseline", "known.json", "--config", "nothing.toml")
    assert (ran.code, "there is no file nothing.toml" in ran.err) == (2, True)
    (repository.folder / "known.json").symlink_to("nothing.json")
    ran = cli("gate", "--write-baseline", "--baseline", "known.json")
    assert (ran.code, "there is no baseline known.json" in ran.err) == (2, True)
    repository.put("large.json", " " * 1000)
    ran = cli("gate", "--write-baseline", "--baseline", "large.json", "--max-size", "200")
    assert (ran.code, "large.json cannot be read: it is larger than 200 bytes" in ran.err) == (2, True)


@pytest.mark.parametrize("name", ["a.cases.toml", "a.certificate"])
def test_links_beside_a_ruleset_stay_inside(name: str, cli: Cli, repository: Repository, outside: Path) -> None:
    repository.put(OWN, "[block]\nclause-coverage = 1\ncertificates = true\n")
    repository.keep(OWN)
    (repository.folder / name).symlink_to(outside / "secret")
    repository.put("a.sleec", LOST)
    ran = cli("gate", "--base", "main")
    assert ran.code == 2
    assert f"{name} leads out of the repository" in ran.err
    assert "hunter2" not in ran.out + ran.err
