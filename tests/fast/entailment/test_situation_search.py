"""Situations that a person asks for: what is found holds, and what is not found holds in no situation."""

from __future__ import annotations

from random import Random

import pytest

from sleec_runtime.errors import LanguageError
from sleec_runtime.evaluation.conflicts import has_conflict
from sleec_runtime.evaluation.formula_truth import Situation, holds
from sleec_runtime.evaluation.hedge_chain import decide
from sleec_runtime.language import parse
from sleec_runtime.model import READINGS, Assume, Context, Reading, Ruleset, Value
from sleec_verify.entailment.situation_search import (
    with_clause,
    with_different_readings,
    with_obligation,
    with_rules,
)
from sleec_verify.query.ruleset_index import RulesetIndex
from tests.support.text_edits import edited_texts


def decisions(ruleset: Ruleset, context: Context, reading: Reading | None = None) -> dict[str, int]:
    """The clauses that decide, by the evaluator."""
    found = (decide(rule, context, reading or ruleset.reading, ruleset.measures) for rule in ruleset.rules)
    return {one.rule.label: one.clause for one in found if one is not None}


def required(ruleset: Ruleset, context: Context) -> set[str]:
    """The obligations in a situation, by the evaluator; none in a conflict."""
    due = [
        obligation
        for label, number in decisions(ruleset, context).items()
        for obligation in list(ruleset.by_label[label].clauses())[number].obligations
    ]
    constraints = [one for one in ruleset.constraints if not isinstance(one, Assume)]
    if has_conflict(tuple(due), constraints, Situation(context, ruleset.measures)):
        return set()
    return {one.name for one in due if not one.negated}


def readings_differ(ruleset: Ruleset, context: Context) -> bool:
    one, other = (decisions(ruleset, context, reading) for reading in READINGS)
    clauses = {rule.label: list(rule.clauses()) for rule in ruleset.rules}
    return any(set(clauses[r][one[r]].obligations) != set(clauses[r][other[r]].obligations) for r in one)


def random_contexts(ruleset: Ruleset, random: Random) -> list[Context]:
    """Situations that the assumptions allow."""
    found = []
    for _ in range(250):
        triggers = frozenset(name for name in sorted(ruleset.triggers) if random.random() < 0.3)
        values: dict[str, Value] = {name: random.random() < 0.5 for name in sorted(ruleset.conditions)}
        for name, measure in sorted(ruleset.measures.items()):
            values[name] = random.choice(measure.values or (-1, 0, 1, 2, 3))
        context = Context(triggers, values)
        if all(holds(c.formula, context, ruleset.measures) for c in ruleset.constraints if isinstance(c, Assume)):
            found.append(context)
    return found


@pytest.mark.parametrize("seed", range(12))
def test_answers_agree_with_the_evaluator(seed: int) -> None:
    random = Random(seed)
    for text in edited_texts(seed, edits=1, timed=False):
        try:
            ruleset = parse(text)
        except LanguageError:
            continue
        index = RulesetIndex(ruleset)
        contexts = random_contexts(ruleset, random)
        for name in sorted(ruleset.obligations):
            found = with_obligation(index, name)
            if found is None:
                assert not any(name in required(ruleset, context) for context in contexts), (text, name)
            else:
                assert name in required(ruleset, found), (text, name)
        one, other = random.choice(ruleset.rules), random.choice(ruleset.rules)
        found = with_rules(index, [one.label, other.label])
        for context in contexts if found is None else [found]:
            both = {one.label, other.label} <= decisions(ruleset, context).keys()
            assert both == (found is not None), text
        number = random.randrange(len(list(one.clauses())))
        found = with_clause(index, one.label, number)
        for context in contexts if found is None else [found]:
            assert (decisions(ruleset, context).get(one.label) == number) == (found is not None), text
        differing = with_different_readings(index)
        for context in contexts if differing is None else [differing[1]]:
            assert readings_differ(ruleset, context) == (differing is not None), text


def test_a_conflict_is_no_situation_in_which_an_obligation_holds() -> None:
    text = "RULE a WHEN T THEN X\nRULE b WHEN T THEN NOT X\nRULE c WHEN T AND c THEN Y\n"
    assert with_obligation(RulesetIndex(parse(text)), "Y") is None
    allowed = text.replace("THEN NOT X", "AND d THEN NOT X")
    assert with_obligation(RulesetIndex(parse(allowed)), "Y") is not None


def test_an_assumption_that_needs_something_to_hold_is_respected() -> None:
    text = "ASSUME c OR d\nRULE a WHEN T THEN X\nRULE b WHEN U AND c AND d THEN Y\n"
    found = with_obligation(RulesetIndex(parse(text)), "X")
    assert found is not None
    assert found.conditions.get("c") or found.conditions.get("d")
