"""The oracle of explicit states against examples from an automaton that shares nothing with the project."""

from __future__ import annotations

import json
from typing import Any

import pytest

from sleec_runtime.language import parse
from tests.support.explicit.conflicts import Explicit, TooLarge
from tests.support.paths import ROOT

SHARED = ROOT.parent / "shared"
FILES = [SHARED / "conflict-examples.json", SHARED / "conflict-examples-2.json"]
pytestmark = pytest.mark.skipif(not SHARED.is_dir(), reason="the published examples are not part of the project")


def examples(per_file: int | None = None) -> list[dict[str, Any]]:
    return [one for file in FILES for one in json.loads(file.read_text(encoding="utf-8"))[:per_file]]


def too_large(chosen: list[dict[str, Any]], states: int) -> int:
    """Compares the oracle with the examples, and returns how many are too large for it."""
    skipped = 0
    for example in chosen:
        try:
            found = Explicit(parse(example.get("dsl") or example["text"]), states).conflicts()
        except TooLarge:
            skipped += 1
            continue
        smallest = {rules for rules in found if not any(other < rules for other in found)}
        assert smallest == set(map(frozenset, example["smallest"])), example["name"]
        assert found == set(map(frozenset, example["all"])), example["name"]
    return skipped


@pytest.mark.slow
def test_the_oracle_finds_the_conflicts_of_the_first_examples() -> None:
    assert too_large(examples(10), states=500) <= 5


@pytest.mark.long
def test_the_oracle_finds_the_conflicts_of_all_examples() -> None:
    assert too_large(examples(), states=30_000) == 0
