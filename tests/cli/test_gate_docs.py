"""The example of docs/gate.md prints what the page shows, and its settings are settings. UPDATE_DOCUMENTS=1 puts in
what is printed now."""

from __future__ import annotations

import os
import re
import shutil
from dataclasses import fields
from pathlib import Path

import pytest

from sleec_verify.gate.config import Config, Policy
from tests.cli.conftest import Cli
from tests.cli.repository import Repository

PAGE = Path(__file__).parents[2] / "docs" / "gate.md"
BLOCK = re.compile(r"`([\w.-]+)`:\n\n```(?:sleec|toml)\n(.*?)```\n", re.DOTALL)
SESSION = re.compile(r"```console\n\$ sleec-verify gate\n((?:.*\n)*?)```\n")


@pytest.mark.skipif(shutil.which("git") is None, reason="there is no git on this machine")
def test_the_example_prints_what_is_shown(cli: Cli, tmp_path: Path) -> None:
    text = PAGE.read_text(encoding="utf-8")
    (name, before), (same, after), (settings, toml) = BLOCK.findall(text)
    assert name == same
    repository = Repository(tmp_path)
    repository.put(name, before)
    repository.commit()
    repository.put(name, after)
    repository.put(settings, toml)
    ran = cli("gate")
    assert (ran.code, ran.err) == (1, "")
    shown = SESSION.sub(lambda _: f"```console\n$ sleec-verify gate\n{ran.out}```\n", text)
    if os.environ.get("UPDATE_DOCUMENTS"):
        PAGE.write_text(shown, encoding="utf-8")
    else:
        assert shown == text


def test_every_setting_is_told_of_with_its_default() -> None:
    text = PAGE.read_text(encoding="utf-8")
    told = dict(re.findall(r"^\| `\[*([a-z-]+)\]*` \| .* \| (.*) \|$", text, re.MULTILINE))
    settings = {field.name.replace("_", "-") for field in (*fields(Config), *fields(Policy))}
    assert settings - {"path", "folder", "block"} == set(told)
    for field in fields(Policy):
        default = getattr(Policy(), field.name)
        written = {None: "not asked", (): "`[]`"}.get(default, f"`{str(default).lower()}`")
        assert told[field.name.replace("_", "-")] in (written, f'`"{default}"`')
