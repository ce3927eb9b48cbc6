"""The examples of README and docs are run, and every block of code is an example. UPDATE_DOCUMENTS=1 puts in what the
commands print now."""

from __future__ import annotations

import os
import re
import shutil
from pathlib import Path

import pytest

from sleec_runtime.language import parse
from tests.support.paths import ROOT
from tests.support.sessions import as_printed, blocks, commands
from website.refused import with_answers

DOCS = ROOT / "docs"
PAGES = [
    *(ROOT / name for name in ("README.md", "sleec_runtime/README.md", "SECURITY.md", "CONTRIBUTING.md")),
    *sorted(DOCS.rglob("*.md")),
]
NAMES = [str(page.relative_to(ROOT)) for page in PAGES]

PARSED = {"sleec", "sleec-bad", "dsl", "dsl-bad"}
"""What tests/language reads on every page."""

IN_TESTS_OF_THEIR_PAGES = {
    "docs/runtime.md": {"python", "text"},
    "docs/deadlines.md": {"python", "text"},
    "docs/restart.md": {"python", "text"},
    "docs/ros.md": {"python", "text"},
    "docs/monitor.md": {"python", "text", "sh"},
    "docs/dds.md": {"python", "text", "sh", "xml"},
    "docs/conformance-tests.md": {"python", "text"},
    "docs/cases.md": {"toml"},
    "docs/times.md": {"text"},
    "docs/certificates.md": {"sh", "python"},
    "docs/ci.md": {"sh", "yaml"},
    "docs/audit-fleet.md": {"sh"},
    "docs/serve.md": {"sh"},
    "docs/gate.md": {"toml", "yaml"},
    "README.md": {""},
    "sleec_runtime/README.md": {"sh"},
    "SECURITY.md": {"sh"},
}
"""What is not run by commands, and what the tests of the page run in some way of their own."""


IN_REPOSITORIES = {"docs/gate.md"}
"""Pages whose commands ask git, and are run by the tests of the page in a repository."""


@pytest.mark.parametrize(
    "page", [page for page, name in zip(PAGES, NAMES) if name not in IN_REPOSITORIES], ids=lambda page: page.stem
)
def test_commands_print_what_is_shown(page: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    # A reader of a tutorial begins with nothing.
    for folder in () if page.parent.name == "tutorials" else ("rulesets", "examples"):
        shutil.copytree(ROOT / folder, tmp_path / folder, ignore=shutil.ignore_patterns("__pycache__"))
    monkeypatch.chdir(tmp_path)
    text = page.read_text(encoding="utf-8")
    shown = as_printed(text)
    if os.environ.get("UPDATE_DOCUMENTS"):
        page.write_text(shown, encoding="utf-8")
    else:
        assert shown == text


@pytest.mark.parametrize("page", PAGES, ids=NAMES)
def test_every_block_is_an_example_that_is_run(page: Path) -> None:
    text = page.read_text(encoding="utf-8")
    found = blocks(text)
    assert 2 * len(found) == len(re.findall(r"^ *```", text, re.M))
    known = PARSED | {"console"} | IN_TESTS_OF_THEIR_PAGES.get(str(page.relative_to(ROOT)), set())
    assert {block.language for block in found if block.title is None} <= known


@pytest.mark.parametrize("page", PAGES, ids=NAMES)
def test_what_is_refused_is_shown_with_its_answer(page: Path) -> None:
    text = page.read_text(encoding="utf-8")
    bad = sum(block.language.endswith("-bad") for block in blocks(text))
    assert with_answers(text).count("{ .text .refusal }") == bad


def test_the_workflow_runs_what_the_page_runs() -> None:
    found = blocks((DOCS / "tutorials/ci.md").read_text("utf-8"))
    (workflow,) = (block.body for block in found if block.title == ".github/workflows/rules.yml")
    steps = [step for step in re.findall(r"- run: (.*)", workflow) if not step.startswith("pip install")]
    assert steps
    # There, the branch is the one that was fetched.
    assert {step.replace("origin/", "") for step in steps} <= {line for block in found for line in commands(block)}
    assert "fetch-depth: 0" in workflow, "the gate asks for the history"


def test_the_home_pages_rule_is_the_readmes() -> None:
    (shown,) = (b.body for b in blocks((DOCS / "index.md").read_text("utf-8")) if b.language == "sleec")
    assert shown in (ROOT / "README.md").read_text("utf-8")
    assert len(parse(shown).rules) == 1
