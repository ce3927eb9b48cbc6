"""Changes of the rules, as patches of each variant in `changes/`: applied to a copy, counted, and run."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations
from pathlib import Path
from typing import Any

from benchmarks.evaluation.lines_of_code import changed_lines, code_lines
from benchmarks.evaluation.situations import GroundTruth, every_situation
from sleec_runtime.language import parse
from sleec_runtime.model import Ruleset

ROOT = Path(__file__).parent.parent.parent
CHANGES = Path(__file__).parent / "changes"
RULES = Path("rulesets/care-robot.sleec")
VARIANTS = Path("benchmarks/evaluation/variants")


@dataclass(frozen=True)
class Outcome:
    """How a variant behaves after a change. In `wrong` of the `situations`, it does something else than the new rules
    oblige. `notice` is the reported error, or empty."""

    situations: int
    wrong: int
    notice: str

    @property
    def silently_wrong(self) -> bool:
        return self.wrong > 0 and not self.notice


def copy_system(folder: Path) -> None:
    """Copies the rules and the code of all variants."""
    for package in (Path("benchmarks"), VARIANTS.parent):
        (folder / package).mkdir(parents=True)
        shutil.copy(ROOT / package / "__init__.py", folder / package)
    shutil.copytree(ROOT / VARIANTS, folder / VARIANTS, ignore=shutil.ignore_patterns("__pycache__"))
    (folder / RULES.parent).mkdir()
    shutil.copy(ROOT / RULES, folder / RULES)


def apply(patch: str, folder: Path) -> None:
    """Applies a patch to a copy."""
    # In a repository around the folder, git would look for the files at its top.
    environment = {**os.environ, "GIT_CEILING_DIRECTORIES": str(folder.parent)}
    subprocess.run(
        ["git", "apply", "--whitespace=nowarn", "-"], cwd=folder, input=patch, text=True, env=environment, check=True
    )


def places(patch: str) -> list[str]:
    """The hunks of a patch, each as a patch by itself: the places in which a developer changes something."""
    found = []
    for part in patch.split("diff --git ")[1:]:
        heading, *hunks = part.rstrip("\n").split("\n@@ ")
        found += [f"diff --git {heading}\n@@ {hunk}\n" for hunk in hunks]
    return found


def partial_edits(patch: str) -> list[str]:
    """The patches that change some of the places, and forget the others."""
    hunks = places(patch)
    return ["".join(chosen) for number in range(1, len(hunks)) for chosen in combinations(hunks, number)]


def count_changes(patch: str, folder: Path) -> dict[str, int]:
    """The changed lines of each kind, `py` and `sleec`, if a patch is applied to a fresh copy in `folder`."""
    copy_system(folder)
    files = [path for path in folder.rglob("*.*") if path.suffix in (".py", ".sleec")]
    before = {path: code_lines(path) for path in files}
    apply(patch, folder)
    counts = {"py": 0, "sleec": 0}
    for path in files:
        counts[path.suffix[1:]] += changed_lines(before[path], code_lines(path))
    return counts


def changed_rules(change: str, folder: Path) -> Ruleset:
    """The rules after a change: the patch of CO-SLEEC changes them, and nothing else."""
    copy_system(folder)
    apply((CHANGES / change / "CO-SLEEC.patch").read_text(encoding="utf-8"), folder)
    return parse((folder / RULES).read_text(encoding="utf-8"))


def run(variant: str, folder: Path, rules: Ruleset) -> Outcome:
    """Runs the copy of a variant in every situation of `rules`, and compares what it does with what they oblige."""
    truth = GroundTruth(rules)
    cases = [(situation, rule.trigger) for rule, situation in every_situation(rules)]
    asked: Sequence[dict[str, Any]] = [
        {"domain": situation.domain, "conditions": situation.conditions, "trigger": trigger}
        for situation, trigger in cases
    ]
    process = subprocess.run(
        [sys.executable, "-m", "benchmarks.evaluation.variants.behaviour", variant],
        cwd=folder,
        input=json.dumps(asked),
        capture_output=True,
        text=True,
        check=False,
    )
    if process.returncode:
        return Outcome(len(cases), 0, process.stderr.strip().splitlines()[-1])
    answer = json.loads(process.stdout)
    if "refused" in answer:
        return Outcome(len(cases), 0, answer["refused"])
    wrong = sum(
        tuple(sorted(actions)) != tuple(truth.obligations(situation, trigger))
        for actions, (situation, trigger) in zip(answer["actions"], cases)
    )
    return Outcome(len(cases), wrong, "")
