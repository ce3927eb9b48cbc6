"""Every command explains itself, with an example that works."""

from __future__ import annotations

import re
import shlex
from pathlib import Path

import pytest

from sleec_verify.cli import run
from sleec_verify.cli.commands import sleec_verify
from tests.support.cli import Cli
from tests.support.paths import ROOT

COMMANDS = sleec_verify.list_commands(None)  # type: ignore[arg-type]


def test_commands_of_the_design_are_there() -> None:
    assert {"check", "entail", "explain", "compile", "fmt", "rules", "certify"} <= set(COMMANDS)


def test_help_lists_the_commands_and_the_exit_codes(cli: Cli) -> None:
    ran = cli("--help")
    assert ran.code == 0
    assert all(name in ran.out for name in COMMANDS)
    assert "Exit codes" in ran.out


def test_no_arguments_show_the_help(cli: Cli) -> None:
    ran = cli()
    assert ran.code == 2
    assert "Commands:" in ran.err


def test_version(cli: Cli) -> None:
    assert re.fullmatch(r"sleec-verify \d+\.\d+\.\d+\n", cli("--version").out)


@pytest.mark.parametrize("name", COMMANDS)
def test_help_shows_an_example_that_works(
    name: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    if name == "gate":
        if not (ROOT / ".git").exists():
            pytest.skip("the example asks git, and this is no repository")
        monkeypatch.chdir(ROOT)
    else:
        for folder in ("rulesets", "examples"):
            (tmp_path / folder).symlink_to(ROOT / folder)
        monkeypatch.chdir(tmp_path)  # some examples write files
    if name == "serve":  # it runs until Ctrl-C
        monkeypatch.setattr("sleec_verify.serve.server.serve", lambda *_: None)
    assert run([name, "--help"]) == 0
    shown = " ".join(capsys.readouterr().out.split())
    match = re.search(r"Example: sleec-verify (.+)$", shown)
    assert match, shown
    arguments = shlex.split(match.group(1).split(" > ")[0])
    assert run(arguments) in (0, 1)
    assert capsys.readouterr().err.startswith(("", "usage"))
