"""Shell completion: the scripts, run by the shells that are here."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from sleec_verify.cli.commands import sleec_verify
from tests.support.cli import Cli
from tests.support.paths import ROOT

COMMANDS = sleec_verify.list_commands(None)  # type: ignore[arg-type]


@pytest.fixture
def home(tmp_path: Path) -> Path:
    """A folder with some rules, and with the command in `bin`."""
    (tmp_path / "bin").mkdir()
    command = tmp_path / "bin" / "sleec-verify"
    command.write_text(f'#!/bin/sh\nexec "{sys.executable}" -m sleec_verify "$@"\n')
    command.chmod(0o755)
    (tmp_path / "night.sleec").write_text("WHEN Rung THEN Open\n")
    return tmp_path


def environment(home: Path) -> dict[str, str]:
    path = f"{home / 'bin'}{os.pathsep}{os.environ['PATH']}"
    return {**os.environ, "PATH": path, "PYTHONPATH": str(ROOT), "HOME": str(home)}


def in_bash(home: Path, *words: str) -> list[str]:
    """What bash offers for the last of the words: the script is sourced, and its function called as bash does."""
    if shutil.which("bash") is None:
        pytest.skip("there is no bash here")
    script = (
        'eval "$(sleec-verify completion bash)" || exit 1\n'
        'COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); COMPREPLY=()\n'
        'name=$(complete -p sleec-verify | sed "s/.*-F \\([^ ]*\\).*/\\1/")\n'
        "compopt() { :; }\n"  # what it sets is of use in an interactive shell only
        '"$name" sleec-verify\n'
        'printf "%s\\n" "${COMPREPLY[@]}"\n'
    )
    done = subprocess.run(
        ["bash", "--norc", "-c", script, "bash", *words],
        cwd=home,
        env=environment(home),
        capture_output=True,
        text=True,
    )
    assert (done.returncode, done.stderr) == (0, "")
    return done.stdout.split()


def test_bash_completes_commands(home: Path) -> None:
    assert in_bash(home, "sleec-verify", "") == COMMANDS
    assert in_bash(home, "sleec-verify", "con") == ["conform", "convert"]


def test_bash_completes_options_and_their_values(home: Path) -> None:
    assert in_bash(home, "sleec-verify", "check", "--wa") == ["--watch"]
    assert in_bash(home, "sleec-verify", "check", "--format", "g") == ["github", "gitlab"]
    assert in_bash(home, "sleec-verify", "--vers") == ["--version"]


def test_bash_completes_codes_and_checks(home: Path) -> None:
    assert in_bash(home, "sleec-verify", "rules", "SLEEC10") == [f"SLEEC10{i}" for i in range(1, 9)]
    assert in_bash(home, "sleec-verify", "rules", "dead-") == ["dead-rule", "dead-hedge"]
    assert in_bash(home, "sleec-verify", "rules", "sleec20") == ["SLEEC201", "SLEEC202"]


@pytest.mark.parametrize("shell", ["zsh", "fish"])
def test_the_other_shells_take_their_scripts(shell: str, home: Path, cli: Cli) -> None:
    ran = cli("completion", shell)
    assert ran.code == 0
    assert f"_SLEEC_VERIFY_COMPLETE={shell}_complete" in ran.out
    if shutil.which(shell) is None:
        pytest.skip(f"there is no {shell} here to run it")
    script = home / "script"
    script.write_text(ran.out)
    subprocess.run([shell, "-n", str(script)], check=True, env=environment(home))


@pytest.mark.skipif(shutil.which("fish") is None, reason="there is no fish here")
@pytest.mark.parametrize(
    ("line", "offered"),
    [
        ("con", ["conform", "convert"]),
        ("check --format g", ["github", "gitlab"]),
        ("check ni", ["night.sleec"]),
        ("gate --basel", ["--baseline"]),
    ],
)
def test_fish_completes(line: str, offered: list[str], home: Path) -> None:
    script = f"sleec-verify completion fish | source; complete -C 'sleec-verify {line}'"
    done = subprocess.run(
        ["fish", "--no-config", "-c", script], cwd=home, env=environment(home), capture_output=True, text=True
    )
    assert [answer.partition("\t")[0] for answer in done.stdout.splitlines()] == offered


@pytest.mark.skipif(shutil.which("zsh") is None, reason="there is no zsh here")
def test_zsh_knows_who_completes(home: Path) -> None:
    script = (
        'autoload -U compinit; compinit -u -D; eval "$(sleec-verify completion zsh)"; '
        "print $_comps[sleec-verify]; whence -w $_comps[sleec-verify]"
    )
    done = subprocess.run(["zsh", "-f", "-c", script], cwd=home, env=environment(home), capture_output=True, text=True)
    assert done.stderr == ""
    name, kind = done.stdout.splitlines()
    assert kind == f"{name}: function"


@pytest.mark.parametrize("shell", ["zsh", "fish"])
def test_what_the_other_shells_ask_is_answered(shell: str, home: Path) -> None:
    """Their scripts ask the command like this; zsh and fish are told what a command is for, too."""
    words = {"COMP_WORDS": "sleec-verify con", "COMP_CWORD": "1" if shell == "zsh" else "con"}
    asked = {**environment(home), **words, "_SLEEC_VERIFY_COMPLETE": f"{shell}_complete"}
    line = [sys.executable, "-m", "sleec_verify"]
    done = subprocess.run(line, env=asked, capture_output=True, text=True, check=True)
    assert "conform" in done.stdout
    assert "convert" in done.stdout
    assert "Translate rules into another language or reading." in done.stdout
    assert "check" not in done.stdout


def test_an_unknown_shell(cli: Cli) -> None:
    ran = cli("completion", "tcsh")
    assert ran.code == 2
    assert "'bash', 'zsh', 'fish'" in ran.err
