"""Repairs of a conflict between a rule and a NEVER."""

from __future__ import annotations

import pytest

from sleec_runtime.language import parse
from tests.support.repairs import differing, repairs_of, texts_after

SIMPLE = "NEVER raise UNLESS alarm // law\nRULE r\nWHEN a THEN raise\nWHEN c THEN d\n"
JOINT = (
    "NEVER raise AND wave UNLESS alarm\nRULE r\nWHEN a AND x THEN raise AND speak\nUNLESS y IN WHICH CASE speak\n"
    "RULE s\nWHEN a THEN wave\nWHEN c THEN d\n"
)
ALWAYS_FORBIDDEN = "NEVER raise\nRULE r\nWHEN a AND x THEN raise\nWHEN c THEN d\n"


def test_the_rule_or_the_never_gives_way() -> None:
    texts = texts_after(SIMPLE, repairs_of(SIMPLE, "SLEEC101"))
    assert SIMPLE.replace("UNLESS alarm", "UNLESS alarm UNLESS a") in texts
    assert SIMPLE.replace("WHEN a THEN", "WHEN a AND alarm THEN") in texts
    assert SIMPLE.partition("\n")[2] in texts


def test_a_never_without_conditions_gets_an_exception() -> None:
    texts = texts_after(ALWAYS_FORBIDDEN, repairs_of(ALWAYS_FORBIDDEN, "SLEEC101"))
    assert ALWAYS_FORBIDDEN.replace("NEVER raise", "NEVER raise UNLESS a AND x") in texts


def test_a_rule_gives_way_only_where_the_never_applies() -> None:
    texts = texts_after(JOINT, repairs_of(JOINT, "SLEEC101"))
    assert JOINT.replace("WHEN a THEN", "WHEN a AND NOT (x AND NOT y AND NOT alarm) THEN") in texts
    assert JOINT.replace("alarm\n", "alarm UNLESS a AND x AND NOT y\n") in texts


@pytest.mark.parametrize("text", [SIMPLE, JOINT, ALWAYS_FORBIDDEN])
def test_the_announced_situations_change(text: str) -> None:
    old = parse(text)
    repairs = repairs_of(text, "SLEEC101")
    assert len(repairs) >= 3
    for repair in repairs:
        if repair.effect.situations == 0:
            assert differing(old, repair.repaired) == 0, repair.candidate.title
