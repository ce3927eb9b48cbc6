"""Conflicts of random rulesets with all constructs, by the check and by the oracle of explicit states."""

from __future__ import annotations

import pytest

from sleec_runtime.language import parse
from sleec_runtime.model import Syntax
from tests.adversary import campaign, difference, minimised


@pytest.mark.slow
@pytest.mark.parametrize(
    ("syntax", "timed", "seeds"),
    [
        pytest.param("english", False, range(150), id="English without time"),
        pytest.param("english", True, range(1000, 1020), id="English with time"),
        pytest.param("dsl", True, range(20), id="the DSL with time"),
    ],
)
def test_the_check_and_the_oracle_agree(syntax: Syntax, timed: bool, seeds: range) -> None:
    assert set(campaign(syntax, timed, seeds, seconds=600)) == {"rulesets"}


def test_a_smaller_ruleset_has_no_part_that_does_not_matter() -> None:
    rule = "WHEN A AND m THEN B AND C WITHIN 2 seconds UNLESS m AND C IN WHICH CASE NOT B"
    text = f"EVENT A, B, C\nCONDITION m\n{rule}\nNEVER C\n"
    small = minimised(parse(text), lambda ruleset: "C" in ruleset.obligations and bool(ruleset.rules))
    assert small == parse("WHEN A THEN C")


def test_rulesets_that_agree_have_no_difference() -> None:
    assert difference(parse("EVENT A, X\nWHEN A THEN X\nWHEN A THEN NOT X\n")) == ""
