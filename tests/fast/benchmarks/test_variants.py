"""The variants of the evaluation do what the rules oblige, and changes of the rules are counted as made."""

from __future__ import annotations

from pathlib import Path

import pytest

from benchmarks.evaluation.lines_of_code import changed_lines, code_lines
from benchmarks.evaluation.rule_changes import (
    CHANGES,
    RULES,
    apply,
    copy_system,
    count_changes,
    partial_edits,
    places,
    run,
)
from benchmarks.evaluation.situations import GroundTruth, every_situation, random_situations
from benchmarks.evaluation.variants.behaviour import behaviour
from benchmarks.evaluation.variants.systems import LISTING_2, VARIANTS
from sleec_runtime.language import parse
from tests.support.paths import ROOT

RULESET = parse((ROOT / RULES).read_text(encoding="utf-8"))


@pytest.mark.parametrize("variant", [*VARIANTS, LISTING_2])
def test_variants_do_what_the_rules_oblige(variant: str) -> None:
    cases = [(situation, rule.trigger) for rule, situation in every_situation(RULESET)]
    cases += [(situation, rule.trigger) for situation in random_situations(RULESET, 100) for rule in RULESET.rules]
    asked = [{"domain": s.domain, "conditions": s.conditions, "trigger": trigger} for s, trigger in cases]
    truth = GroundTruth(RULESET)
    expected = [list(truth.obligations(situation, trigger)) for situation, trigger in cases]
    assert [sorted(actions) for actions in behaviour(variant, asked)] == expected
    assert len({tuple(actions) for actions in expected}) == 20  # nothing, and 19 clauses


def test_code_lines_have_no_comments_and_no_docstrings(tmp_path: Path) -> None:
    python, rules = tmp_path / "a.py", tmp_path / "a.sleec"
    python.write_text('"""Doc\n\nstring."""\n\n# comment\nA = 1  # code\n"""What A is."""\n')
    rules.write_text("// comment\n\nRULE r\nWHEN A THEN B  // code\n")
    assert code_lines(python) == ["A = 1  # code"]
    assert code_lines(rules) == ["RULE r", "WHEN A THEN B  // code"]


def test_a_modified_line_counts_once() -> None:
    assert changed_lines(["a", "b", "c"], ["a", "x", "c", "d"]) == 2
    assert changed_lines(["a", "b"], ["b"]) == 1


@pytest.mark.parametrize("patch", sorted(CHANGES.rglob("*.patch")), ids=lambda path: f"{path.parent.name}-{path.stem}")
def test_every_patch_applies(patch: Path, tmp_path: Path) -> None:
    text = patch.read_text(encoding="utf-8")
    counts = count_changes(text, tmp_path / "copy")
    assert (counts["sleec"] > 0) == patch.stem.startswith("CO-SLEEC")
    assert counts["py"] == 0 or patch.stem != "CO-SLEEC"
    assert len(partial_edits(text)) == 2 ** len(places(text)) - 2


def test_a_forgotten_place_goes_unnoticed(tmp_path: Path) -> None:
    change = CHANGES / "insert-exception"
    copy_system(tmp_path / "rules")
    apply((change / "CO-SLEEC.patch").read_text(encoding="utf-8"), tmp_path / "rules")
    changed = parse((tmp_path / "rules" / RULES).read_text(encoding="utf-8"))
    whole = (change / "CS-libs.patch").read_text(encoding="utf-8")
    only_context_manager, only_tasks = partial_edits(whole)
    for number, (patch, wrong) in enumerate([(whole, 0), (only_context_manager, 3), (only_tasks, 5)]):
        folder = tmp_path / str(number)
        copy_system(folder)
        apply(patch, folder)
        outcome = run("CS-libs", folder, changed)
        assert (outcome.wrong, outcome.notice) == (wrong, "")
