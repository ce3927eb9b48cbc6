"""What a conflict can go through: rules that have to do with it by ways that are easily left out."""

from __future__ import annotations

import pytest

from sleec_runtime.language import parse
from sleec_verify.timed.conflicts import conflict
from sleec_verify.timed.program import Program
from tests import timed_oracle as oracle

WAYS = {
    "what else forbids what is due, where this rule forbids it for a part of its window": """
        RULE other WHEN A THEN NOT C WITHIN 1 seconds
        RULE r WHEN T THEN NOT C WITHIN [2, 5] seconds UNLESS m
        RULE due WHEN D THEN C WITHIN 3 seconds""",
    "what the event that is due calls for": """
        RULE other WHEN A THEN NOT E WITHIN 3 seconds
        RULE calls WHEN C THEN E WITHIN 1 seconds
        RULE r WHEN T THEN NOT C WITHIN [2, 5] seconds UNLESS m
        RULE due WHEN D THEN C WITHIN 3 seconds""",
    "what comes in place of what is due": """
        RULE other WHEN A THEN NOT E WITHIN 3 seconds
        RULE calls WHEN C THEN E WITHIN 1 seconds
        RULE r WHEN T THEN NOT C WITHIN [2, 5] seconds UNLESS m
        RULE answers WHEN X THEN E
        RULE due WHEN D THEN C WITHIN 3 seconds OTHERWISE X""",
    "what comes in place of what is forbidden": """
        RULE r WHEN T THEN X
        RULE forbids WHEN S THEN NOT X WITHIN 5 seconds OTHERWISE Y WITHIN 2 seconds
        RULE other WHEN U THEN NOT Y WITHIN 100 seconds""",
    "what comes in place of what is forbidden, and calls for something": """
        RULE r WHEN T THEN X
        RULE forbids WHEN S THEN NOT X WITHIN 5 seconds OTHERWISE Y
        RULE calls WHEN Y THEN Z
        RULE other WHEN U THEN NOT Z WITHIN 100 seconds""",
    "what comes in place of what this rule forbids": """
        RULE r WHEN T THEN NOT X WITHIN 1 seconds
        RULE calls WHEN S THEN X WITHIN 1 seconds OTHERWISE Y
        RULE other WHEN U THEN NOT Y WITHIN 100 seconds""",
    "what triggers the prohibition later": """
        RULE r WHEN T THEN X WITHIN [3, 3] seconds
        RULE forbids WHEN S THEN NOT X
        RULE calls WHEN P THEN S WITHIN [4, 4] seconds""",
    "measures that suit only one of two rules at a time to come": """
        CONDITION m
        RULE r WHEN T THEN X WITHIN [2, 2] seconds
        RULE calls WHEN X THEN Bad UNLESS m
        RULE bad WHEN Bad THEN NOT Bad
        RULE past WHEN S THEN Y WITHIN [3, 3] seconds
        RULE other WHEN Y AND m THEN Bad""",
    "measures that a relation keeps from what suits": """
        CONDITION m
        RULE r WHEN T THEN X WITHIN [1, 1] seconds
        RULE calls WHEN X THEN Bad UNLESS m
        RULE bad WHEN Bad THEN NOT Bad
        RELATION WHEN S THEN NOT m FOR 2 seconds""",
    "what a relation ties to an event": """
        RULE r WHEN T THEN X WITHIN 2 seconds
        RELATION X EQUALS Y
        RULE calls WHEN Y THEN Z
        RULE other WHEN U THEN NOT Z WITHIN 5 seconds""",
}


@pytest.mark.parametrize("text", WAYS.values(), ids=WAYS.keys())
def test_a_conflict_by_way_of(text):
    program = Program(parse(text if "CONDITION" in text or "UNLESS" not in text else f"CONDITION m\n{text}"))
    rule = program.ruleset.by_label["r"]
    found = conflict(program, rule)
    assert found is not None
    assert oracle.conflict(program.ruleset, "r", past=len(found.instants) - 1, later=2, longest=4).found
