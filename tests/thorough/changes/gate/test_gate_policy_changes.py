"""What a change does to the policy is listed, and blocks unless the base allows it."""

from __future__ import annotations

import shutil

import pytest

from sleec_verify.changes.gate.keys import POLICIES, SETTINGS
from sleec_verify.report import FORMATS
from tests.support.cli import Cli
from tests.support.gate_policies import HOUSEHOLD, OWN, ROBOT, changes
from tests.support.gates import CLASH, DEAD, gated, policies, with_fingerprints
from tests.support.repository import Repository

pytestmark = pytest.mark.skipif(shutil.which("git") is None, reason="there is no git on this machine")
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
    "deletions": ("", "deletions = false", "block.deletions changes from true to false"),
    "policy-changes": ("", "policy-changes = false", "block.policy-changes changes from true to false"),
    "new-suppressions": ("", "new-suppressions = false", "block.new-suppressions changes from true to false"),
}


def test_every_key_is_tried() -> None:
    assert KEYS.keys() == {*SETTINGS, *POLICIES} - {"block"}


@pytest.mark.parametrize("file", [OWN, "pyproject.toml"])
@pytest.mark.parametrize("key", KEYS)
def test_a_change_of_a_key_is_listed(key: str, file: str, cli: Cli, repository: Repository) -> None:
    before, after, what = KEYS[key]
    repository.put("known.json", '{"version": 1, "findings": []}')
    repository.put("h.sleec", "DOMAIN home\n" + HOUSEHOLD)
    repository.put("robot.py", ROBOT)
    repository.keep("known.json", "h.sleec", "robot.py")
    table = "tool.sleec-verify" if file == "pyproject.toml" else ""
    parts = [part for part in (table, "block" if key in POLICIES else "") if part]
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
        "a.sleec",
        with_fingerprints(
            DEAD.replace("UNLESS NOT c", "# sleec: allow dead-hedge@? because @all `x` | y\nUNLESS NOT c")
        ),
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
    title = "### Reasons to block" if blocking else "### Policy changes"
    for where, what in LISTED:
        assert f"`{where}`: {what}".replace("@", "@\u200b") in summary.partition(title)[2]
    if form in ("full", "concise", "github"):
        verdict = ran.out.splitlines()[-1]
        assert verdict.endswith("4 reasons to block" if blocking else "4 policy changes")
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
