"""A change under review does not decide its own verdict: the base does."""

from __future__ import annotations

import shutil
from collections.abc import Callable

import pytest

from tests.support.cli import Cli
from tests.support.gate_policies import HOUSEHOLD, NEVER, OWN, ROBOT, changes
from tests.support.gates import CLASH, LOST, OLD, TIMED, TIMED_ELSE, gated, policies, with_fingerprints
from tests.support.repository import Repository

pytestmark = pytest.mark.skipif(shutil.which("git") is None, reason="there is no git on this machine")
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
    repository.put(
        "a.sleec", with_fingerprints(CLASH.replace("RULE b", "// sleec: allow SLEEC101@? because fine\nRULE b"))
    )


def a_suppression_of_a_check(repository: Repository, cli: Cli) -> None:
    repository.put(
        "a.sleec", with_fingerprints(CLASH.replace("NOT o", "NOT o  # sleec: allow conflict@? because fine"))
    )


def one_more_code(repository: Repository, cli: Cli) -> None:
    repository.put("a.sleec", OLD.replace("RULE", "# sleec: allow SLEEC401 because fine\nRULE"))
    repository.keep("a.sleec")
    repository.put(
        "a.sleec",
        with_fingerprints(CLASH.replace("RULE a", "# sleec: allow SLEEC401, SLEEC101@? because fine\nRULE a")),
    )


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
    assert gated(cli)[0] == 0, "the same rules are behind the link"
    repository.put("good/b.sleec", LOST)
    for paths in ((), ("rules",)):
        code, said = gated(cli, *paths)
        assert (code, policies(said)) == (1, {"lost-obligations"})
        assert "rules/b.sleec" in {block["where"] for block in said["blocks"]}


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
