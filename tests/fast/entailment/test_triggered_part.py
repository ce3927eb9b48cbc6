"""The part of a ruleset that matters in a situation gives the same answer as the whole."""

from __future__ import annotations

from random import Random

import pytest

from sleec_runtime.errors import LanguageError
from sleec_runtime.language import parse
from sleec_runtime.model import Context
from sleec_verify.entailment.explanation import explain
from sleec_verify.entailment.triggered_part import triggered_part
from tests.support.text_edits import ACTS, CONDITIONS, TRIGGERS, edited_texts


@pytest.mark.parametrize("first", range(0, 80, 20))
def test_explanations_of_the_part_are_those_of_the_whole(first: int) -> None:
    smaller = 0
    for seed in range(first, first + 20):
        random = Random(seed)
        for text in edited_texts(seed, edits=1, timed=True):
            try:
                ruleset = parse(text)
            except LanguageError:
                continue
            names = sorted({*TRIGGERS, *ACTS} & ruleset.triggers)
            triggers = frozenset(random.sample(names, random.randint(0, min(2, len(names)))))
            values = {name: random.random() < 0.5 for name in CONDITIONS if random.random() < 0.8}
            context = Context(triggers, {**values, "x": random.randint(0, 3), "s": "middle"})
            part = triggered_part(ruleset, triggers)
            smaller += len(part.rules) < len(ruleset.rules)
            assert explain(part, context) == explain(ruleset, context), text
    assert smaller > 5


def test_rules_that_responses_trigger_stay() -> None:
    ruleset = parse("WHEN A THEN B\nWHEN B THEN C\nWHEN X THEN A\n")
    assert [rule.trigger for rule in triggered_part(ruleset, {"A"}).rules] == ["A", "B"]
