"""What proofs/README.md says is proved stands in the Coq files, all of it, and nothing there is only claimed.

Whether the proofs hold is for Coq to say (`make proofs`); this needs no Coq.
"""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from tests.support.paths import ROOT

PROOFS = ROOT / "proofs"
FILES = sorted(
    path
    for folder in ("theory", "traces", "checker", "oracle")
    for path in (PROOFS / folder).glob("*.v")
    if path.name not in ("Assumptions.v", "Extract.v")
)
BY_NAME = {path.name: path for path in FILES}
GENERATED = sorted((PROOFS / "rulesets").glob("*.v"))

PROVED = re.compile(r"^ *(?:Theorem|Lemma|Corollary) (\w+)", re.MULTILINE)
DEFINED = re.compile(r"^ *(?:Definition|Fixpoint|Inductive|Record|Example) (\w+)", re.MULTILINE)
COMMENT = re.compile(r"\(\*.*?\*\)", re.DOTALL)
CLAIMED = re.compile(
    r"\b(Admitted|admit|give_up|Axioms?|Parameters?|Conjectures?|Hypothesis|Hypotheses|Variables?|Context|bypass_check)\b"
)


def code(path: Path) -> str:
    """The file without its comments; the project's comments do not nest."""
    return COMMENT.sub("", path.read_text(encoding="utf-8"))


def table() -> list[tuple[str, str]]:
    """(file, name) for every name in the tables of the guide."""
    rows = re.findall(r"^\|[^|]+\| `(\w+\.v)` \|([^|]+)\|$", (PROOFS / "README.md").read_text("utf-8"), re.MULTILINE)
    return [(file, name) for file, names in rows for name in re.findall(r"`(\w+)`", names)]


def asked() -> set[tuple[str, str]]:
    """(file, name) for every theorem whose assumptions `make proofs` asks for."""
    texts = (code(PROOFS / folder / "Assumptions.v") for folder in ("theory", "traces", "checker", "oracle"))
    found = (pair for text in texts for pair in re.findall(r"^Print Assumptions (\w+)\.(\w+)\.$", text, re.MULTILINE))
    return {(f"{module}.v", name) for module, name in found}


@pytest.mark.parametrize("file", sorted({file for file, _ in table()}))
def test_every_name_in_the_guide_stands_in_its_file(file: str) -> None:
    text = code(BY_NAME[file])
    standing = set(PROVED.findall(text)) | set(DEFINED.findall(text))
    # Constructors and fields stand inside their types.
    missing = [n for f, n in table() if f == file and n not in standing]
    assert missing == []


def test_the_guide_names_every_theorem_that_is_asked_for() -> None:
    assert asked() - set(table()) == set()


def test_every_theorem_of_the_guide_is_asked_for() -> None:
    theorems = {(path.name, name) for path in FILES for name in PROVED.findall(code(path))}
    assert (set(table()) & theorems) - asked() == set()


def test_every_theorem_is_asked_for() -> None:
    """What is a Theorem or a Corollary is a main one; what only serves is a Lemma."""
    main = re.compile(r"^ *(?:Theorem|Corollary) (\w+)", re.MULTILINE)
    assert {(path.name, name) for path in FILES for name in main.findall(code(path))} - asked() == set()


@pytest.mark.parametrize("path", [*FILES, *GENERATED], ids=lambda path: path.name)
def test_nothing_is_only_claimed(path: Path) -> None:
    # A section's variables become arguments; make proofs would show what of them is left open.
    allowed = {"Gates.v": {"Variable", "Hypothesis"}, "Linear.v": {"Variable"}}.get(path.name, set())
    assert set(CLAIMED.findall(code(path))) - allowed == set()


def test_every_file_is_built() -> None:
    project = (PROOFS / "_CoqProject").read_text("utf-8")
    assert set(re.findall(r"^(?:theory|traces|checker|oracle)/(\w+\.v)$", project, re.MULTILINE)) == set(BY_NAME)
