"""Repairs of a conflict with a NEVER, in random rules with comments. What a repair announces is what changes."""

from __future__ import annotations

from random import Random

import pytest

from sleec_runtime.language import parse
from tests.support.repairs import differing, found_repairs, texts_after


def with_never(seed: int) -> str:
    random = Random(seed)
    excluded = random.choice(("A", "A AND B", "A AND c", "A AND NOT d AND T"))
    exceptions = random.choice(("", " UNLESS e", " UNLESS e UNLESS c AND d", " UNLESS T AND (c OR e)"))
    guard = random.choice(("", " AND c", " AND (c // (either\n OR d)", " AND // or\n c OR d"))
    hedge = random.choice(("", "UNLESS c IN WHICH CASE C\n", "UNLESS (d // )\n) IN WHICH CASE C AND A\n"))
    lines = [
        f"NEVER {excluded}{exceptions} // by law\n",
        f"RULE one\nWHEN T{guard} THEN A{random.choice(('', ' AND C'))} // first\n{hedge}",
        f"RULE two\nWHEN T{random.choice(('', ' AND d'))} THEN B\n",
        "RULE three\nWHEN S AND e THEN NOT A AND D\n",
    ]
    random.shuffle(lines)
    return "\n".join(lines)


@pytest.mark.slow
@pytest.mark.parametrize("start", range(0, 60, 20))
def test_a_repair_changes_what_it_announces_and_keeps_comments(start: int) -> None:
    kinds = set()
    for seed in range(start, start + 20):
        text = with_never(seed)
        ruleset = parse(text)
        for finding, repair in found_repairs(ruleset, "SLEEC101"):
            if not any(text[span.start :].startswith("NEVER") for span, _ in finding.related):
                continue
            kinds.add(repair.candidate.operator)
            situations = repair.effect.situations
            assert situations is not None
            assert (situations > 0) == (differing(ruleset, repair.repaired) > 0), repair.candidate.title
            if "remove" not in repair.candidate.title:
                (changed,) = texts_after(text, [repair])
                assert changed.count("//") == text.count("//")
    assert kinds >= {"trigger-strengthening", "defeater-introduction", "rule-removal"}
