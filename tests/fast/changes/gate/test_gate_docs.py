"""The example of docs/gate.md prints what the page shows, and its settings are settings. UPDATE_DOCUMENTS=1 puts in
what is printed now."""

from __future__ import annotations

import os
import re
import shlex
import shutil
from pathlib import Path

import pytest
import yaml

from sleec_verify.changes.gate.config import Config
from sleec_verify.changes.gate.keys import Policy
from sleec_verify.cli.gate import command as gate_command
from tests.support.cli import Cli
from tests.support.paths import ROOT
from tests.support.repository import Repository

PAGE = ROOT / "docs" / "gate.md"
BLOCK = re.compile(r"`([\w.-]+)`:\n\n```(?:sleec|toml)\n(.*?)```\n", re.DOTALL)
SESSION = re.compile(r"```console\n\$ sleec-verify (gate.*)\n((?:.*\n)*?)```\n")
SUPPRESSED = re.compile(r"```sleec\n((?:(?!```).*\n)*?// sleec: allow (SLEEC\d+)@\w+ because (.*)\n(?:.*\n)*?)```\n")

pytestmark = pytest.mark.skipif(shutil.which("git") is None, reason="git is not installed")


def test_the_examples_print_what_is_shown(cli: Cli, tmp_path: Path) -> None:
    text = PAGE.read_text(encoding="utf-8")
    (name, before), (same, after), (settings, toml) = BLOCK.findall(text)
    assert name == same
    repository = Repository(tmp_path)
    repository.put(name, before)
    repository.put(settings, toml)
    repository.commit()
    repository.put(name, after)
    assert len(SESSION.findall(text)) == text.count("```console")

    def run(shown: re.Match[str]) -> str:
        ran = cli(*shlex.split(shown[1]))
        assert (ran.code, ran.err) == (1, "")
        return f"```console\n$ sleec-verify {shown[1]}\n{ran.out}```\n"

    shown = SESSION.sub(run, text)
    if os.environ.get("UPDATE_DOCUMENTS"):
        PAGE.write_text(shown, encoding="utf-8")
    else:
        assert shown == text


def test_the_suppression_allows_what_it_says(cli: Cli, tmp_path: Path) -> None:
    (match,) = SUPPRESSED.finditer(PAGE.read_text(encoding="utf-8"))
    repository = Repository(tmp_path)
    repository.put("sleec-verify.toml", "[block]\ndead-hedges = true\nnew-suppressions = false\n")
    repository.commit()
    repository.put("door.sleec", match[1])
    ran = cli("gate", "--base", "main")
    assert ran.code == 0, ran
    assert f"allowed: {match[2]} " in ran.out
    assert f" (reason: {match[3]})\n" in ran.out
    repository.put("door.sleec", match[1].replace("// sleec: allow", "// was"))
    assert cli("gate", "--base", "main").code == 1


def test_the_step_in_ci_is_a_command() -> None:
    (text,) = re.findall(r"```yaml\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.DOTALL)
    checkout, gate = yaml.safe_load(text)
    assert checkout["with"]["fetch-depth"] == 0
    command, name, *arguments = shlex.split(gate["run"])
    assert (command, name) == ("sleec-verify", "gate")
    gate_command.make_context(name, arguments)


def test_every_setting_is_told_of_with_its_default() -> None:
    text = PAGE.read_text(encoding="utf-8")
    told = dict(re.findall(r"^\| `\[*([a-z-]+)\]*` \| .* \| (.*) \|$", text, re.MULTILINE))
    settings = {field.replace("_", "-") for field in (*Config._fields, *Policy._fields)}
    assert settings - {"path", "folder", "block"} == set(told)
    for field in Policy._fields:
        default = getattr(Policy(), field)
        written = {None: "not checked", (): "`[]`"}.get(default, f"`{str(default).lower()}`")
        assert told[field.replace("_", "-")] in (written, f'`"{default}"`')
