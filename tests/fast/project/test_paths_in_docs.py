"""The files and folders that the documentation names exist, and the architecture page names every room."""

from __future__ import annotations

import re

import pytest

from tests.support.paths import ROOT

PAGES = [ROOT / name for name in ("README.md", "CONTRIBUTING.md", "SECURITY.md", "proofs/README.md")]
PAGES += sorted((ROOT / "docs").rglob("*.md"))
FOLDERS = ("sleec_verify", "sleec_runtime", "tests", "proofs", "benchmarks", "tools", "requirements", "website", "docs")
PATH = re.compile(rf"`((?:{'|'.join(FOLDERS)})/[\w./-]*)`")
MODULE = re.compile(r"`([a-z_]+/)*([a-z_]+\.py)`")
ENGINES = {
    "untimed.md": ("encoding", "query", "entailment", "checks"),
    "traces.md": ("encoding", "traces", "query", "replay"),
    "games.md": ("games", "replay"),
    "comparison.md": ("changes",),
}
"""The pages on engines, with the folders of `sleec_verify` whose modules they name."""


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_paths_exist(page):
    missing = [path for path in PATH.findall(page.read_text(encoding="utf-8")) if not (ROOT / path).exists()]
    assert not missing


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_our_distributions_are_not_installed_from_a_package_index(page):
    """They are not on one, so a package of their name there is not ours."""
    commands = re.findall(r"pip install [^`\n]*\bsleec-(?:runtime|verify)\b[^`\n]*", page.read_text(encoding="utf-8"))
    assert all("--no-index" in command for command in commands), commands


@pytest.mark.parametrize("page", ENGINES)
def test_modules_exist(page):
    modules = {found[2] for found in MODULE.finditer((ROOT / "docs" / page).read_text(encoding="utf-8"))}
    assert modules
    there = {path.name for folder in ENGINES[page] for path in (ROOT / "sleec_verify" / folder).rglob("*.py")}
    there |= {path.name for path in (ROOT / "tests").rglob("*.py")} | {"trace_violations.py"}
    assert modules <= there


@pytest.mark.parametrize("package", ["sleec_runtime", "sleec_verify"])
def test_every_room_is_described(package):
    page = (ROOT / "docs" / "architecture.md").read_text(encoding="utf-8")
    section = page.partition(f"## Folders of `{package}`")[2].partition("\n## ")[0]
    described = re.findall(r"^\| `(\w+)/` \|", section, re.MULTILINE)
    modules = (path.relative_to(ROOT / package).parts for path in (ROOT / package).rglob("*.py"))
    assert sorted(described) == sorted({parts[0] for parts in modules if len(parts) > 1})
