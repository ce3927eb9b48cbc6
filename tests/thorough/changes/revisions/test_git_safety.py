"""Git runs no program that the repository at hand names, fetches nothing, and takes no embedded repository for one."""

from __future__ import annotations

import os
import shutil
import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest

from tests.support.cli import Cli
from tests.support.gates import CLASH, LOST, OLD
from tests.support.repository import Repository

pytestmark = [
    pytest.mark.skipif(shutil.which("git") is None, reason="git is not installed"),
    pytest.mark.skipif(os.name != "posix", reason="the programs are shell scripts"),
]

COMMANDS = {
    "gate": ("gate", "--base", "main"),
    "gate --all": ("gate", "--base", "main", "--all"),
    "gate --write-baseline": ("gate", "--write-baseline", "--baseline", "known.json"),
    "diff": ("diff", "--git", "main"),
    "diff of revisions": ("diff", "--git", "main~1..main"),
    "a misspelt revision": ("gate", "--base", "mian"),
}
TRIGGERS: dict[str, tuple[str, ...] | None] = {
    "core.fsmonitor": ("status",),
    "core.hooksPath": ("commit", "--allow-empty", "-m", "x"),
    "core.sshCommand": ("ls-remote", "ssh://nobody@localhost/x"),
    "core.gitProxy": ("ls-remote", "git://localhost/x"),
    "core.askPass": ("credential", "fill"),
    "credential.helper": ("credential", "fill"),
    "core.editor": ("config", "--local", "--edit"),
    "core.pager": None,  # asks for a terminal
    "pager.diff": None,
    "pager.ls-tree": None,
    "sequence.editor": None,  # asks for a rebase
    "diff.external": ("diff", "main~1"),
    "diff.x.command": ("diff", "main~1"),
    "diff.x.textconv": ("diff", "main~1"),
    "filter.x.clean": ("add", "a.sleec"),
    "filter.x.process": ("add", "a.sleec"),
    "filter.x.smudge": ("cat-file", "--filters", "main:a.sleec"),
    "merge.x.driver": None,  # asks for a merge
    "alias.run": ("run",),
    "alias.ls-tree": None,  # git never lets an alias stand for a command of its own
    "gpg.program": ("commit", "-S", "--allow-empty", "-m", "x"),
    "uploadpack.packObjectsHook": None,  # counts only in protected settings
    "remote.origin.uploadpack": ("fetch", "origin"),
    "core.alternateRefsCommand": None,  # asks for a fetch with alternates
}
"""Settings that name a program, each with a command of git that runs it."""


@pytest.fixture
def repository(tmp_path: Path) -> Repository:
    made = Repository(tmp_path)
    made.put(".gitattributes", "* filter=x diff=x merge=x\n")
    made.put("sleec-verify.toml", 'rulesets = ["."]\n[block]\ncertificates = true\nclause-coverage = 1\n')
    made.commit(a_sleec=OLD, b_sleec=OLD, a_cases_toml='[[case]]\nwhen = ["t"]\nobligations = ["o"]\n')
    made.put("a.certificate/manifest.json", "{}")
    made.commit(a_sleec=LOST)
    made.git("remote", "add", "origin", str(tmp_path))
    made.write(a_sleec=CLASH, b_sleec=OLD)  # b has a new date only, so that git would look at its text
    return made


def program(folder: Path) -> Path:
    """A program that says that it was run, by a file `ran` beside it."""
    folder.mkdir(exist_ok=True)
    script = folder / "program"
    script.write_text(f'#!/bin/sh\necho "$0 $*" >> "{folder}/ran"\nexit 1\n')
    script.chmod(0o755)
    return script


def setting(name: str, script: Path) -> str:
    if name == "core.hooksPath":
        for hook in ("pre-commit", "post-index-change", "post-checkout", "reference-transaction", "fsmonitor-watchman"):
            shutil.copy(script, script.parent / hook)
        return str(script.parent)
    if name.startswith("alias."):
        return f"!{script}"
    return f"{script} %f" if name.startswith("filter.") else str(script)


@pytest.fixture
def outside(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("outside")


def run_git(folder: Path, *arguments: str) -> None:
    """A command of git that may fail."""
    environment = {**os.environ, "GIT_CONFIG_GLOBAL": os.devnull, "GIT_CONFIG_SYSTEM": os.devnull}
    environment |= {"GIT_TERMINAL_PROMPT": "0"}
    subprocess.run(
        ["git", *arguments],
        cwd=folder,
        input=b"protocol=https\nhost=localhost\n\n",
        capture_output=True,
        check=False,
        env=environment,
    )


@pytest.mark.parametrize("name", TRIGGERS)
def test_no_program_of_the_settings_is_run(name: str, cli: Cli, repository: Repository, outside: Path) -> None:
    script = program(outside)
    repository.git("config", name, setting(name, script))
    trigger = TRIGGERS[name]
    if trigger is not None:  # the setting does run it
        run_git(repository.folder, *trigger)
        assert (outside / "ran").exists()
        (outside / "ran").unlink()
        repository.write(a_sleec=CLASH + "// again\n", b_sleec=OLD)
    for command in COMMANDS.values():
        ran = cli(*command)
        assert ran.code in (1, 0) or "did you mean main?" in ran.err, ran
        assert not (outside / "ran").exists(), (command, (outside / "ran").read_text())


def test_no_hook_is_run(cli: Cli, repository: Repository, outside: Path) -> None:
    script = program(outside)
    for hook in ("pre-commit", "post-index-change", "post-checkout", "reference-transaction", "fsmonitor-watchman"):
        shutil.copy(script, repository.folder / ".git" / "hooks" / hook)
    for command in COMMANDS.values():
        cli(*command)
        assert not (outside / "ran").exists(), command


Embed = Callable[[Path, Path], None]


def as_bare(folder: Path, script: Path) -> None:
    run_git(folder, "init", "-q", "--bare", ".")
    run_git(folder, "config", "core.fsmonitor", str(script))


def with_files(folder: Path, script: Path) -> None:
    """It says that the folder is its own working tree."""
    as_bare(folder, script)
    (folder / "config").write_text(
        f"[core]\n\trepositoryformatversion = 0\n\tbare = false\n\tworktree = .\n\tfsmonitor = {script}\n"
    )


@pytest.mark.parametrize("known", [True, False], ids=["git knows safe.bareRepository", "git is older"])
@pytest.mark.parametrize("embed", [as_bare, with_files])
@pytest.mark.parametrize("command", COMMANDS)
def test_an_embedded_repository_is_none(
    command: str,
    embed: Embed,
    known: bool,
    cli: Cli,
    repository: Repository,
    outside: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    embedded = repository.folder / "robot.git"
    embedded.mkdir()
    embed(embedded, program(outside))
    (embedded / "a.sleec").write_text(OLD)
    if embed is with_files:
        run_git(embedded, "status")
        assert (outside / "ran").exists(), "git runs it"
        (outside / "ran").unlink()
    if not known:
        from sleec_verify.changes.revisions import git

        settings = tuple(one for one in git.SETTINGS if not one.startswith("safe."))
        assert len(settings) == len(git.SETTINGS) - 1
        monkeypatch.setattr(git, "SETTINGS", settings)
    monkeypatch.chdir(embedded)
    ran = cli(*COMMANDS[command])
    assert ran.code == 2
    assert not (outside / "ran").exists()
    assert "error: the current folder is inside a git directory\n" in ran.err


def test_nothing_is_fetched(cli: Cli, repository: Repository, outside: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    script = program(outside)
    repository.git("config", "uploadpack.allowFilter", "true")
    repository.git("commit", "-q", "-a", "-m", "change")
    clone = outside / "clone"
    url = repository.folder.as_uri()
    repository.git("clone", "-q", "--filter=blob:none", url, str(clone))
    for name, value in (
        ("remote.origin.url", f"ext::{script}"),
        ("protocol.ext.allow", "always"),
        ("core.sshCommand", str(script)),
    ):
        run_git(clone, "config", name, value)
    monkeypatch.chdir(clone)
    (clone / "a.sleec").write_text(OLD + "// changed\n")
    ran = cli("gate", "--base", "main~1")
    assert ran.code == 2
    assert "git cannot read the object" in ran.err
    assert "clone without --filter" in ran.err
    assert not (outside / "ran").exists()
    run_git(clone, "cat-file", "blob", "main~1:a.sleec")
    assert (outside / "ran").exists(), "git would fetch it"
