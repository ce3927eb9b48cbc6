"""Every operator repairs something."""

from __future__ import annotations

from typing import get_args

import pytest

from sleec_verify.repairs.repair import Operator
from tests.support.repairs import repairs_of

CONFLICT = "RULE a\nWHEN T AND e THEN A AND B\nRULE b\nWHEN T AND d THEN NOT A AND C\n"
CURTAINS = "RULE a\nWHEN T THEN A\nUNLESS d IN WHICH CASE NOT A AND B\nRULE b\nWHEN T AND e THEN A AND C\n"
EXAMPLES: dict[Operator, tuple[str, str]] = {
    "trigger-strengthening": ("SLEEC101", CONFLICT),
    "defeater-introduction": ("SLEEC101", CONFLICT),
    "defeater-refinement": ("SLEEC101", CURTAINS),
    "defeater-reordering": (
        "SLEEC202",
        "READING priority\nWHEN T THEN A\nUNLESS d AND e IN WHICH CASE B\nUNLESS d IN WHICH CASE C\n",
    ),
    "defeater-removal": ("SLEEC101", CURTAINS),
    "response-refinement": ("SLEEC101", CONFLICT),
    "deadline-refinement": (
        "SLEEC101",
        "RULE a\nWHEN T THEN A WITHIN 5 minutes\nRULE b\nWHEN S THEN NOT A WITHIN 1 hour\nRULE d\nWHEN T THEN B\n",
    ),
    "rule-addition": ("SLEEC104", "WHEN T THEN A WITHIN 1 minute\nCONCERN k WHEN S AND d THEN NOT B WITHIN 1 minute\n"),
    "rule-merging": ("SLEEC101", "RULE a\nWHEN T THEN A\nRULE b\nWHEN T AND d THEN NOT A\n"),
    "rule-decomposition": ("SLEEC101", CONFLICT),
    "rule-removal": ("SLEEC101", CONFLICT),
    "declaration-removal": ("SLEEC501", "TRIGGER T, S\nWHEN T THEN A\n"),
    "claim-removal": ("SLEEC510", "WHEN S THEN A WITHIN 1 minute\nPURPOSE p EXISTS Ghost\n"),
    "assumption": ("SLEEC101", CONFLICT),
    "correction": (
        "SLEEC101",
        "MEASURE age: number\nRULE a\nWHEN T AND age <= 6 THEN A\nRULE b\nWHEN T AND age >= 6 THEN NOT A\n",
    ),
    "renaming": ("SLEEC525", "WHEN T THEN take photos\nWHEN S THEN take photo\n"),
    "canonical-form": ("SLEEC520", "WHEN T THEN the robot is not allowed to leave\n"),
}


def test_every_operator_has_an_example() -> None:
    assert set(EXAMPLES) == set(get_args(Operator))


@pytest.mark.parametrize("operator", EXAMPLES)
def test_the_operator_repairs_its_example(operator: Operator) -> None:
    code, text = EXAMPLES[operator]
    assert operator in {repair.candidate.operator for repair in repairs_of(text, code)}
