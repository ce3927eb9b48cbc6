"""The examples of docs/dds.md: the program prints what the page shows, and the configurations are those of the code."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path
from xml.etree import ElementTree

import pytest

from sleec_runtime.ros.dds.environment import LOOPBACK
from tests.support.dds import eventually, require_dds
from tests.support.dds import transports as transports
from tests.support.paths import ROOT

require_dds()

PAGE = ROOT / "docs" / "dds.md"


def blocks(language: str) -> list[str]:
    return re.findall(rf"^```{language}\n(.*?)^```$", PAGE.read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL)


def test_the_program_of_the_page_prints_what_it_shows(
    transports: Callable[..., object], capsys: pytest.CaptureFixture[str]
) -> None:
    program: dict[str, object] = {}
    first, second = blocks("python")
    (shown,) = blocks("text")
    exec(compile(first, PAGE.name, "exec"), program)
    printed = ""

    def is_printed() -> bool:
        nonlocal printed
        printed += capsys.readouterr().out
        return "\n" in printed

    assert eventually(is_printed)
    assert printed == shown
    exec(compile(second, PAGE.name, "exec"), program)


def test_the_configurations_of_the_page() -> None:
    loopback, security = blocks("xml")
    assert loopback.strip() == LOOPBACK
    assert [child.tag for child in ElementTree.fromstring(security)[0][0]] == [
        "Authentication",
        "Cryptographic",
        "AccessControl",
    ]


def test_the_commands_of_the_page_name_what_exists() -> None:
    workspace = "".join(blocks("sh"))
    package = ROOT / "ros2/sleec_ros"
    arguments = re.findall(r"(\w+):=", workspace)
    assert f"launch sleec_ros {next(Path(package / 'launch').glob('*.py')).name}" in workspace
    assert arguments == ["rules", "task", "log"]
    assert all(f'"{one}":' in (package / "launch/sleec.launch.py").read_text(encoding="utf-8") for one in arguments)
