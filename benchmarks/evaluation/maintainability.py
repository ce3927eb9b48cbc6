"""E3: lines of code of each variant, lines to change a rule, and what happens if a developer forgets a place."""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import NamedTuple

from benchmarks.evaluation.lines_of_code import code_lines
from benchmarks.evaluation.rule_changes import (
    CHANGES,
    ROOT,
    RULES,
    VARIANTS,
    Outcome,
    apply,
    changed_rules,
    copy_system,
    count_changes,
    partial_edits,
    places,
    run,
)
from benchmarks.evaluation.variants.systems import LISTING_2

FOLDERS = {"CO-SLEEC": "co_sleec", LISTING_2: "listing_2", "CS-libs": "cs_libs", "CS-libs-CM": "cs_libs_cm"}


class Size(NamedTuple):
    """The lines of code of a variant. All variants share the robot's actions and the topics."""

    variant: str
    python: int
    rules: int
    shared: int


class Edit(NamedTuple):
    """A change of the rules in one variant: its lines, its places, and the behaviour after it.

    `partial` counts the subsets of the places, where a developer forgets the others. `unnoticed` of them leave the
    variant wrong without an error.
    """

    change: str
    variant: str
    python: int
    rules: int
    places: int
    situations: int
    wrong: int
    notice: str
    partial: int
    unnoticed: int


def sizes() -> list[Size]:
    """The size of each variant."""
    shared = sum(len(code_lines(path)) for path in (ROOT / VARIANTS / name for name in ("robot.py", "topics.py")))
    rules = len(code_lines(ROOT / RULES))
    return [
        Size(
            variant,
            sum(len(code_lines(path)) for path in sorted((ROOT / VARIANTS / folder).glob("*.py"))),
            0 if variant.startswith("CS-libs") else rules,
            shared,
        )
        for variant, folder in FOLDERS.items()
    ]


def edits(with_partial: bool) -> list[Edit]:
    """Every change in every variant. `with_partial` also runs the partial edits."""
    return [
        _edit(patch, with_partial) for change in sorted(CHANGES.iterdir()) for patch in sorted(change.glob("*.patch"))
    ]


def _edit(path: Path, with_partial: bool) -> Edit:
    change, variant = path.parent.name, path.stem
    patch = path.read_text(encoding="utf-8")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        rules = changed_rules(change, folder / "rules")
        counts = count_changes(patch, folder / "whole")
        system = variant.partition(" (")[0]
        whole = run(system, folder / "whole", rules)
        partial: list[Outcome] = []
        texts = partial_edits(patch) if with_partial else []
        if with_partial and not counts["sleec"]:
            texts.append("")  # only the text of the rules changes, which this variant does not read
        for number, text in enumerate(texts):
            copy = folder / str(number)
            copy_system(copy)
            if text:
                apply(text, copy)
            partial.append(run(system, copy, rules))
    return Edit(
        change,
        variant,
        counts["py"],
        counts["sleec"],
        len(places(patch)),
        whole.situations,
        whole.wrong,
        whole.notice,
        len(partial),
        sum(outcome.silently_wrong for outcome in partial),
    )
