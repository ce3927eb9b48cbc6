"""Changes that change no answer, of random rulesets with all constructs."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from sleec_runtime.errors import Unsayable
from sleec_runtime.model import Ruleset, Syntax
from tests.support.metamorphic import CHANGES, differences, there_and_back
from tests.support.random_rulesets import SMALL, random_ruleset


@pytest.mark.slow
@pytest.mark.parametrize("change", CHANGES.values(), ids=CHANGES)
@pytest.mark.parametrize(
    ("syntax", "timed", "seeds"),
    [
        pytest.param("english", False, range(60), id="English without time"),
        pytest.param("english", True, range(20, 26), id="English with time"),
        pytest.param("dsl", True, range(4), id="the DSL with time"),
    ],
)
def test_a_change_of_the_text_changes_no_answer(
    syntax: Syntax, timed: bool, seeds: range, change: Callable[[Ruleset], Ruleset]
) -> None:
    for seed in seeds:
        ruleset = random_ruleset(seed, syntax, SMALL, timed)
        if not ruleset.domains:
            assert differences(ruleset, change(ruleset)) == {}, f"seed {seed}\n{ruleset.source.text}"


@pytest.mark.slow
def test_conversion_there_and_back_changes_no_answer() -> None:
    compared = 0
    for seed in range(20):
        ruleset = random_ruleset(seed, "dsl", SMALL)
        try:
            same = there_and_back(ruleset)
        except Unsayable:
            # Structured English has no calculations.
            continue
        compared += 1
        assert differences(ruleset, same) == {}, f"seed {seed}\n{ruleset.source.text}"
    assert compared >= 10
