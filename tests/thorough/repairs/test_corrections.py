"""Corrections of random rulesets with a planted mistake."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from random import Random

import pytest

from sleec_runtime.errors import LanguageError
from sleec_runtime.language import parse
from sleec_verify.repairs.edit import edited
from tests.support.realistic_rules import peoples_rules
from tests.support.repairs import found_repairs

PLANTED: Mapping[str, Callable[[str], str]] = {
    "SLEEC107": lambda text: text.replace("rule_end", "R when E0 then not E1 within 3 seconds\nrule_end"),
    "SLEEC506": lambda text: text.replace("\nR1 when", "\nR0 when"),
    "SLEEC507": lambda text: text.replace("def_end", "measure t: scale(few, some, many)\ndef_end").replace(
        "s = hi", "s = many"
    ),
    "SLEEC508": lambda text: text.replace("s > lo", "s > 0"),
    "SLEEC513": lambda text: text.replace("within 2 seconds", "within 0 seconds"),
}
REPAIRED = {"SLEEC506": "\nR0_2 when", "SLEEC507": "s = hi", "SLEEC508": "s > lo"}
KEEPS_MEANING = ("SLEEC506", "SLEEC507", "SLEEC508", "SLEEC513")


@pytest.mark.slow
@pytest.mark.parametrize("code", PLANTED)
def test_a_planted_mistake_is_corrected(code: str) -> None:
    number = 0
    for seed in range(200):
        text = PLANTED[code](peoples_rules(seed, Random(seed).randint(2, 4)))
        try:
            ruleset = parse(text)
        except LanguageError:  # a relation cannot name a rule with a repeated label
            continue
        for _, repair in found_repairs(ruleset, code):
            number += 1
            changed = edited(text, repair.candidate.edits)
            assert REPAIRED.get(code, "") in changed
            if code in KEEPS_MEANING:
                assert repair.effect.keeps_meaning
        if number >= 15:
            return
    pytest.fail("too few mistakes were planted")
