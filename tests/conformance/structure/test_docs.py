"""The example of the guide gives what the guide shows."""

from __future__ import annotations

import re
from pathlib import Path

from tests.cli.conftest import Cli, cli

__all__ = ["cli"]

GUIDE = Path(__file__).parents[3] / "docs" / "conformance.md"


def test_the_example_of_the_guide(cli: Cli) -> None:
    text = GUIDE.read_text(encoding="utf-8")
    section = text[text.index("## Properly structured") : text.index("### How code is read")]
    rules, code, said = (
        re.findall(rf"^```{kind}\n(.*?)^```$", section, re.M | re.S) for kind in ("sleec", "python", "text")
    )
    (command,) = re.findall(r"^\$ sleec-verify (.*)$", section, re.M)
    ran = cli(*command.split(), files={"rules.sleec": rules[0], "robot.py": code[0]})
    assert ran == (1, said[0], "")
