"""What the README says of the project's files. Its commands are run by test_docs.py."""

from __future__ import annotations

import re

from tests.support.paths import ROOT

README = ROOT / "README.md"


def test_quick_start_is_two_targets_of_the_makefile() -> None:
    quick = re.search(r"## Quick start\n.*?```\n(.*?)```", README.read_text(encoding="utf-8"), re.DOTALL)
    assert quick
    commands = quick.group(1).splitlines()
    assert len(commands) == 2
    makefile = (ROOT / "Makefile").read_text(encoding="utf-8")
    for command in commands:
        make, target = command.split()
        assert make == "make"
        assert re.search(rf"^{target}:", makefile, re.MULTILINE)


def test_what_is_linked_exists() -> None:
    for name in (
        "README.md",
        "SECURITY.md",
        "CONTRIBUTING.md",
        "docs/ci.md",
        "rulesets/README.md",
        "rulesets/studies/README.md",
    ):
        text = (ROOT / name).read_text(encoding="utf-8")
        for link in re.findall(r"\]\(([^)#:]+)\)", text):
            assert ((ROOT / name).parent / link).exists(), f"{name} links to {link}"


def test_folders_exist() -> None:
    folders = re.findall(r"^\| `([\w_]+)/` \|", README.read_text(encoding="utf-8"), re.MULTILINE)
    assert folders
    assert all((ROOT / folder).is_dir() for folder in folders)
