"""Paths in the settings of `gate` stay inside the repository."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from tests.support.cli import Cli
from tests.support.gate_policies import NEVER, OWN, ROBOT, SECRET
from tests.support.gates import CLASH, LOST, OLD, gated, policies
from tests.support.repository import Repository

pytestmark = pytest.mark.skipif(shutil.which("git") is None, reason="there is no git on this machine")
PATH_KEYS = {
    "rulesets": 'rulesets = ["{}"]',
    "baseline": 'baseline = "{}"',
    "assertions": 'assertions = ["{}"]',
    "rules": '[[targets]]\ncode = "robot.py"\nrules = "{}"',
    "code": '[[targets]]\ncode = "{}"\nrules = "a.sleec"',
}


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
    assert f"{name} does not exist" in ran.err if key == "code" else f"{name}" in ran.err
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
        assert "is not TOML" in cli("gate", "--base", "main").err
        repository.put("strict.toml", '[block]\nfindings = "error"\n')
        (repository.folder / OWN).unlink()
        (repository.folder / OWN).symlink_to("strict.toml")
        code, said = gated(cli)
        assert (code, policies(said)) == (1, {"policy-changes"})
    elif target == "sub":
        assert gated(cli)[1]["policy_changes"] == []
    else:
        why = "cannot be read" if target == OWN else "points outside the repository"
        assert (ran.code, f"{OWN} {why}" in ran.err) == (2, True)
    (repository.folder / OWN).unlink()
    repository.put(OWN, "")
    ran = cli("gate", "--base", "main")
    assert (f"main:{OWN} points outside the repository" in ran.err) == (target in ("/etc/passwd", "../lax.toml", OWN))


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
    assert (ran.code, "file nothing.toml does not exist" in ran.err) == (2, True)
    (repository.folder / "known.json").symlink_to("nothing.json")
    ran = cli("gate", "--write-baseline", "--baseline", "known.json")
    assert (ran.code, "baseline known.json does not exist" in ran.err) == (2, True)
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
    assert f"{name} points outside the repository" in ran.err
    assert "hunter2" not in ran.out + ran.err
