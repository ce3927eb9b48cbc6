"""Other bounds, assumptions and split rules, in random rules with a planted conflict."""

from __future__ import annotations

from random import Random

import pytest

from sleec_runtime.language import parse
from tests.support.repairs import differing, found_repairs


def with_conflict(seed: int) -> str:
    """Two rules that contradict each other where their bounds overlap, and rules that do not matter."""
    random = Random(seed)
    low, high = sorted(random.choices(range(4), k=2))
    up, down = f"x {random.choice(('>', '>='))} {low}", f"x {random.choice(('<', '<='))} {high}"
    guard = random.choice(("", " AND c", " AND NOT c", " AND (c OR d)"))
    more = random.choice(("", " AND B", " AND NOT C"))
    rules = [
        f"RULE one\nWHEN T AND {up}{guard} THEN A{more}\n",
        f"RULE two // bound\nWHEN T AND {down} AND d THEN NOT A\n",
        f"RULE three\nWHEN S THEN {random.choice(('A', 'NOT B', 'C AND A'))}\nUNLESS c IN WHICH CASE B\n",
    ]
    random.shuffle(rules)
    return "MEASURE x: integer\n\n" + "\n".join(rules)


@pytest.mark.slow
@pytest.mark.parametrize("start", range(0, 60, 20))
def test_a_repair_changes_what_it_announces(start: int) -> None:
    kinds = set()
    for seed in range(start, start + 20):
        ruleset = parse(with_conflict(seed))
        for finding, repair in found_repairs(ruleset, "SLEEC101"):
            if set(finding.rules) == {"one", "two"}:
                kinds.add(repair.candidate.operator)
                situations = repair.effect.situations
                assert situations is not None
                assert (situations > 0) == (differing(ruleset, repair.repaired) > 0), repair.candidate.title
    assert kinds >= {"correction", "assumption", "rule-decomposition"}
